// AXI4-Lite: the host at the registers.
#pragma once

#include <cstdint>
#include <deque>
#include <iterator>

#include "bits.hpp"
#include "core.hpp"

constexpr uint32_t first_unused_register = (std::end(register_words) - 1)->at + 4;

// Who writes and reads the registers. Addresses and words come in any order, answers wait now and then, and words that
// nobody has asked for are read and written in between.
class Lite {
 public:
  uint64_t writes = 0, reads = 0, written = 0, has_read = 0;  // asked for, and answered
  uint32_t word = 0;                                          // that was read last
  bool holds = false;                                         // answers are not taken

  void ask_write(uint8_t at, uint32_t value, uint32_t strobes) {
    ask_place(at);
    ask_word(value, strobes);
    ++writes;
  }
  void ask_place(uint8_t at) { places_.push_back(at); }
  void ask_word(uint32_t value, uint32_t strobes) { words_.push_back({value, strobes}); }
  void ask_read(uint8_t at) {
    asked_.push_back(at);
    ++reads;
  }
  void show(Top& top, Random& random) {
    if (random.one_in(16) && asked_.size() < 2) ask_read(static_cast<uint8_t>(random()));
    // To write nowhere, or no byte, changes nothing.
    if (random.one_in(32) && places_.empty() && words_.empty())
      random.one_in(2) ? ask_write(static_cast<uint8_t>(first_unused_register +
                                                        random() % (register_bytes - first_unused_register)),
                                   random(), random() % 16)
                       : ask_write(static_cast<uint8_t>(CORE_REG_LAST_BLOCK + random() % 3 * 4), random(), 0);
    const uint32_t low = random();
    if (!top.s_axi_awvalid) {
      top.s_axi_awvalid = !places_.empty() && !random.one_in(3);
      top.s_axi_awaddr = static_cast<uint8_t>(top.s_axi_awvalid ? (places_.front() & 0xfc) | low % 4 : low);
    }
    if (!top.s_axi_wvalid) {
      top.s_axi_wvalid = !words_.empty() && !random.one_in(3);
      top.s_axi_wdata = top.s_axi_wvalid ? words_.front().value : random();
      set(top.s_axi_wstrb, top.s_axi_wvalid ? words_.front().strobes : low >> 8 & 15);
    }
    if (!top.s_axi_arvalid) {
      top.s_axi_arvalid = !asked_.empty() && !random.one_in(3);
      top.s_axi_araddr =
          static_cast<uint8_t>(top.s_axi_arvalid ? (asked_.front() & 0xfc) | (low >> 12 & 3) : low >> 16);
    }
    top.s_axi_bready = !holds && !random.one_in(3);
    top.s_axi_rready = !holds && !random.one_in(3);
  }
  // Which of the valid bits are 0 in the next cycle, when show() may set them again.
  struct Taken {
    bool place, word, read;
  };
  Taken take(const Top& top) {
    const Taken taken{top.s_axi_awvalid && top.s_axi_awready, top.s_axi_wvalid && top.s_axi_wready,
                      top.s_axi_arvalid && top.s_axi_arready};
    if (taken.place) places_.pop_front();
    if (taken.word) words_.pop_front();
    if (taken.read) asked_.pop_front();
    written += top.s_axi_bvalid && top.s_axi_bready;
    if (top.s_axi_rvalid && top.s_axi_rready) {
      ++has_read;
      word = top.s_axi_rdata;
    }
    return taken;
  }

 private:
  struct Word {
    uint32_t value, strobes;
  };
  std::deque<uint8_t> places_, asked_;
  std::deque<Word> words_;
};
