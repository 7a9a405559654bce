// A triangle unit with its set-up, as the check and the traversal of the integer world use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "hls/world/world_format.hpp"
#include "rays/world/int_triangle.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

/// What a unit says of a hit as a crossing, in the terms of ref::Crossing. A format has `tie` or `once`; the other
/// one is false.
struct CrossingFlags {
  bool tie = false, once = false;
  int side = 0;  ///< 1 or -1; it has a meaning only with HIT
};

/// For one thread only.
class TriangleTest {
 public:
  virtual ~TriangleTest() = default;
  [[nodiscard]] virtual const hls::WorldBits& world() const = 0;
  [[nodiscard]] virtual std::size_t operand_count() const = 0;
  virtual void start(const ref::IntRay& ray) = 0;
  /// The operands of the started ray and a triangle, in port order.
  virtual void operands(const ref::IntTriangle& triangle, std::int64_t* out) const = 0;
  /// What results say of the started ray. Nothing: no hit, or T is beyond the ray's length. Weights are 0 in
  /// a format without them.
  [[nodiscard]] virtual std::optional<ref::IntCrossing> crossing(const std::int64_t* results) const = 0;
  /// Of the started ray as if it had no end. All are 0 in a format without crossings.
  [[nodiscard]] virtual CrossingFlags crossing_flags(const std::int64_t* results) const = 0;
  /// The unit in C++.
  [[nodiscard]] virtual const rtl::Evaluate& evaluate() const = 0;
};

/// Throws std::runtime_error, one line, when the design has no such set-up, and what Design::evaluate()
/// throws.
[[nodiscard]] std::unique_ptr<TriangleTest> make_triangle_test(const rtl::Design& design,
                                                               const Format& format);

}  // namespace hitpipe::sim
