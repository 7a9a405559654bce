// A model of the registers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bits.hpp"
#include "core.hpp"
#include "doors.hpp"
#include "features.hpp"

// What the registers say and let pass, by what has passed in all cycles before.
class Registers {
 public:
  Registers() {
    for (const RegisterWord& each : register_words) word(each.at) = each.value;
  }
  uint64_t last() const { return word(CORE_REG_LAST_BLOCK); }
  uint64_t most_rays() const { return word(CORE_REG_MOST_RAYS); }
  bool resetting() const { return resetting_; }
  bool had_ray() const { return had_ray_; }
  uint64_t flying() const { return flying_; }
  uint32_t& word(uint32_t at) { return words_[at / 4]; }
  uint32_t word(uint32_t at) const { return words_[at / 4]; }
  void count(uint32_t counter, bool happens) {
    if (happens && ++word(counter) == 0) ++word(counter + 4);
  }
  void end_reset() { resets_ = true; }
  // In a cycle. What does not stand in `top` is an output.
  void compare(const Top& top, const Doors& doors, const Episodes& episodes) const {
    const auto same = [](bool is, const char* what) {
      if (!is) fail(what, 0);
    };
    same(top.s_axi_awready == !has_place_ && top.s_axi_wready == !has_word_, "what s_axi takes of a write;");
    same(top.s_axi_bvalid == written_, "the answer of a write, not once;");
    same(top.s_axi_arready == !has_read_, "what s_axi takes of a read;");
    same(top.s_axi_rvalid == gives_, "the answer of a read, not once;");
    same(top.s_axi_bresp == 0 && top.s_axi_rresp == 0, "an error of s_axi;");
    if (gives_ && (top.s_axi_rdata & known_) != (given_ & known_))
      fail("what is read of register", uint64_t{given_place_} * 4);
    same(ends_unseen || !resetting_ || !doors.s_axis_ray_tready, "a soft reset takes a ray;");
    same(Episodes::hides_rays || most_rays() != 0 || !doors.s_axis_ray_tready,
         "a ray is taken while none may begin;");
    same(Episodes::hides_requests || lets_requests_ || !top.m_axi_arvalid, "a soft reset asks for a block;");
    same(Episodes::hides_rays || lets_answers_ || !doors.m_axis_hit_tvalid, "a soft reset gives an answer;");
    // Rays in front of the door have no number yet.
    same(CORE_PORTS >> 24 & 1 || flying_ <= most_given_, "more rays than the register lets in;");
    same(flying_ != 0 || !doors.m_axis_hit_tvalid, "an answer of no ray;");
    episodes.each([&](const auto& one) { one.compare(top, *this); });
  }
  // Its end. A block comes, or has an error, one cycle after its last beat if it is put together from beats.
  void step(const Top& top, const Doors& doors, Episodes& episodes, bool block_comes, bool block_error) {
    if (!top.aresetn) {
      *this = Registers();
      return;
    }
    const bool came = CORE_HAS_ONE_ID ? block_comes_ : block_comes;
    const bool had_error = CORE_HAS_ONE_ID ? block_error_ : block_error;
    block_comes_ = block_comes;
    block_error_ = block_error;
    const bool ray = doors.s_axis_ray_tvalid && doors.s_axis_ray_tready;
    const bool answer = doors.m_axis_hit_tvalid && doors.m_axis_hit_tready;
    const bool asked = top.m_axi_arvalid && top.m_axi_arready;
    const core_hit hit = answer ? hit_of(doors) : core_hit{};
    had_ray_ = had_ray_ || ray;

    const bool reads = has_read_ && (!gives_ || top.s_axi_rready);
    if (reads) {
      given_ = word_at(read_place_ * 4);
      given_place_ = read_place_;
      known_ = known_at(episodes, read_place_ * 4);
    }
    gives_ = reads || (gives_ && !top.s_axi_rready);
    if (!has_read_) read_place_ = top.s_axi_araddr / 4;
    has_read_ = has_read_ ? !reads : top.s_axi_arvalid;

    const bool writes = has_place_ && has_word_ && !written_;
    const uint32_t at = writes ? write_place_ * 4 : register_bytes;
    uint32_t mask = 0;
    for (int byte = 0; byte < 4; ++byte)
      if (strobes_ >> byte & 1) mask |= 0xffu << 8 * byte;
    const uint32_t ones = word_ & mask;
    const bool begins = at == CORE_REG_CONTROL && (ones & CORE_SOFT_RESET) != 0;
    const bool low_base = at == CORE_REG_BASE_LOW && ones % CORE_LINE_BYTES != 0;

    count(CORE_COUNT_CYCLES, true);
    count(CORE_COUNT_RAYS, ray);
    count(CORE_COUNT_ANSWERS, answer);
    count(CORE_COUNT_HITS, answer && hit.failed == 0 && hit.number != CORE_NO_HIT);
    count(CORE_COUNT_RECORDS, asked && !(asked_id(top) & ray_numbers));
    count(CORE_COUNT_TRIANGLES, asked && (asked_id(top) & ray_numbers) != 0);
    count(CORE_COUNT_IDLE, !top.m_axi_arvalid);
    count(CORE_COUNT_REFUSED, top.m_axi_arvalid && !top.m_axi_arready);
    episodes.each([&](auto& one) { one.count(*this, top, at); });
    for (const RegisterWord& each : register_words) write(each, at, mask);
    most_given_ = resets_ ? 0 : std::min(std::max(most_rays(), most_given_), ray_numbers);
    if (at == CORE_REG_STATUS) sticky_ &= ~ones;
    if (low_base) sticky_ |= CORE_BASE_ERROR;
    if (came && had_error) sticky_ |= CORE_BUS_ERROR;
    if (answer && hit.failed != 0) sticky_ |= CORE_FAILED(hit.failed);

    // A soft reset ends when what was offered is taken, and all blocks have come.
    const bool ends =
        !ends_unseen && resetting_ && !resets_ && !lets_requests_ && !lets_answers_ && reading_ == 0;
    flying_ = resets_ ? 0 : flying_ + ray - answer;
    reading_ = resets_ ? 0 : reading_ + asked - came;
    const bool stays = begins || (resetting_ && !resets_);
    lets_requests_ = !stays || (lets_requests_ && top.m_axi_arvalid && !top.m_axi_arready);
    lets_answers_ = !stays || (lets_answers_ && doors.m_axis_hit_tvalid && !doors.m_axis_hit_tready);
    resetting_ = stays;
    resets_ = ends;

    written_ = writes || (written_ && !top.s_axi_bready);
    if (!has_place_) write_place_ = top.s_axi_awaddr / 4;
    if (!has_word_) word_ = top.s_axi_wdata, strobes_ = top.s_axi_wstrb;
    has_place_ = has_place_ ? !writes : top.s_axi_awvalid;
    has_word_ = has_word_ ? !writes : top.s_axi_wvalid;
  }

