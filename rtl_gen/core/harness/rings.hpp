// The rings of rays and answers in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "bits.hpp"
#include "core.hpp"
#include "doors.hpp"
#include "lite.hpp"

#if CORE_HAS_RINGS
#if CORE_HAS_ONE_ID
inline uint32_t read_id(const Top&) {
  return 0;
}
inline uint32_t write_id(const Top&) {
  return 0;
}
inline void show_read_id(Top&, uint32_t) {}
inline void show_write_id(Top&, uint32_t) {}
#else
inline uint32_t read_id(const Top& top) {
  return top.m_axi_ring_arid;
}
inline uint32_t write_id(const Top& top) {
  return top.m_axi_ring_awid;
}
inline void show_read_id(Top& top, uint32_t id) {
  set(top.m_axi_ring_rid, id);
}
inline void show_write_id(Top& top, uint32_t id) {
  set(top.m_axi_ring_bid, id);
}
#endif

// The memory of both rings, and the host's side of them.
class Rings {
 public:
  static constexpr uint64_t places = CORE_ADDRESS_BITS < 11 ? 1u << (CORE_ADDRESS_BITS - 5) : 64;
  Doors doors;
  unsigned errors = 0;   // of 64 beats
  int writes_left = -1;  // until one fails; below 0: none does
  uint64_t errors_given = 0, rays_at = 0, answers_at = 0;

