// Box tests that make their distances in the ways of hls/experiment/slab_forms.hpp, with the bounds that each
// needs (docs/safe_floats.md, "Fusion"). None misses a box that the ray meets. They run the bit-level code,
// so they are slow.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <boost/multiprecision/cpp_int.hpp>

#include "hls/box/fp_format.hpp"
#include "hls/experiment/slab_forms.hpp"
#include "hls/num/domain.hpp"
#include "sw_ref/exact/binary32.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"

namespace hitpipe::ref {

enum class SlabForm : std::uint8_t {
  plain,           ///< that of fp_slabs_safe
  exact,           ///< with a difference that is cut exactly toward zero
  short_product,   ///< `plain`, and a product without its lowest partial products
  fused,           ///< A: the difference is neither normalised nor rounded before the product
  separate,        ///< B: plane * inverse - origin * inverse
  separate_fused,  ///< C: the same with all bits of the product
};

/// A bound of the set-up that is left out on purpose, so that a test can see that it is needed.
enum class LeftOut : std::uint8_t { nothing, factor, offset };

/// num / den * 2^exponent, rounded to a pattern without sign; not above infinity.
[[nodiscard]] inline std::int64_t rounded_ratio(boost::multiprecision::cpp_int num,
                                                boost::multiprecision::cpp_int den, int exponent, bool up,
                                                const hls::AnyFpBits& bits) {
  if (num == 0) return 0;
  const int shift = exponent - (1 - bits.bias() - bits.fraction);  // to units of the least subnormal number
  if (shift >= 0) {
    num <<= shift;
  } else {
    den <<= -shift;
  }
  const boost::multiprecision::cpp_int units = num / den;
  const int width = units == 0 ? 0 : static_cast<int>(boost::multiprecision::msb(units)) + 1;
  const int dropped = std::max(0, width - bits.fraction - 1);
  const boost::multiprecision::cpp_int kept = units >> dropped;
  const boost::multiprecision::cpp_int least = (kept * den) << dropped;
  const bool exact = least == num;
  // The implicit one adds 1 to the exponent field.
  const std::int64_t pattern = (std::int64_t{dropped} << bits.fraction) + static_cast<std::int64_t>(kept);
  return std::min(up && !exact ? pattern + 1 : pattern, bits.infinity());
}

/// A multiplier of the short product leaves at least Guard bits of it below M fraction bits alone.
template <int E, int M, SlabForm Form, int Guard = 2, LeftOut Fault = LeftOut::nothing>
class SlabFormTest {
 public:
  /// Six patterns, rounded outward.
  struct Box {
    std::array<std::int64_t, 3> min{}, max{};
  };

  explicit SlabFormTest(const Ray& ray) : set_up_(ray, bits) {
    const FpSlabsSafeRay& rounded = set_up_.ray();
    const glm::vec3 size = glm::abs(ray.direction);
    int scale = 0;  // the smallest power of two that no component exceeds
    if (std::frexp(std::max({size.x, size.y, size.z}), &scale) == 0.5F) --scale;
    for (int i = 0; i < 3; ++i) {
      Axis& axis = axes_[static_cast<std::size_t>(i)];
      axis.back = rounded.back[static_cast<std::size_t>(i)];
      axis.origin_low = fp_pattern(rounded.origin_low[static_cast<std::size_t>(i)], bits);
      axis.origin_high = fp_pattern(rounded.origin_high[static_cast<std::size_t>(i)], bits);
      axis.inverse_low = axis.inverse_high = bits.infinity();
      axis.parallel = size[i] == 0.0F;
      const Binary32 d = decode(size[i]);
      if (!axis.parallel) {
        const Int one = Int(1) << M;
        const int exponent = scale - d.exponent;
        axis.inverse_low = std::min(bits.infinity() - 1, rounded_ratio(1, d.mantissa, exponent, false, bits));
        // What makes up for a rounded factor of the product, and for partial products that are left out.
        const bool cuts = Form != SlabForm::separate_fused && Fault != LeftOut::factor;
        const Int less = cuts && cut > 0 ? Int(1) << (2 * M - half - cut) : Int(0);
        Int num = cuts ? one + 1 : one;
        Int den = one * d.mantissa;
        if (less != 0) {
          num *= less;
          den *= less - 1;
        }
        axis.inverse_high = rounded_ratio(num, den, exponent, true, bits);
      }
      if constexpr (is_separate) set_offset(axis, axis.back ? -ray.origin[i] : ray.origin[i], d, scale);
    }
    shorten(ray.length);
  }

  [[nodiscard]] static Box round(const Aabb& box) {
    const Aabb rounded = FpRounding(bits).outward(box);
    Box out;
    for (int i = 0; i < 3; ++i) {
      out.min[static_cast<std::size_t>(i)] = fp_pattern(rounded.min[i], bits);
      out.max[static_cast<std::size_t>(i)] = fp_pattern(rounded.max[i], bits);
    }
    return out;
  }

  /// `length` must be >= 0 or infinite.
  void shorten(float length) { end_ = set_up_.end(length); }

