// The rings of rays and answers in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "bits.hpp"
#include "core.hpp"
#include "episode.hpp"
#include "lite.hpp"

// A bus with one identifier has no ports of it.
template <class Pins>
uint32_t read_id([[maybe_unused]] const Pins& top) {
  if constexpr (CORE_HAS_ONE_ID)
    return 0;
  else
    return top.m_axi_ring_arid;
}
template <class Pins>
uint32_t write_id([[maybe_unused]] const Pins& top) {
  if constexpr (CORE_HAS_ONE_ID)
    return 0;
  else
    return top.m_axi_ring_awid;
}
template <class Pins>
void show_read_id([[maybe_unused]] Pins& top, [[maybe_unused]] uint32_t id) {
  if constexpr (!CORE_HAS_ONE_ID) set(top.m_axi_ring_rid, id);
}
template <class Pins>
void show_write_id([[maybe_unused]] Pins& top, [[maybe_unused]] uint32_t id) {
  if constexpr (!CORE_HAS_ONE_ID) set(top.m_axi_ring_bid, id);
}

// In place of streams: a ray that the host writes to its ring, and an answer that it finds in the other.
struct Doors {
  bool s_axis_ray_tvalid = false, s_axis_ray_tready = false, m_axis_hit_tvalid = false,
       m_axis_hit_tready = false;
  uint32_t s_axis_ray_tid = 0, m_axis_hit_tid = 0;
  std::array<uint32_t, CORE_RAY_BYTES / 4> s_axis_ray_tdata{};
  std::array<uint32_t, CORE_HIT_BYTES / 4> m_axis_hit_tdata{};
};

constexpr uint32_t kept_at(uint32_t at) {
  uint32_t kept = 0;
  for (const RegisterWord& each : register_words) kept |= each.at == at ? each.kept : 0;
  return kept;
}
// Rays and answers are counted modulo a power of two.
constexpr uint32_t ring_counts = kept_at(CORE_REG_OFFERED), interrupt_enable = ring_counts + 1;

// The memory of both rings, and the host's side of them.
class Rings : public Episode {
 public:
  static constexpr bool hides_rays = true;
  static constexpr uint64_t places = CORE_ADDRESS_BITS < 11 ? 1u << (CORE_ADDRESS_BITS - 5) : 64;

