// The operands and results of hls::TriangleOperands (docs/integer_world.md).
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "hls/world/triangle_operands.hpp"
#include "rays/world/int128.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sim/software/place_of_result.hpp"
#include "sim/software/software.hpp"
#include "sim/software/triangle_software.hpp"

namespace hitpipe::sim {

namespace {

using hls::Meaning;
using hls::WorldBits;
using ref::Int128;

/// A number that comes in two halves.
class Halves {
 public:
  Halves(std::span<const hls::Result> results, Meaning high, Meaning low)
      : high_(place_of_result(results, high, 0)),
        low_(place_of_result(results, low, 0)),
        low_bits_(results[low_].width) {}

  [[nodiscard]] Int128 value(const std::int64_t* results) const {
    return (static_cast<Int128>(results[high_]) << low_bits_) + results[low_];
  }

 private:
  std::size_t high_, low_;
  int low_bits_;
};

class IntTriangleTest final : public TriangleTest {
  using Operands = hls::TriangleOperands<Words, WorldBits>;

 public:
  IntTriangleTest(const rtl::Design& design, const Format& format)
      : IntTriangleTest(design, format, design.results(format)) {}

  [[nodiscard]] const WorldBits& world() const override { return world_; }
  [[nodiscard]] std::size_t operand_count() const override {
    std::size_t count = 0;
    Operands::for_each(world_, in_, [&count](const hls::Operand&, std::int64_t) { ++count; });
    return count;
  }
  void start(const ref::IntRay& ray) override {
    length_ = ray.length;
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::swap(axes[0], axes[static_cast<std::size_t>(ray.major)]);
    const bool back = ray.direction[axes[0]] < 0;
    in_.major_y = ray.major == 1 ? 1 : 0;
    in_.major_z = ray.major == 2 ? 1 : 0;
    in_.back_m = back ? 1 : 0;
    in_.origin_m = ray.origin[axes[0]];
    in_.origin_a = ray.origin[axes[1]];
    in_.origin_b = ray.origin[axes[2]];
    in_.slope_a = back ? -ray.direction[axes[1]] : ray.direction[axes[1]];
    in_.slope_b = back ? -ray.direction[axes[2]] : ray.direction[axes[2]];
  }
  void operands(const ref::IntTriangle& triangle, std::int64_t* out) const override {
    Operands in = in_;
    put(triangle.corners[0], in.x0, in.y0, in.z0);
    put(triangle.corners[1], in.x1, in.y1, in.z1);
    put(triangle.corners[2], in.x2, in.y2, in.z2);
    Operands::for_each(world_, in, [&out](const hls::Operand&, std::int64_t field) { *out++ = field; });
  }
  [[nodiscard]] std::optional<ref::IntCrossing> crossing(const std::int64_t* results) const override {
    if (!evaluate_.hit(results)) return std::nullopt;
    const Int128 det = size(det_.value(results));
    if (det == 0) return std::nullopt;
    ref::IntCrossing found;
    // (|num| 2^(S+F)) / |det|, in two steps: the first quotient has at most n+g-1+F bits only where the unit
    // is right.
    const Int128 t = (size(num_.value(results)) << (world_.slope + world_.fraction)) / det;
    if (t > length_) return std::nullopt;
    found.t = static_cast<std::int64_t>(t);
    found.det = det << (2 * world_.finer);
    if (u_) {
      found.e[1] = size(u_->value(results)) << world_.finer;
      found.e[2] = size(v_->value(results)) << world_.finer;
      found.e[0] = found.det - found.e[1] - found.e[2];
    }
    return found;
  }
  [[nodiscard]] CrossingFlags crossing_flags(const std::int64_t* results) const override {
    if (world_.crossings == 0) return {};
    // A determinant has the other sign where an axis and M trade places, or D is divided by a sign.
    const bool turned = (in_.back_m ^ in_.major_y ^ in_.major_z) != 0;
    const bool back = side_ ? results[*side_] != 0 : det_.value(results) < 0;
    return {.tie = tie_ && results[*tie_] != 0,
            .once = once_ && results[*once_] != 0,
            .side = back != turned ? 1 : -1};
  }
  [[nodiscard]] const rtl::Evaluate& evaluate() const override { return evaluate_; }

 private:
  IntTriangleTest(const rtl::Design& design, const Format& format, std::span<const hls::Result> results)
      : world_(format.as<WorldBits>()),
        evaluate_(design.evaluate(format)),
        det_(results, Meaning::determinant, Meaning::determinant_low),
        num_(results, Meaning::volume, Meaning::volume_low) {
    if (world_.weights != 0) {
      u_.emplace(results, Meaning::edge_u, Meaning::edge_u_low);
      v_.emplace(results, Meaning::edge_v, Meaning::edge_v_low);
    }
    if (world_.crossings % 2 == 1) tie_ = place_of_result(results, Meaning::tie, 0);
    if (world_.crossings == 2) once_ = place_of_result(results, Meaning::once, 0);
    if (world_.crossings == 1 || world_.crossings == 2) side_ = place_of_result(results, Meaning::side, 0);
  }
  static Int128 size(Int128 x) { return x < 0 ? -x : x; }

  WorldBits world_;
  rtl::Evaluate evaluate_;
  Halves det_, num_;
  std::optional<Halves> u_, v_;
  std::optional<std::size_t> tie_, once_, side_;  ///< among the results
  Operands in_{};
  std::int64_t length_ = 0;
};

std::unique_ptr<TriangleTest> int_triangle_test(const rtl::Design& design, const Format& format) {
  return std::make_unique<IntTriangleTest>(design, format);
}

}  // namespace

Software int_triangle_software() {
  return {.triangle_test = int_triangle_test};
}

}  // namespace hitpipe::sim