 private:
  // What a cycle makes of a word; in it the bits of `mask` are written at `at`.
  void write(const RegisterWord& of, uint32_t at, uint32_t mask) {
    uint32_t& old = word(of.at);
    if (of.kept != 0 && of.at == at) old = of.fitting((old & ~mask) | (word_ & mask));
    const bool resets =
        of.soft_reset == SoftReset::holds ? resetting_ : of.soft_reset == SoftReset::clears && resets_;
    if (resets || (of.is_counter && at == CORE_REG_CLEAR_COUNTERS)) old = 0;
  }
  // Bits of a word that what passes outside tells.
  uint32_t known_at(const Episodes& episodes, uint32_t at) const {
    if (CORE_HAS_ONE_ID && !Episodes::hides_requests &&
        (at == CORE_COUNT_RECORDS || at == CORE_COUNT_TRIANGLES))
      return 0;
    uint32_t known = ~uint32_t{0};
    episodes.each([&](const auto& one) { known &= one.known(*this, at); });
    return known;
  }
  uint32_t word_at(uint32_t at) const {
    if (at == CORE_REG_STATUS)
      return sticky_ | (resetting_ ? CORE_RESETTING : 0) | (flying_ == 0 && !resetting_ ? CORE_IDLE : 0);
    return word(at);
  }

  bool has_place_ = false, has_word_ = false, written_ = false, has_read_ = false, gives_ = false,
       had_ray_ = false;
  uint32_t write_place_ = 0, word_ = 0, strobes_ = 0, read_place_ = 0, given_ = 0, given_place_ = 0,
           sticky_ = 0, known_ = 0;
  std::array<uint32_t, register_bytes / 4> words_{};  // what has no behaviour of its own, and counters
  uint64_t most_given_ = 0, flying_ = 0, reading_ = 0;
  bool resetting_ = false, resets_ = false, lets_requests_ = true, lets_answers_ = true;
  bool block_comes_ = false, block_error_ = false;
};