  Doors& doors(Top&) { return doors_; }
  // The rings are anywhere, while no ray is on its way.
  template <class System>
  void start(System& system) {
    for (uint64_t* const at : {&rays_at_, &answers_at_}) {
      *at = static_cast<uint64_t>(system.random()) << 32 | system.random();
      *at &= ~uint64_t{0} >> (64 - CORE_ADDRESS_BITS) & ~uint64_t{CORE_RING_LINE_BYTES - 1};
    }
    system.write(CORE_REG_RAYS_LOW, static_cast<uint32_t>(rays_at_));
    system.write(CORE_REG_RAYS_HIGH, static_cast<uint32_t>(rays_at_ >> 32));
    system.write(CORE_REG_ANSWERS_LOW, static_cast<uint32_t>(answers_at_));
    system.write(CORE_REG_ANSWERS_HIGH, static_cast<uint32_t>(answers_at_ >> 32));
    system.write(CORE_REG_RING_LAST, places - 1);
  }
  void reset() {
    forget_all(!CORE_HAS_ONE_ID);
    interrupts_ = false;
    counts_known_ = true;
  }
  void end_reset() {
    if (is_busy()) fail("rings are read or written after a soft reset, register", CORE_REG_STATUS);
    forget_all(false);
  }
  uint32_t status() { return std::exchange(errors_given_, 0) != 0 ? CORE_RING_ERROR : 0; }
  template <class System, class Host>
  void damage(System& system, Host& host) {
    errors_ = 8;
    host.trace(100, Why::no_ray);
    errors_ = 0;
    for (int i = 0; i < 4; ++i) {
      fail_a_write(system, host);
      offer_too_many(system, host);
    }
    host.start(host.blocks());
  }
  template <class Registers>
  void compare(const Top& top, const Registers& registers) const {
    if (!registers.resetting() && top.irq != interrupts_) fail("the interrupt;", 0);
  }
  template <class Registers>
  void count(Registers& registers, const Top&, uint32_t at) {
    const uint64_t interrupt = registers.word(CORE_REG_INTERRUPT);
    interrupts_ =
        (interrupt & interrupt_enable) != 0 && ((answered_ - interrupt) & ring_counts) <= ring_counts / 2;
    answered_ += storing_;
    registers.word(CORE_REG_ANSWERED) = static_cast<uint32_t>(answered_ & ring_counts);
    counts_known_ = at == CORE_REG_CLEAR_COUNTERS || (counts_known_ && !registers.resetting());
  }
  // Nobody outside sees rays begin and answers leave on their way from and to rings.
  template <class Registers>
  uint32_t known(const Registers& registers, uint32_t at) const {
    const bool quiet = registers.flying() == 0 && !registers.resetting();
    const bool waits = ((registers.word(CORE_REG_OFFERED) ^ answered_) & ring_counts) != 0;
    if (at == CORE_REG_STATUS)
      return quiet ? ~(CORE_RING_ERROR | CORE_UNWRITTEN | CORE_OVERFULL | (waits ? CORE_IDLE : 0)) : 0;
    if (registers.resetting() && (at == CORE_REG_OFFERED || at == CORE_REG_ANSWERED)) return 0;
    for (const uint32_t counter :
         std::initializer_list<uint32_t>{CORE_COUNT_RAYS, CORE_COUNT_ANSWERS, CORE_COUNT_HITS})
      if (at / 8 == counter / 8) return quiet && counts_known_ ? ~uint32_t{0} : 0;
    return ~uint32_t{0};
  }
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
      is_error_ = random() % 64 < errors_;
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
    const bool fails = top.m_axi_ring_bvalid && !is_old_write_ && writes_left_ == 0;
    set(top.m_axi_ring_bresp,
        top.m_axi_ring_bvalid ? (fails || is_old_write_ ? 2 : 0) + random() % 2 : random() % 4);
    show_write_id(top, top.m_axi_ring_bvalid ? write_id_ : random() % 4);
    storing_ = top.m_axi_ring_bvalid && !is_old_write_ && !fails ? put_ - stored_ : 0;
  }
  // The end of a cycle, before its edge.
  void step(Top& top, Random& random, uint64_t cycle) {
    check_offers(top);
    if (top.m_axi_ring_rvalid) {
      Read& read = reads_.front();
      errors_given_ += is_error_ && !read.is_old;
      read.place += CORE_RING_BEAT_BYTES;
      if ((read.bytes -= CORE_RING_BEAT_BYTES) == 0) reads_.pop_front();
    }
    if (top.m_axi_ring_bvalid) {
      if (!is_old_write_) {
        has_failed_ = top.m_axi_ring_bresp >> 1;
        if (writes_left_ > 0) --writes_left_;
      }
      stored_ += storing_;
      is_old_write_ = false;
      due_.reset();
    }
    if (top.m_axi_ring_arvalid && top.m_axi_ring_arready) {
      const uint64_t bytes = bytes_of(top.m_axi_ring_arlen, CORE_RAY_BYTES);
      const uint64_t place =
          place_of(top.m_axi_ring_araddr, rays_at_, asked_ * CORE_RAY_BYTES, CORE_RAY_BYTES, bytes);
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
          place_of(top.m_axi_ring_awaddr, answers_at_, put_ * CORE_HIT_BYTES, CORE_HIT_BYTES, bytes), bytes};
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
  // What was asked for before a hard reset still comes where it has an identifier of that time. The half of a write
  // that has come is forgotten.
  void forget_all(bool keeps_old) {
    offered_ = announced_ = asked_ = put_ = stored_ = taken_ = answered_ = 0;
    if (!keeps_old) {
      reads_.clear();
      due_.reset();
    }
    for (Read& read : reads_) read.is_old = true;
    is_old_write_ = due_.has_value();
    has_failed_ = false;
    writes_left_ = -1;
    beats_.clear();
    write_.reset();
    doors_.m_axis_hit_tvalid = false;
    doors_.s_axis_ray_tready = true;
    offers_ = {};
  }
  // Rays run until an answer could not be written. No answer passes it, and only a reset goes on.
  template <class System, class Host>
  void fail_a_write(System& system, Host& host) {
    host.start(host.blocks());
    host.trace(1);
    writes_left_ = static_cast<int>(system.random() % 8);
    for (int i = 0; !has_failed_; ++i) {
      if (i > 100'000) fail("no answer is written; answered", host.answered());
      host.cycle(host.answered() + CORE_RAYS, 0, false);
    }
    for (int i = 0; i < 3'000; ++i) host.cycle(host.sent(), 0, false);
    host.quiet();
    // It is true as long as it is so.
    check_status(system, CORE_UNWRITTEN, "the status behind an answer that is not written, register");
    host.stop();
  }
  // More rays are offered than a ring has places: none of them begins.
  template <class System, class Host>
  void offer_too_many(System& system, Host& host) {
    host.start(host.blocks());
    host.trace(1 + system.random() % 20);
    const uint32_t more = 1 + system.random() % 0x7000;
    system.write(CORE_REG_OFFERED, static_cast<uint32_t>((stored_ + places + more) & ring_counts));
    for (int i = 0; i < 500; ++i) system.step();
    check_status(system, CORE_OVERFULL, "the status when too many rays are offered, register");
    host.stop();
  }
  template <class System>
  static void check_status(System& system, uint32_t expected, const char* what) {
    system.write(CORE_REG_STATUS, 0xffffffffu);
    if ((system.read(CORE_REG_STATUS) & ~CORE_IDLE) != expected) fail(what, CORE_REG_STATUS);
  }
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
    if (doors_.s_axis_ray_tvalid && doors_.s_axis_ray_tready) {
      uint8_t* const bytes = rays_[offered_++ % places].data();
      get_bytes(doors_.s_axis_ray_tdata, bytes, CORE_RAY_BYTES);
      core_put_tag(bytes, doors_.s_axis_ray_tid);
    }
    taken_ += doors_.m_axis_hit_tvalid && doors_.m_axis_hit_tready;
    doors_.s_axis_ray_tready = offered_ - taken_ < places;
    doors_.m_axis_hit_tvalid = taken_ < stored_;
    if (!doors_.m_axis_hit_tvalid) return;
    const uint8_t* const bytes = answers_[taken_ % places].data();
    put_bytes(doors_.m_axis_hit_tdata, bytes, CORE_HIT_BYTES);
    doors_.m_axis_hit_tid = core_get_tag(bytes);
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
  Doors doors_;
  unsigned errors_ = 0;   // of 64 beats
  int writes_left_ = -1;  // until one fails; below 0: none does
  uint64_t errors_given_ = 0, rays_at_ = 0, answers_at_ = 0;
  // What the registers count, and answers that the memory says in this cycle that it has.
  uint64_t answered_ = 0, storing_ = 0;
  bool interrupts_ = false, counts_known_ = true;
};
using DoorsOwner = Rings;
