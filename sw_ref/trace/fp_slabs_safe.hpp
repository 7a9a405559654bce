// The box test of the float unit that never misses (docs/never_misses.md), for any format chosen at run time.
// It gives the same HIT as the datapath of hls/pipelines/fp_slabs_safe.hpp. It takes boxes that
// FpRounding::outward() rounded, and is a SoftwareBoxTest (sw_ref/trace/traversal.hpp).
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "rays/mesh/aabb.hpp"
#include "rays/trace/test_maker.hpp"
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"

#ifdef __FAST_MATH__
#error "truncated sums need IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {

class FpSlabsSafeTest {
 public:
  /// Throws as FpSlabsSafeRaySetup does.
  FpSlabsSafeTest(const Ray& ray, const hls::FpBits& bits);

  /// `length` must be >= 0 or infinite.
  void cut(float length);

  [[nodiscard]] bool operator()(const Aabb& box) const {
    double near = 0;
    double far = length_;
    bool behind = false;
    for (int i = 0; i < 3; ++i) {
      const Axis& axis = axes_[static_cast<std::size_t>(i)];
      const float near_plane = axis.back ? -box.max[i] : box.min[i];
      const float far_plane = axis.back ? -box.min[i] : box.max[i];
      const float d_near = cut_difference(near_plane, axis.origin_high);
      const float d_far = cut_difference(far_plane, axis.origin_low);
      behind = behind || d_far < 0.0F;
      if (d_near >= least_normal_) {
        const double t = distance(d_near, axis.inverse_low);
        near = t > near ? t : near;
      }
      const double t = distance(d_far < least_normal_ ? raised(d_far) : d_far, axis.inverse_high);
      far = t < far ? t : far;
    }
    return !behind && near <= far;
  }

 private:
  struct Axis {
    float origin_low, origin_high;
    double inverse_low, inverse_high;
    bool back;
  };

  /// a - b, rounded toward zero. If terms of one sign differ by 2 or more in their exponents, an exact result
  /// becomes one unit of its last place smaller.
  [[nodiscard]] float cut_difference(float a, float b) const {
    // Knuth's two-sum: difference + error = a - b exactly. A rounded difference that is too large is one ulp
    // too large.
    const float difference = a - b;
    const float rest = difference - a;
    const float error = (a - (difference - rest)) - (b + rest);
    auto bits = std::bit_cast<std::uint32_t>(difference);
    if (error != 0.0F && std::signbit(error) != std::signbit(difference)) --bits;
    const bool is_exact = error == 0.0F && (bits & below_) == 0;
    if (is_exact && std::signbit(a) == std::signbit(b) && std::abs(field(a) - field(b)) >= 2)
      bits -= below_ + 1;
    // A difference that is subnormal in the format has no bits here.
    return std::bit_cast<float>(bits & ~below_);
  }
  /// The exponent field of a float. A number that is subnormal in the format has the field of the least
  /// normal number.
  [[nodiscard]] int field(float x) const {
    const auto exponent = static_cast<int>(std::bit_cast<std::uint32_t>(x) << 1 >> 24);
    return exponent < least_field_ ? least_field_ : exponent;
  }
  /// What the product reads for a number below the least normal number: a number in the binade below that,
  /// with the same significand, or 1.
  [[nodiscard]] double raised(float d) const {
    constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;
    return std::bit_cast<double>((std::bit_cast<std::uint64_t>(static_cast<double>(d)) & fraction) |
                                 std::bit_cast<std::uint64_t>(static_cast<double>(least_normal_) / 2));
  }
  /// The product, exact in 48 bits, without the bits that the format does not have. A product above the
  /// largest pattern becomes it.
  [[nodiscard]] double distance(double d, double inverse) const {
    const double product = std::bit_cast<double>(std::bit_cast<std::uint64_t>(d * inverse) & ~below_double_);
    return product < largest_ ? product : largest_;
  }

  FpSlabsSafeRaySetup set_up_;
  std::array<Axis, 3> axes_{};
  float least_normal_;
  int least_field_;  ///< its exponent field
  double largest_;   ///< the pattern of which all bits are 1, as a number
  std::uint32_t below_;
  std::uint64_t below_double_;
  hls::FpBits bits_;
  double length_ = 0;
};

using FpSlabsSafeTestMaker = TestMaker<FpSlabsSafeTest, hls::FpBits>;

}  // namespace hitpipe::ref
