// The core, its memory and its registers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "bits.hpp"
#include "core.hpp"
#include "doors.hpp"
#include "features.hpp"
#include "lite.hpp"
#include "registers.hpp"
#include "scene.hpp"

class System {
 public:
  std::vector<Block> memory;
  uint64_t first_block = 0;  // where the image is
  unsigned errors = 0;       // of 64 reads are errors
  unsigned slowest = 60;     // cycles that a read may take
  bool refuses = false;      // memory takes no request
  uint64_t errors_given = 0;
  Random random;
  Top top;
  Episodes episodes;
  Doors& doors = episodes.get<DoorsOwner>().doors(top);
  Lite lite;
  Registers registers;  // what they must say

  explicit System(uint64_t seed) : random{seed * 0x9e3779b97f4a7c15u | 1} {
    // Inputs begin with random bits too.
    top.aclk = doors.m_axis_hit_tready = 0;
    reset(2);
  }
  // For so many cycles. Memory still answers what it was asked for; if nothing tells old reads from new ones, it is
  // reset as well.
  void reset(int cycles) {
    if (CORE_HAS_ONE_ID) reads_.clear();
    for (Read& read : reads_) read.is_old = true;
    lite = Lite();
    episodes.each([](auto& one) { one.reset(); });
    top.s_axi_awvalid = top.s_axi_wvalid = top.s_axi_arvalid = doors.s_axis_ray_tvalid = 0;
    for (top.aresetn = 0; cycles > 0; --cycles) step();
    top.aresetn = 1;
  }
  void write(uint8_t address, uint32_t value, uint32_t strobes = 15) {
    lite.ask_write(address, value, strobes);
    const uint64_t mine = lite.writes;
    for (int i = 0; lite.written < mine; ++i) {
      if (i > 1000) fail("a write that is not answered, register", address);
      step();
    }
  }
  uint32_t read(uint8_t address) {
    lite.ask_read(address);
    const uint64_t mine = lite.reads;
    for (int i = 0; lite.has_read < mine; ++i) {
      if (i > 1000) fail("a read that is not answered, register", address);
      step();
    }
    return lite.word;
  }
  uint64_t counter(uint8_t address) {
    const uint64_t low = read(address);
    return low | static_cast<uint64_t>(read(static_cast<uint8_t>(address + 4))) << 32;
  }
  // All words, each at least once. What they say is compared where they are read.
  void read_all() {
    for (uint32_t at = 0; at < register_bytes; at += 4) read(static_cast<uint8_t>(at));
  }
  // One clock cycle, with the memory's part in it.
  void step() {
    if (top.aresetn) lite.show(top, random);
    if (!doors.s_axis_ray_tvalid) {
      put_rubbish(doors.s_axis_ray_tdata, CORE_RAY_BYTES, random);
      doors.s_axis_ray_tid = random() & (~uint64_t{0} >> (64 - CORE_TAG_BITS));
    }
    top.m_axi_arready = !refuses && !random.one_in(8);
    // With one identifier the oldest is read, else any of them. What was offered stays.
    if (!reads_.empty() && !CORE_HAS_ONE_ID && !waits_.beat)
      std::swap(reads_[0], reads_[random() % reads_.size()]);
    top.m_axi_rvalid = !reads_.empty() && reads_[0].due <= cycle_;
    if (top.m_axi_rvalid) {
      show(reads_[0]);
    } else {
      put_rubbish(top.m_axi_rdata, CORE_BEAT_BYTES, random);
      top.m_axi_rresp = random() % 4;
      top.m_axi_rlast = random() % 2;
      show_id(top, random() & static_cast<uint32_t>(ray_numbers * 8 - 1));
    }
    episodes.each([&](auto& one) { one.show(top, random, cycle_); });
    top.aclk = 0;
    top.eval();
    check_offers();
    if (top.aresetn) registers.compare(top, doors, episodes);
    bool comes = false, has_error = false;
    if (top.m_axi_rvalid && top.m_axi_rready) {
      Read& read = reads_[0];
      comes = ++read.beats == beats && !read.is_old;
      has_error = read.is_error;
      errors_given += read.is_error && comes;
      if (read.beats == beats) reads_.pop_front();
    }
    if (top.aresetn && top.m_axi_arvalid && top.m_axi_arready) {
      Read& read = reads_.emplace_back();
      read.address = top.m_axi_araddr;
      read.block = block_at(read.address);
      if (read.block >= memory.size() || read.block > registers.last())
        fail("a read outside of the image, block", read.block);
      read.due = cycle_ + random() % slowest;
      read.is_error = random() % 64 < errors;
      read.is_right = random.one_in(2);
      read.bad_beat = random() % beats;
      read.id = asked_id(top);
    }
    registers.step(top, doors, episodes, comes, has_error);
    if (top.aresetn) episodes.each([&](auto& one) { one.step(top, random, cycle_); });
    const Lite::Taken taken = top.aresetn ? lite.take(top) : Lite::Taken{};
    top.aclk = 1;
    top.eval();
    if (taken.place) top.s_axi_awvalid = 0;
    if (taken.word) top.s_axi_wvalid = 0;
    if (taken.read) top.s_axi_arvalid = 0;
    ++cycle_;
  }
  // Anywhere. Behind the end of the address space comes its beginning.
  void place_image() {
    const uint64_t place = static_cast<uint64_t>(random()) << 32 | random();
    first_block = place << (64 - CORE_ADDRESS_BITS) >> (64 - CORE_ADDRESS_BITS) >> 6 << 1;
    // Now and then at the end, so that it goes on at the beginning.
    if (random.one_in(4))
      first_block = (~uint64_t{0} >> (64 - CORE_ADDRESS_BITS) >> 6 << 1) - uint64_t{random() % 8} * 2;
  }
  size_t reads_on_their_way() const { return reads_.size(); }
  bool is_quiet() const {
    bool is = reads_.empty();
    episodes.each([&](const auto& one) { is = is && !one.is_busy(); });
    return is;
  }
  // Memory has changed.
  void forget() {
    episodes.each([&](auto& one) { one.forget(lite); });
  }

