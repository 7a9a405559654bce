// Random rays and boxes with what the C++ makes of them, as the Coq file Cases.v: emit_cases COUNT
// HIT comes from the datapath in hls/. The operands of the float world come from the set-up in sw_ref/, those
// of the integer world are made here. Compare.v compares all with the definition that the proofs are about.
// COUNT is the number of cases of each world.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "hls/num/domain.hpp"
#include "hls/num/sized.hpp"
#include "hls/pipelines/int_major.hpp"
#include "rays/exact/binary32.hpp"
#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_major_ray.hpp"

namespace {

using namespace hitpipe;
using hls::MajorBits;
using Operands = hls::IntMajorOperands<hls::Sized, MajorBits>;

class Draw {
 public:
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(rng_); }
  bool coin() { return integer(0, 1) == 1; }

  /// A format of the smallest and of the largest widths too.
  MajorBits format() {
    for (;;) {
      const MajorBits bits{coin() ? integer(6, 24) : integer(28, 32), integer(0, 3), integer(3, 16),
                           integer(-2, 3)};
      if (bits.proved()) return bits;
    }
  }
  /// Round numbers give ties, and tiny numbers take the rare paths of the rounding code.
  float coordinate() {
    switch (integer(0, 4)) {
      case 0:
        return 0.0F;
      case 1:
        return static_cast<float>(integer(-8, 8)) / 8.0F;
      case 2:
        return tiny(7, 70);
      default:
        return std::uniform_real_distribution<float>(-1.0F, 1.0F)(rng_);
    }
  }
  /// The same with slopes: a format of the integer world.
  MajorBits integer_format() {
    MajorBits bits = format();
    bits.slope = integer(1, MajorBits::max_slope);
    return bits;
  }
  /// A number of -limit..limit: zero, small, the largest, or any.
  std::int64_t whole(std::int64_t limit) {
    switch (integer(0, 5)) {
      case 0:
        return 0;
      case 1:
        return coin() ? limit : -limit;
      case 2:
        return std::clamp<std::int64_t>(integer(-3, 3), -limit, limit);
      default:
        return std::uniform_int_distribution<std::int64_t>(-limit, limit)(rng_);
    }
  }
  float component() { return coin() ? tiny(0, 60) : coordinate(); }

  ref::Aabb box() {
    ref::Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      const float one = coordinate();
      const float other = integer(0, 3) == 0 ? one : coordinate();
      box.min[axis] = std::min(one, other);
      box.max[axis] = std::max(one, other);
    }
    return box;
  }
  /// Half of the rays aim at a corner, some of them along a face.
  ref::Ray ray(const ref::Aabb& box) {
    ref::Ray ray;
    const bool aimed = coin();
    for (int axis = 0; axis < 3; ++axis) {
      const float corner = coin() ? box.min[axis] : box.max[axis];
      const bool along = integer(0, 4) == 0;
      ray.origin[axis] = aimed && along ? corner : coordinate();
      ray.direction[axis] = !aimed ? component() : along ? 0.0F : corner - ray.origin[axis];
    }
    if (ray.direction == glm::vec3(0)) ray.direction.z = -1.0F;
    if (coin()) ray.length = coin() ? 1.0F : std::abs(tiny(0, 12));
    return ray;
  }

 private:
  float tiny(int low, int high) {
    return std::ldexp(static_cast<float>(integer(-100, 100)), -integer(low, high));
  }

  std::mt19937 rng_{1};  // NOLINT: the same cases each time
};

/// fixed_point k s is k 2^-s.
std::string rational(float x) {
  const ref::Binary32 parts = ref::decode(x);
  return fmt::format("(fixed_point ({}{}) ({}))", parts.negative ? "-" : "", parts.mantissa, -parts.exponent);
}
std::string vector(const glm::vec3& v) {
  return fmt::format("(vector {} {} {})", rational(v.x), rational(v.y), rational(v.z));
}

