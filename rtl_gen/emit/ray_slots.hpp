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
#include "rtl_gen/verilog/flow_control.hpp"

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

  std::string unit;  ///< the unit's module
  int slot_bits = 0;
  std::vector<Port> line, end, test;                 ///< the unit's operands, in port order
  std::vector<std::size_t> line_places, end_places;  ///< of the ray's, among the design's operands
  std::vector<hls::Result> results;

  [[nodiscard]] std::string module() const { return unit + "_slots"; }
  [[nodiscard]] int slots() const { return 1 << slot_bits; }
  /// Operand bits that a test of the bare unit needs.
  [[nodiscard]] int bits_without() const;
  /// Bits of a test, of a ray, and of a ray's end, each with its slot. Tags are not counted.
  [[nodiscard]] int bits_of_test() const;
  [[nodiscard]] int bits_of_ray() const;
  [[nodiscard]] int bits_of_end() const;
};

/// The slots of a memory with at least as many: a power of two. Throws std::runtime_error, one line, for a
/// number that is not allowed.
[[nodiscard]] int slot_count(int least);

/// Throws std::invalid_argument, one line, for a unit that has no ready: slots need it to hold a test back.
void check_ray_slots(FlowControl flow);

/// With slot_count(least) slots. `ports` are those of the unit's module, each one of `operands`, which have
/// the roles. Throws as slot_count() does, and std::runtime_error, one line, for a unit without operands of a
/// ray and for a port that has the name of one of the wrapper's own.
[[nodiscard]] RaySlots ray_slots(const std::string& unit, const std::vector<Port>& ports,
                                 const std::vector<Port>& operands, const std::vector<hls::Result>& results,
                                 int least);

/// The wrapper in Verilog-2001, without the module of the unit.
[[nodiscard]] std::string to_verilog(const RaySlots& slots);

/// Adds the object ray_slots to a manifest.
[[nodiscard]] std::string with_ray_slots(const std::string& manifest, const RaySlots& slots);

}  // namespace hitpipe::rtl