  // Anywhere, while no ray is on its way.
  void place(Random& random) {
    for (uint64_t* const at : {&rays_at, &answers_at}) {
      *at = static_cast<uint64_t>(random()) << 32 | random();
      *at &= ~uint64_t{0} >> (64 - CORE_ADDRESS_BITS) & ~uint64_t{CORE_RING_LINE_BYTES - 1};
    }
  }
  // What was asked for before a hard reset still comes where it has an identifier of that time. The half of a write
  // that has come is forgotten.
  void reset(bool keeps_old) {
    offered_ = announced_ = asked_ = put_ = stored_ = taken_ = 0;
    if (!keeps_old) {
      reads_.clear();
      due_.reset();
    }
    for (Read& read : reads_) read.is_old = true;
    is_old_write_ = due_.has_value();
    has_failed_ = false;
    writes_left = -1;
    beats_.clear();
    write_.reset();
    doors.m_axis_hit_tvalid = false;
    doors.s_axis_ray_tready = true;
    offers_ = {};
  }
  // So many more rays than a ring has places.
  uint32_t too_many(uint32_t more) const {
    return static_cast<uint32_t>((stored_ + places + more) & ring_counts);
  }
  bool has_failed() const { return has_failed_; }
  bool is_busy() const { return !reads_.empty() || write_ || !beats_.empty() || due_; }
  // The core is told of the rays that are there now and then. It is asked for an interrupt at some answer.
  void announce(Lite& lite, Random& random) {
    if (lite.writes - lite.written > 1) return;
    if (announced_ != offered_ && random.one_in(4)) {
      announced_ = offered_;
      lite.ask_write(CORE_REG_OFFERED, static_cast<uint32_t>(offered_ & ring_counts), 15);
    } else if (random.one_in(64)) {
      lite.ask_write(CORE_REG_INTERRUPT,
                     static_cast<uint32_t>(((stored_ + random() % 8) & ring_counts) |
                                           (uint64_t{random() % 2} * interrupt_enable)),
                     15);
    }
  }
  void show(Top& top, Random& random, uint64_t cycle) {
    top.m_axi_ring_arready = !random.one_in(4);
    top.m_axi_ring_awready = !random.one_in(4);
    top.m_axi_ring_wready = !random.one_in(4);
    // Beats with other identifiers may come in between.
    for (size_t i = 1; i < reads_.size(); ++i)
      if (reads_[0].is_old && !reads_[i].is_old && random.one_in(4)) std::swap(reads_[0], reads_[i]);
    top.m_axi_ring_rvalid = !reads_.empty() && reads_.front().due <= cycle && !random.one_in(4);
    show_read_id(top, random() % 4);
    if (top.m_axi_ring_rvalid) {
      const Read& read = reads_.front();
      show_read_id(top, read.id);
      is_error_ = random() % 64 < errors;
      const bool is_spoilt = is_error_ && random.one_in(2);
      std::array<uint8_t, CORE_RING_BEAT_BYTES> bytes{};
      // The tag is right, or nobody would know whose answer it is.
      for (size_t i = 0; i < bytes.size(); ++i) {
        const size_t at = (read.place + i) % CORE_RAY_BYTES;
        bytes[i] =
            rays_[(read.place + i) / CORE_RAY_BYTES % places][at] ^ (is_spoilt && at / 4 < 7 ? 0x15 : 0);
      }
      put_bytes(top.m_axi_ring_rdata, bytes.data(), bytes.size());
      top.m_axi_ring_rlast = read.bytes == CORE_RING_BEAT_BYTES;
      top.m_axi_ring_rresp = is_error_ ? 2 + random() % 2 : random() % 2;
    } else {
      put_rubbish(top.m_axi_ring_rdata, CORE_RING_BEAT_BYTES, random);
      top.m_axi_ring_rlast = random() % 2;
      top.m_axi_ring_rresp = random() % 4;
    }
    top.m_axi_ring_bvalid = due_ && *due_ <= cycle;
    const bool fails = top.m_axi_ring_bvalid && !is_old_write_ && writes_left == 0;
    set(top.m_axi_ring_bresp,
        top.m_axi_ring_bvalid ? (fails || is_old_write_ ? 2 : 0) + random() % 2 : random() % 4);
    show_write_id(top, top.m_axi_ring_bvalid ? write_id_ : random() % 4);
    doors.stored = top.m_axi_ring_bvalid && !is_old_write_ && !fails ? put_ - stored_ : 0;
  }
  // The end of a cycle, before its edge.
  void step(Top& top, Random& random, uint64_t cycle) {
    check_offers(top);
    if (top.m_axi_ring_rvalid) {
      Read& read = reads_.front();
      errors_given += is_error_ && !read.is_old;
      read.place += CORE_RING_BEAT_BYTES;
      if ((read.bytes -= CORE_RING_BEAT_BYTES) == 0) reads_.pop_front();
    }
    if (top.m_axi_ring_bvalid) {
      if (!is_old_write_) {
        has_failed_ = top.m_axi_ring_bresp >> 1;
        if (writes_left > 0) --writes_left;
      }
      stored_ += doors.stored;
      is_old_write_ = false;
      due_.reset();
    }
    if (top.m_axi_ring_arvalid && top.m_axi_ring_arready) {
      const uint64_t bytes = bytes_of(top.m_axi_ring_arlen, CORE_RAY_BYTES);
      const uint64_t place =
          place_of(top.m_axi_ring_araddr, rays_at, asked_ * CORE_RAY_BYTES, CORE_RAY_BYTES, bytes);
      asked_ += bytes / CORE_RAY_BYTES;
      if (asked_ > announced_) fail("a ray is read that is not there, ray", asked_);
      reads_.push_back({place, bytes, cycle + random() % 60, read_id(top)});
    }
    if (top.m_axi_ring_awvalid && top.m_axi_ring_awready) {
      if (write_) fail("a second write before the first has ended, address", top.m_axi_ring_awaddr);
      if (has_failed_) fail("a write behind one that has failed, address", top.m_axi_ring_awaddr);
      asked_write_id_ = write_id(top);
      const uint64_t bytes = bytes_of(top.m_axi_ring_awlen, CORE_HIT_BYTES);
      write_ = Write{
          place_of(top.m_axi_ring_awaddr, answers_at, put_ * CORE_HIT_BYTES, CORE_HIT_BYTES, bytes), bytes};
    }
    if (top.m_axi_ring_wvalid && top.m_axi_ring_wready) {
      std::array<uint8_t, CORE_RING_BEAT_BYTES> bytes;
      get_bytes(top.m_axi_ring_wdata, bytes.data(), bytes.size());
      beats_.insert(beats_.end(), bytes.begin(), bytes.end());
      has_last_ = top.m_axi_ring_wlast;
      if (top.m_axi_ring_wstrb != (1u << CORE_RING_BEAT_BYTES) - 1)
        fail("bytes of a beat that are not written, wstrb", top.m_axi_ring_wstrb);
    }
    if (has_last_ && write_) {
      if (write_->bytes != beats_.size())
        fail("a write of another length than it said, bytes", beats_.size());
      for (size_t i = 0; i < beats_.size(); ++i)
        answers_[(write_->place + i) / CORE_HIT_BYTES % places][(write_->place + i) % CORE_HIT_BYTES] =
            beats_[i];
      put_ += write_->bytes / CORE_HIT_BYTES;
      if (put_ > asked_) fail("an answer of no ray, number", put_);
      due_ = cycle + 1 + random() % 30;
      write_id_ = asked_write_id_;
      write_.reset();
      beats_.clear();
      has_last_ = false;
    }
    open_doors();
  }

