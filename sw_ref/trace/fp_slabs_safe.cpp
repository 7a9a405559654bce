#include "sw_ref/trace/fp_slabs_safe.hpp"

#include "sw_ref/quantise/fp_box.hpp"

namespace hitpipe::ref {

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
