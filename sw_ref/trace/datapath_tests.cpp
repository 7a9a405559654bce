// Set-up of the box tests that answer as a datapath does.
#include <cmath>
#include <limits>

#include "hls/pipelines/int_plucker.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/trace/fp_slabs_safe.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"

namespace hitpipe::ref {

// The datapath compares near with far, far with 0 and, unless the ray is infinite, near with the length. As
// length >= 0, far >= 0, near <= far and near <= length together mean max(near, 0) <= min(far, length). An
// infinite ray has the longest possible length.

IntSlabsTest::IntSlabsTest(const Ray& ray, hls::IntBits bits, const CoarseAxes& coarse)
    : set_up_(ray, bits), trimmed_(bits.trimmed()) {
  const IntSlabsRay& prepared = set_up_.ray();
  const IntOrigin origin = coarse_origin(prepared.origin, coarse, bits.coord);
  for (std::size_t i = 0; i < 3; ++i) {
    axes_[i] = {origin[i], prepared.irdvc_floor[i], prepared.irdvc_ceil[i], prepared.irdvc_floor[i] < 0};
  }
  cut(ray.length);
}

void IntSlabsTest::cut(float length) {
  length_ = std::isinf(length) ? std::numeric_limits<std::int64_t>::max() : set_up_.length(length);
}

IntPluckerTest::IntPluckerTest(const Ray& ray, hls::IntBits bits, const CoarseAxes& coarse)
    : set_up_(ray, bits), trimmed_(bits.trimmed()), edge_bound_(hls::int_plucker::edge_bound(bits)) {
  const IntPluckerRay& prepared = set_up_.ray();
  const IntOrigin origin = coarse_origin(prepared.origin, coarse, bits.coord);
  for (std::size_t i = 0; i < 3; ++i) {
    axes_[i] = {origin[i], prepared.direction[i], 0, prepared.direction[i] < 0};
  }
  set_end(prepared.end);
}

void IntPluckerTest::cut(float length) {
  set_end(set_up_.endpoint(length));
}

void IntPluckerTest::set_end(const IntEndpoint& end) {
  constexpr std::int64_t beyond_all = std::int64_t{1} << 32;
  for (std::size_t i = 0; i < 3; ++i) {
    axes_[i].end = !end.infinite ? end.at[i] : axes_[i].minus ? -beyond_all : beyond_all;
  }
}

FpSlabsSafeTest::FpSlabsSafeTest(const Ray& ray, const hls::FpBits& bits)
    : set_up_(ray, bits),
      least_normal_(std::ldexp(1.0F, 1 - bits.bias())),
      least_field_(128 - bits.bias()),
      largest_(std::ldexp(std::ldexp(1.0, bits.fraction + 1) - 1.0, bits.bias() + 1 - bits.fraction)),
      below_((1U << (23 - bits.fraction)) - 1),
      below_double_((std::uint64_t{1} << (52 - bits.fraction)) - 1),
      bits_(bits) {
  const FpSlabsSafeRay& prepared = set_up_.ray();
  for (std::size_t i = 0; i < 3; ++i)
    axes_[i] = {prepared.origin_low[i], prepared.origin_high[i], fp_number(prepared.inverse_low[i], bits),
                fp_number(prepared.inverse_high[i], bits), prepared.back[i]};
  cut(ray.length);
}

void FpSlabsSafeTest::cut(float length) {
  const FpSlabsSafeEnd end = set_up_.end(length);
  length_ = end.endless ? std::numeric_limits<double>::infinity() : fp_number(end.length, bits_);
}

}  // namespace hitpipe::ref