  [[nodiscard]] bool operator()(const Box& box) const {
    std::int64_t near = 0;
    std::int64_t far = most;
    bool behind = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Axis& axis = axes_[i];
      const Distance to_near = distance(axis, axis.back ? box.max[i] ^ sign_bit : box.min[i], true);
      const Distance to_far = distance(axis, axis.back ? box.min[i] ^ sign_bit : box.max[i], false);
      if (!to_near.negative) near = std::max(near, to_near.pattern);
      behind = behind || to_far.negative;
      far = std::min(far, to_far.pattern);
    }
    return !behind && near <= far && (end_.endless || near <= end_.length);
  }

 private:
  using Int = boost::multiprecision::cpp_int;
  using Format = hls::FpFormat<E, M>;
  using Number = hls::ap_uint<1 + E + M>;
  using Magnitude = hls::ap_uint<E + M>;
  static constexpr hls::AnyFpBits bits{E, M};
  static constexpr std::int64_t sign_bit = std::int64_t{1} << (E + M);
  static constexpr std::int64_t most = sign_bit - 1;
  static constexpr int half = (M + 1) / 2;
  static constexpr int cut = Form == SlabForm::short_product ? std::max(0, M - half - Guard) : 0;
  static constexpr bool is_separate = Form == SlabForm::separate || Form == SlabForm::separate_fused;

  struct Axis {
    bool back = false;
    bool parallel = false;  ///< `separate`: far planes are infinitely far, unless they are behind
    std::int64_t origin_low = 0, origin_high = 0;
    std::int64_t inverse_low = 0, inverse_high = 0;
    std::int64_t offset_low = 0, offset_high = 0;  ///< bounds of origin * inverse
  };
  struct Distance {
    std::int64_t pattern;
    bool negative;
  };

  /// Along an axis that is parallel, or too nearly so for the format, the highest power of two serves as the
  /// inverse: its products are exact.
  static void set_offset(Axis& axis, float origin, const Binary32& d, int scale) {
    const std::int64_t highest = (2 * std::int64_t{bits.bias()}) << M;
    axis.parallel = axis.parallel || axis.inverse_high >= bits.infinity() || axis.inverse_low >= highest;
    if (axis.parallel) axis.inverse_low = axis.inverse_high = highest;
    const Binary32 o = decode(origin);
    const Int den = axis.parallel ? 1 : d.mantissa;
    const int exponent = o.exponent + (axis.parallel ? bits.bias() : scale - d.exponent);
    std::int64_t down = rounded_ratio(o.mantissa, den, exponent, false, bits);
    std::int64_t up = Fault == LeftOut::offset ? down : rounded_ratio(o.mantissa, den, exponent, true, bits);
    // C takes no subnormal offset.
    const std::int64_t least_normal = std::int64_t{1} << M;
    if (down < least_normal) down = 0;
    if (up != 0 && Fault != LeftOut::offset) up = std::max(up, least_normal);
    axis.offset_low = o.negative ? sign_bit | up : down;
    axis.offset_high = o.negative ? sign_bit | down : up;
  }

  [[nodiscard]] static Distance parts(const Number& x) {
    const auto pattern = static_cast<std::int64_t>(x.word());
    return {pattern & most, (pattern & sign_bit) != 0};
  }

  [[nodiscard]] Distance distance(const Axis& axis, std::int64_t plane, bool near) const {
    using hls::Native;
    const Format format;
    const Number p(plane);
    const Number origin(near ? axis.origin_high : axis.origin_low);
    const Magnitude inverse(near ? axis.inverse_low : axis.inverse_high);
    const hls::slab_forms::Bound<Native::bit> bound{Native::bit(near ? 1 : 0)};
    if constexpr (Form == SlabForm::fused) {
      return parts(Number(hls::slab_forms::fused<Native>(format, p, origin, inverse, bound)));
    } else if constexpr (is_separate) {
      const Magnitude other(near ? axis.inverse_high : axis.inverse_low);
      const Number offset(near ? axis.offset_high : axis.offset_low);
      const hls::slab_forms::Inverses<Magnitude> inverses{inverse, other};
      Distance result =
          parts(Form == SlabForm::separate
                    ? Number(hls::slab_forms::separate<Native>(format, p, inverses, offset, bound))
                    : Number(hls::slab_forms::separate_fused<Native>(format, p, inverses, offset, bound)));
      if (axis.parallel && !near) result.pattern = most;
      return result;
    } else {
      const Distance d =
          parts(Form == SlabForm::exact ? hls::slab_forms::subtract_exact<Native>(format, p, origin)
                                        : hls::fp_logic::subtract_rz<Native>(format, p, origin));
      // The product takes a subnormal number for a larger one.
      if (near && d.pattern >> M == 0) return {0, d.negative};
      const Magnitude size(d.pattern);
      const Magnitude t =
          Form == SlabForm::short_product
              ? hls::slab_forms::multiply_short<Native>(format, size, inverse, hls::Width<cut>())
              : hls::fp_logic::multiply_rz<Native>(format, size, inverse);
      return {static_cast<std::int64_t>(t.word()), d.negative};
    }
  }

  FpSlabsSafeRaySetup set_up_;
  FpSlabsSafeEnd end_{};
  std::array<Axis, 3> axes_{};
};

}  // namespace hitpipe::ref