 private:
  // A beat may have less bytes than a read, or more.
  static constexpr uint64_t beats =
      CORE_BURST_BYTES < CORE_BEAT_BYTES ? 1 : CORE_BURST_BYTES / CORE_BEAT_BYTES;
  struct Read {
    uint64_t address, block, due, beats = 0, bad_beat = 0;
    uint32_t id = 0;
    bool is_error = false, is_right = false;  // an error may come with the right words
    bool is_old = false;                      // it was asked for before a reset
  };
  void show(const Read& read) {
    std::array<uint8_t, CORE_BEAT_BYTES> bytes{};
    for (size_t i = 0; i < CORE_BURST_BYTES; ++i)
      if (i / bytes.size() == read.beats || beats == 1)
        bytes[(read.address + i) % bytes.size()] =
            memory[read.block + i / CORE_BLOCK_BYTES][i % CORE_BLOCK_BYTES];
    if (read.is_error && !read.is_right && read.beats == read.bad_beat)
      bytes[read.address % bytes.size()] ^= 0x55;
    put_bytes(top.m_axi_rdata, bytes.data(), bytes.size());
    top.m_axi_rlast = read.beats + 1 == beats;
    top.m_axi_rresp = read.is_error && read.beats == read.bad_beat ? 2 + random() % 2 : random() % 2;
    show_id(top, read.id);
  }
  // What is offered stays as it is until it is taken. A request is that of a block.
  void check_offers() {
    Offers now{top.aresetn && top.m_axi_arvalid,
               top.aresetn && doors.m_axis_hit_tvalid,
               false,
               top.m_axi_araddr,
               asked_id(top),
               doors.m_axis_hit_tid,
               {}};
    if (now.answer) get_bytes(doors.m_axis_hit_tdata, now.hit.data(), CORE_HIT_BYTES);
    if (top.aresetn && waits_.request &&
        (!now.request || now.address != waits_.address || now.id != waits_.id))
      fail("a request that was offered is gone, address", waits_.address);
    if (top.aresetn && waits_.answer && (!now.answer || now.tag != waits_.tag || now.hit != waits_.hit))
      fail("an answer that was offered is gone, tag", waits_.tag);
    if (now.request && now.address % CORE_BURST_BYTES != 0)
      fail("a request between two reads, address", now.address);
    if (top.m_axi_arlen != beats - 1 || 1u << top.m_axi_arsize != CORE_BURST_BYTES / beats ||
        top.m_axi_arburst != 1)
      fail("the size of a request, beats", top.m_axi_arlen);
    if (top.m_axi_arcache != 3 || top.m_axi_arprot != 0)
      fail("the kind of a request, arcache", top.m_axi_arcache);
    now.request = now.request && !top.m_axi_arready;
    now.answer = now.answer && !doors.m_axis_hit_tready;
    now.beat = top.m_axi_rvalid && !top.m_axi_rready;
    waits_ = now;
  }
  // Addresses go round at their last bit.
  uint64_t block_at(uint64_t address) const {
    return (address - first_block * CORE_BLOCK_BYTES) << (64 - CORE_ADDRESS_BITS) >>
           (64 - CORE_ADDRESS_BITS) >> 5;
  }
  struct Offers {
    bool request, answer, beat;
    uint64_t address, id, tag;
    std::array<uint8_t, CORE_HIT_BYTES> hit;
  };
  Offers waits_{};
  std::deque<Read> reads_;
  uint64_t cycle_ = 0;
};