/// In the order of IntMajorOperands.
std::vector<std::int64_t> words(const ref::IntMajorRaySetup& set_up, float length, const ref::IntBox& box) {
  const ref::IntMajorRay& ray = set_up.ray();
  std::vector<std::int64_t> words{ray.axes[0] == 1, ray.axes[0] == 2};
  words.insert(words.end(), ray.backward.begin(), ray.backward.end());
  words.insert(words.end(), ray.origin.begin(), ray.origin.end());
  for (const ref::MajorQuotient& each : ray.quotient) {
    words.push_back(each.mantissa_low);
    words.push_back(each.mantissa_high);
  }
  for (const ref::MajorQuotient& each : ray.quotient) words.push_back(each.exponent);
  words.push_back(set_up.length(length));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    words.push_back(box.min[axis]);
    words.push_back(box.max[axis]);
  }
  return words;
}

/// A ray and a box of the integer world, by axis.
struct IntegerCase {
  int major = 0;
  std::array<std::int64_t, 3> start{}, slope{}, low{}, high{};
  std::array<bool, 3> backward{};
  std::int64_t cut = 0;
};

/// Half of the rays aim at a corner of the box, some of them along a face.
IntegerCase integer_case(Draw& draw, const MajorBits& bits) {
  IntegerCase drawn;
  const bool aimed = draw.coin();
  std::array<std::int64_t, 3> ahead{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t one = draw.whole(bits.largest_point());
    const std::int64_t other = draw.integer(0, 3) == 0 ? one : draw.whole(bits.largest_point());
    drawn.low[axis] = std::min(one, other);
    drawn.high[axis] = std::max(one, other);
    const std::int64_t corner = one * (std::int64_t{1} << bits.finer);
    const bool along = draw.integer(0, 4) == 0;
    drawn.start[axis] = aimed && along ? corner : draw.whole(bits.largest_point() << bits.finer);
    ahead[axis] = aimed ? corner - drawn.start[axis] : draw.whole(std::int64_t{1} << bits.slope);
    drawn.backward[axis] = ahead[axis] < 0 || (ahead[axis] == 0 && draw.coin());
    ahead[axis] = std::abs(ahead[axis]);
  }
  const auto largest = std::max_element(ahead.begin(), ahead.end());
  drawn.major = static_cast<int>(largest - ahead.begin());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double ratio =
        *largest == 0 ? 0.0 : static_cast<double>(ahead[axis]) / static_cast<double>(*largest);
    drawn.slope[axis] = static_cast<std::int64_t>(std::ldexp(ratio, bits.slope));
  }
  drawn.slope[static_cast<std::size_t>(drawn.major)] = std::int64_t{1} << bits.slope;
  drawn.cut = draw.coin() ? bits.largest_length() : std::abs(draw.whole(bits.largest_length()));
  return drawn;
}

/// Bounds of 2^S / slope.
ref::MajorQuotient slope_quotient(const MajorBits& bits, std::int64_t slope) {
  const auto one = std::uint32_t{1} << (bits.mantissa - 1);
  const auto largest = static_cast<std::uint32_t>(bits.largest_mantissa());
  if (slope == 0) return {one, one, bits.largest_exponent()};
  const std::int64_t dividend = std::int64_t{one} << bits.slope;
  const std::int64_t quotient = dividend / slope;
  for (int exponent = 0; exponent <= bits.largest_exponent(); ++exponent) {
    const std::int64_t low = quotient >> exponent;
    const bool exact = dividend % slope == 0 && low << exponent == quotient;
    const std::int64_t high = low + (exact ? 0 : 1);
    if (high <= largest) return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(high), exponent};
  }
  return {largest, largest, bits.largest_exponent()};
}

std::vector<std::int64_t> words(const MajorBits& bits, const IntegerCase& drawn) {
  const auto major = static_cast<std::size_t>(drawn.major);
  const std::array<std::size_t, 3> axes{major, major == 1 ? 0U : 1U, major == 2 ? 0U : 2U};
  std::vector<std::int64_t> words{major == 1, major == 2};
  for (const std::size_t axis : axes) words.push_back(drawn.backward[axis]);
  for (const std::size_t axis : axes)
    words.push_back(drawn.backward[axis] ? drawn.start[axis] + 1 : -drawn.start[axis]);
  const auto a = slope_quotient(bits, drawn.slope[axes[1]]);
  const auto b = slope_quotient(bits, drawn.slope[axes[2]]);
  words.insert(words.end(), {a.mantissa_low, a.mantissa_high, b.mantissa_low, b.mantissa_high, a.exponent,
                             b.exponent, drawn.cut});
  for (std::size_t axis = 0; axis < 3; ++axis) words.insert(words.end(), {drawn.low[axis], drawn.high[axis]});
  return words;
}

