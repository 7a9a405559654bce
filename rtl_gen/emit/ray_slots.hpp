// A memory of rays before a unit: the module <unit>_slots contains the emitted module. A ray is written to a
// slot once, and each of its tests names the slot in place of the ray's operands. Where the ray ends can be
// written alone, because a closer hit changes nothing else of it.
//
// A test of a slot that is being written waits for one cycle. So no test depends on what a memory reads while
// it is written, which differs between chips.
#pragma once

#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// When an operand changes.
enum class SentWith {
  line,  ///< only with another ray
  end,   ///< when the ray becomes shorter, too
  test,  ///< with each test
};
/// By the roles of a unit's operands. Where a unit is told at which distance a ray enters a parent box, the
/// length belongs to that box, and so to the test.
[[nodiscard]] std::vector<SentWith> sent_with(const std::vector<Port>& ports);

struct RaySlots {
  static constexpr int fewest = 2;
  static constexpr int most = 65'536;

  ModuleInterface unit;
  ModuleInterface inside;  ///< what stands behind the memory: the unit, or the wrapper with its result FIFO
  ModuleInterface interface;  ///< of the wrapper
  int slot_bits = 0;
  std::vector<Port> line, end, test;                 ///< the unit's operands, in port order
  std::vector<std::size_t> line_places, end_places;  ///< of the ray's, among the design's operands

  [[nodiscard]] const std::string& module() const { return interface.module; }
  [[nodiscard]] int slots() const { return 1 << slot_bits; }
  /// Operand bits that a test of the bare unit needs.
  [[nodiscard]] int bits_without() const;
  /// Bits of a test, of a ray, and of a ray's end, each with its slot. Tags are not counted.
  [[nodiscard]] int bits_of_test() const;
  [[nodiscard]] int bits_of_ray() const;
  [[nodiscard]] int bits_of_end() const;
  /// Of the wrapper. Without flow control a test that is read stands before the unit until it takes the next.
  [[nodiscard]] int latency(int unit_latency) const;
};

/// The slots of a memory with at least as many: a power of two. Throws std::runtime_error, one line, for a
/// number that is not allowed.
[[nodiscard]] int slot_count(int least);

/// With slot_count(least) slots, before the unit or, with `fifo`, before the wrapper with its result FIFO.
/// Without flow control a test waits for a write to its slot, and its result comes latency() cycles after it
/// was taken. The operands of the unit are some of `operands`, which have the roles. Throws as slot_count()
/// and check_names() do, and std::runtime_error, one line, for a unit without operands of a ray.
[[nodiscard]] RaySlots ray_slots(const ModuleInterface& unit, const std::vector<Port>& operands, int least,
                                 bool fifo = false);

/// The wrapper in Verilog-2001, without the module of the unit.
[[nodiscard]] std::string to_verilog(const RaySlots& slots);

/// The object ray_slots of a manifest, for a unit of that latency.
[[nodiscard]] Json ray_slots_json(const RaySlots& slots, int unit_latency);

}  // namespace hitpipe::rtl
