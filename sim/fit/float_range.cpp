#include "sim/fit/float_range.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_inverse.hpp"

namespace hitpipe::sim {

namespace {

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Which signs the family's directions have along the axis. That of a zero is not bounded, unless all
/// directions are one.
struct Signs {
  bool positive, negative;

  Signs(const ref::RayFamily& family, int axis) {
    const float low = family.direction.min[axis];
    const float high = family.direction.max[axis];
    const bool one = same_bits(low, high);
    negative = one ? std::signbit(low) : low <= 0.0F;
    positive = one ? !std::signbit(low) : high >= 0.0F;
  }
};

}  // namespace

void FloatRange::add(float low, float high) {
  const std::int64_t sign = std::int64_t{1} << (bits_.width() - 1);
  const auto pattern = [&](float x) { return ref::fp_pattern(x, bits_); };
  if (!std::signbit(high)) grow(positive_, {std::signbit(low) ? 0 : pattern(low), pattern(high)});
  if (std::signbit(low)) grow(negative_, {std::signbit(high) ? pattern(high) : sign, pattern(low)});
}

std::vector<rtl::Interval> FloatRange::within() const {
  std::vector<rtl::Interval> all;
  for (const Range& range : {positive_, negative_})
    if (range) all.push_back(*range);
  return all;
}

std::vector<rtl::Interval> mirrored_origin(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits,
                                           bool low) {
  const ref::FpRounding rounding(bits);
  FloatRange range(bits);
  const auto add = [&](float from, float to) {
    range.add(low ? rounding.down(from) : rounding.up(from), low ? rounding.down(to) : rounding.up(to));
  };
  for (const ref::RayFamily& family : scene.rays) {
    float from = family.origin.min[axis];
    float to = family.origin.max[axis];
    if (!same_bits(from, to)) {  // a zero at an end may have either sign
      from = from == 0.0F ? -0.0F : from;
      to = to == 0.0F ? 0.0F : to;
    }
    const Signs signs(family, axis);
    if (signs.positive) add(from, to);
    if (signs.negative) add(-to, -from);
  }
  return range.within();
}

std::vector<rtl::Interval> rounded_planes(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits,
                                          bool low) {
  const ref::FpRounding rounding(bits);
  const auto rounded = [&](const glm::vec3& at) {
    const ref::Aabb plane = rounding.outward({at, at});
    return (low ? plane.min : plane.max)[axis];
  };
  FloatRange range(bits);
  range.add(rounded(scene.boxes.min), rounded(scene.boxes.max));
  return range.within();
}

rtl::Interval scaled_inverse(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits, bool low) {
  const auto bound = [&](const ref::FpInverse& inverse) { return low ? inverse.low : inverse.high; };
  const auto i = static_cast<std::size_t>(axis);
  Range range;
  for (const ref::RayFamily& family : scene.rays) {
    const Magnitudes d(family.direction);
    const auto scale_of = [](const std::array<double, 3>& sizes) {
      return ref::up_to_power(static_cast<float>(*std::max_element(sizes.begin(), sizes.end()))).exponent;
    };
    const std::int64_t most = bound(ref::fp_inverse(scale_of(d.most), static_cast<float>(d.least[i]), bits));
    std::int64_t least = bits.one();
    if (*std::max_element(d.least.begin(), d.least.end()) > 0.0) {
      const int scale = scale_of(d.least);
      const double size = std::min(d.most[i], std::ldexp(1.0, scale));  // no component exceeds its scale
      least = bound(ref::fp_inverse(scale, static_cast<float>(size), bits));
    }
    grow(range, {least, most});
  }
  return *range;
}

rtl::Interval backward(const ref::SceneDemands& scene, int axis) {
  bool ever = false;
  bool always = true;
  for (const ref::RayFamily& family : scene.rays) {
    const Signs signs(family, axis);
    ever = ever || signs.negative;
    always = always && !signs.positive;
  }
  return {always ? 1 : 0, ever ? 1 : 0};
}

}  // namespace hitpipe::sim
