// Random rays and boxes with what the C++ makes of them, as the Coq file Cases.v: emit_cases COUNT
// The operands come from the set-up in sw_ref/, and HIT from the datapath in hls/. Compare.v compares both
// with the definition that the proofs are about.
#include <algorithm>
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
#include "sw_ref/judge/binary32.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_major_ray.hpp"
#include "sw_ref/scene/aabb.hpp"
#include "sw_ref/scene/ray.hpp"

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

bool hit(const MajorBits& bits, const std::vector<std::int64_t>& words) {
  Operands in;
  auto word = words.begin();
  Operands::for_each(bits, in, [&](const hls::Operand& operand, auto& field) {
    field = std::decay_t<decltype(field)>(static_cast<std::uint64_t>(*word++), operand.width);
  });
  return hls::IntMajor::test<hls::Sized, MajorBits>(bits, in).hit.word() == 1;
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1;
  fmt::print(
      "From Coq Require Import ZArith QArith List.\n"
      "From HitpipeMajor Require Import IntMajor FloatGrid Needed Compare.\n"
      "Import ListNotations.\nOpen Scope Z_scope.\n\nDefinition cases : list Case := [\n");
  Draw draw;
  for (int i = 0; i < count; ++i) {
    const MajorBits bits = draw.format();
    const ref::Aabb box = draw.box();
    const ref::Ray ray = draw.ray(box);
    const ref::IntMajorRaySetup set_up(ray, bits);
    const auto operands = words(set_up, ray.length, ref::quantise_box(box, bits.coord, bits.finer));
    fmt::print("  {{| format := {{| coord := {}; finer := {}; mantissa := {}; fraction := {} |}};\n",
               bits.coord, bits.finer, bits.mantissa, bits.fraction);
    fmt::print("     major := {};\n     ray := {{| origin := {}; direction := {};\n",
               "xyz"[set_up.ray().axes[0]], vector(ray.origin), vector(ray.direction));
    fmt::print("       length := {} |}};\n",
               ray.is_infinite() ? std::string("None") : "Some " + rational(ray.length));
    fmt::print("     box := {{| lo := {}; hi := {} |}};\n", vector(box.min), vector(box.max));
    fmt::print("     words := [{}];\n     answer := {} |}}{}\n", fmt::join(operands, "; "),
               hit(bits, operands), i + 1 < count ? ";" : "");
  }
  fmt::print(
      "].\n\nTheorem cases_agree : forallb agrees cases = true.\nProof. vm_compute. reflexivity. Qed.\n\n"
      "Eval vm_compute in (List.length cases, List.length (filter answer cases)).\n");
}
