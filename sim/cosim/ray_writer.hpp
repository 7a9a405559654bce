// Sends the rays of a ray unit to the slots of its memory (rtl_gen/emit/ray_slots.hpp): a ray when it starts,
// and its end when a closer hit shortens it. In each cycle one ray can be written beside the test of another.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "rtl_gen/emit/ray_slots.hpp"
#include "sim/model/pins.hpp"

namespace hitpipe::sim {

class RayWriter {
 public:
  /// There is a ray in each of the first `rays` slots.
  RayWriter(const rtl::RaySlots& slots, std::size_t operand_count, std::size_t rays);

  /// Another ray starts in the slot. It is written when it has its first test.
  void start(std::size_t slot) { rays_[slot].clear(); }
  /// The slot's next test has these operands, in port order. True when the memory already holds what they say
  /// of the ray. Otherwise a write waits, and the test must not be sent before written() names the slot.
  [[nodiscard]] bool holds(std::size_t slot, const std::int64_t* operands);

  /// Before a cycle: offers the oldest write. The test in this cycle is of the slot that is its tag.
  void drive(Pins& pins);
  /// After a cycle: the slot that was written in it.
  [[nodiscard]] std::optional<std::size_t> written();

  [[nodiscard]] bool idle() const { return waiting_.empty(); }
  [[nodiscard]] std::uint64_t rays_written() const { return rays_written_; }
  [[nodiscard]] std::uint64_t ends_written() const { return ends_written_; }

 private:
  struct Write {
    std::size_t slot;
    bool end_only;
  };

  std::size_t operand_count_;
  std::vector<std::size_t> line_, end_;          // places of the ray's operands
  std::vector<std::vector<std::int64_t>> rays_;  // by slot: operands of which the memory has the ray's part
  std::deque<Write> waiting_;
  RayPins pins_;
  std::uint64_t rays_written_ = 0;
  std::uint64_t ends_written_ = 0;
};

}  // namespace hitpipe::sim