bool hit(const MajorBits& bits, const std::vector<std::int64_t>& words) {
  Operands in;
  auto word = words.begin();
  Operands::for_each(bits, in, [&](const hls::Operand& operand, auto& field) {
    field = std::decay_t<decltype(field)>(static_cast<std::uint64_t>(*word++), operand.width);
  });
  return hls::IntMajor::test<hls::Sized, MajorBits>(bits, in).hit.word() == 1;
}

std::string in_coq(const MajorBits& bits) {
  return fmt::format("{{| coord := {}; finer := {}; mantissa := {}; fraction := {}; slope := {} |}}",
                     bits.coord, bits.finer, bits.mantissa, bits.fraction, bits.slope);
}
template <class X>
std::string by_axis(const std::array<X, 3>& of) {
  return fmt::format("by_axis ({}) ({}) ({})", of[0], of[1], of[2]);
}

void emit_float_case(Draw& draw) {
  const MajorBits bits = draw.format();
  const ref::Aabb box = draw.box();
  const ref::Ray ray = draw.ray(box);
  const ref::IntMajorRaySetup set_up(ray, bits);
  const auto operands = words(set_up, ray.length, ref::quantise_box(box, bits.coord, bits.finer));
  fmt::print("  {{| format := {};\n     major := {};\n     ray := {{| origin := {}; direction := {};\n",
             in_coq(bits), "xyz"[set_up.ray().axes[0]], vector(ray.origin), vector(ray.direction));
  fmt::print("       length := {} |}};\n",
             ray.is_infinite() ? std::string("None") : "Some " + rational(ray.length));
  fmt::print("     box := {{| lo := {}; hi := {} |}};\n", vector(box.min), vector(box.max));
  fmt::print("     words := [{}];\n     answer := {} |}}", fmt::join(operands, "; "), hit(bits, operands));
}

void emit_integer_case(Draw& draw) {
  const MajorBits bits = draw.integer_format();
  const IntegerCase drawn = integer_case(draw, bits);
  const auto operands = words(bits, drawn);
  fmt::print("  {{| integer_format := {};\n     integer_major := {};\n", in_coq(bits), "xyz"[drawn.major]);
  fmt::print("     integer_ray := {{| start := {}; backward := {}; slopes := {}; cut := {} |}};\n",
             by_axis(drawn.start), by_axis(drawn.backward), by_axis(drawn.slope), drawn.cut);
  fmt::print("     integer_box := {{| lo_face := {}; hi_face := {} |}};\n", by_axis(drawn.low),
             by_axis(drawn.high));
  fmt::print("     integer_words := [{}];\n     integer_answer := {} |}}", fmt::join(operands, "; "),
             hit(bits, operands));
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1;
  Draw draw;
  const auto emit_list = [&](const char* head, auto emit) {
    fmt::print("{} := [\n", head);
    for (int i = 0; i < count; ++i) {
      emit(draw);
      fmt::print("{}\n", i + 1 < count ? ";" : "].\n");
    }
  };
  fmt::print(
      "From Coq Require Import ZArith QArith List.\n"
      "From HitpipeMajor Require Import IntMajor FloatGrid IntegerWorld Needed Compare.\n"
      "Import ListNotations.\nOpen Scope Z_scope.\n\n");
  emit_list("Definition cases : list Case", emit_float_case);
  emit_list("Definition integer_cases : list IntegerCase", emit_integer_case);
  fmt::print(
      "Theorem cases_agree : forallb agrees cases = true.\nProof. vm_compute. reflexivity. Qed.\n\n"
      "Theorem integer_cases_agree : forallb integer_agrees integer_cases = true.\n"
      "Proof. vm_compute. reflexivity. Qed.\n\n"
      "Eval vm_compute in (List.length cases, List.length (filter answer cases)).\n"
      "Eval vm_compute in (List.length integer_cases, List.length (filter integer_answer integer_cases)).\n");
}