 private:
  struct Read {
    uint64_t place, bytes, due;
    uint32_t id;
    bool is_old = false;  // of before a reset
  };
  struct Write {
    uint64_t place, bytes;
  };
  // What is offered stays until it is taken.
  struct Offers {
    bool read = false, write = false, beat = false;
    uint64_t read_at = 0, read_length = 0, write_at = 0, write_length = 0, last = 0;
    std::array<uint8_t, CORE_RING_BEAT_BYTES> bytes{};
  };
  static uint64_t bytes_of(uint64_t length, uint64_t record) {
    const uint64_t bytes = (length + 1) * CORE_RING_BEAT_BYTES;
    if (bytes != record && bytes != 4 * record)
      fail("a burst that is neither one record nor four, len", length);
    return bytes;
  }
  // In the ring, in bytes. Records come one after the other.
  static uint64_t place_of(uint64_t address, uint64_t base, uint64_t next, uint64_t record, uint64_t bytes) {
    const uint64_t place = (address - base) << (64 - CORE_ADDRESS_BITS) >> (64 - CORE_ADDRESS_BITS);
    if (place != next % (places * record)) fail("a record that is not the next one, address", address);
    if (address % 4096 + bytes > 4096) fail("a burst across 4 KiB, address", address);
    return place;
  }
  void check_offers(const Top& top) {
    Offers now{top.m_axi_ring_arvalid != 0, top.m_axi_ring_awvalid != 0, top.m_axi_ring_wvalid != 0,
               top.m_axi_ring_araddr,       top.m_axi_ring_arlen,        top.m_axi_ring_awaddr,
               top.m_axi_ring_awlen,        top.m_axi_ring_wlast,        {}};
    get_bytes(top.m_axi_ring_wdata, now.bytes.data(), now.bytes.size());
    if (offers_.read &&
        (!now.read || now.read_at != offers_.read_at || now.read_length != offers_.read_length))
      fail("a read that was offered is gone, address", offers_.read_at);
    if (offers_.write &&
        (!now.write || now.write_at != offers_.write_at || now.write_length != offers_.write_length))
      fail("a write that was offered is gone, address", offers_.write_at);
    if (offers_.beat && (!now.beat || now.last != offers_.last || now.bytes != offers_.bytes))
      fail("a beat that was offered is gone, last", offers_.last);
    for (const uint64_t size : {top.m_axi_ring_arsize, top.m_axi_ring_awsize})
      if (1u << size != CORE_RING_BEAT_BYTES) fail("the size of a beat, arsize or awsize", size);
    if (top.m_axi_ring_arburst != 1 || top.m_axi_ring_awburst != 1 || top.m_axi_ring_arcache != 3 ||
        top.m_axi_ring_awcache != 3 || top.m_axi_ring_arprot != 0 || top.m_axi_ring_awprot != 0 ||
        !top.m_axi_ring_rready || !top.m_axi_ring_bready)
      fail("the kind of a burst, arburst", top.m_axi_ring_arburst);
    now.read = now.read && !top.m_axi_ring_arready;
    now.write = now.write && !top.m_axi_ring_awready;
    now.beat = now.beat && !top.m_axi_ring_wready;
    offers_ = now;
  }
  // The host writes a ray, or takes an answer.
  void open_doors() {
    if (doors.s_axis_ray_tvalid && doors.s_axis_ray_tready) {
      uint8_t* const bytes = rays_[offered_++ % places].data();
      get_bytes(doors.s_axis_ray_tdata, bytes, CORE_RAY_BYTES);
      core_put_tag(bytes, doors.s_axis_ray_tid);
    }
    taken_ += doors.m_axis_hit_tvalid && doors.m_axis_hit_tready;
    doors.s_axis_ray_tready = offered_ - taken_ < places;
    doors.m_axis_hit_tvalid = taken_ < stored_;
    if (!doors.m_axis_hit_tvalid) return;
    const uint8_t* const bytes = answers_[taken_ % places].data();
    put_bytes(doors.m_axis_hit_tdata, bytes, CORE_HIT_BYTES);
    doors.m_axis_hit_tid = core_get_tag(bytes);
  }

  std::array<std::array<uint8_t, CORE_RAY_BYTES>, places> rays_{};
  std::array<std::array<uint8_t, CORE_HIT_BYTES>, places> answers_{};
  // Rays that were written, that the core was told of, and that it has asked for; answers that it has written, that the
  // memory says it has, and that were taken; of all.
  uint64_t offered_ = 0, announced_ = 0, asked_ = 0, put_ = 0, stored_ = 0, taken_ = 0;
  std::deque<Read> reads_;
  std::optional<Write> write_;
  std::vector<uint8_t> beats_;
  std::optional<uint64_t> due_;
  uint32_t write_id_ = 0, asked_write_id_ = 0;  // of the write that memory has, and of the one that is coming
  bool has_last_ = false, is_error_ = false, is_old_write_ = false, has_failed_ = false;
  Offers offers_{};
};
#endif
