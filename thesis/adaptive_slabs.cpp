#include "thesis/adaptive_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hitpipe::thesis {

namespace {

/// A plane of the box lies up to a unit and a half inside its rounded place, and the origin within half a
/// unit of its own.
constexpr std::int64_t inward = 2;

/// product / 2^bits, rounded up.
std::int64_t trimmed_up(std::int64_t product, int bits) {
  return -(-product >> bits);
}

}  // namespace

AdaptiveSlabs::AdaptiveSlabs(const Ray& ray, hls::IntBits bits)
    : set_up_(ray, bits), trimmed_(bits.trimmed()) {
  cut(ray.length);
}

void AdaptiveSlabs::cut(float length) {
  length_ = std::isinf(length) ? std::numeric_limits<std::int64_t>::max() : set_up_.length(length);
}

Answer AdaptiveSlabs::operator()(const IntBox& box) const {
  const IntSlabsRay& ray = set_up_.ray();
  std::int64_t near = 0;
  std::int64_t far = length_;
  std::int64_t latest_near = 0;
  std::int64_t earliest_far = length_;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t floor = ray.irdvc_floor[i];
    const std::int64_t ceil = ray.irdvc_ceil[i];
    const std::int64_t low = std::int64_t{box.min[i]} - ray.origin[i];
    const std::int64_t high = std::int64_t{box.max[i]} - ray.origin[i];
    const bool backward = floor < 0;
    const std::int64_t d_near = backward ? high : low;
    const std::int64_t d_far = backward ? low : high;
    near = std::max(near, d_near * (d_near < 0 ? ceil : floor) >> trimmed_);
    far = std::min(far, d_far * (d_far < 0 ? floor : ceil) >> trimmed_);

    const std::int64_t later = d_near + (backward ? -inward : inward);
    const std::int64_t earlier = d_far - (backward ? -inward : inward);
    latest_near = std::max(latest_near, trimmed_up(later * (later < 0 ? floor : ceil), trimmed_));
    earliest_far = std::min(earliest_far, earlier * (earlier < 0 ? ceil : floor) >> trimmed_);
  }
  if (near > far) return Answer::miss;
  return latest_near <= earliest_far ? Answer::hit : Answer::ask;
}

}  // namespace hitpipe::thesis
