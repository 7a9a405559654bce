#include "sw_ref/trace/int_slabs.hpp"

#include <cmath>
#include <limits>

#include "sw_ref/quantise/ray_check.hpp"

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

IntSlabsTestMaker::IntSlabsTestMaker(hls::IntBits bits, const CoarseAxes& coarse)
    : bits_(bits), coarse_(coarse) {
  check_format(bits, "IntSlabsTestMaker");
  check_coarse(coarse, bits.coord, "IntSlabsTestMaker");
}

}  // namespace hitpipe::ref
