#include "sw_ref/trace/int_plucker.hpp"

#include "hls/pipelines/int_plucker.hpp"
#include "sw_ref/quantise/ray_check.hpp"

namespace hitpipe::ref {

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

IntPluckerTestMaker::IntPluckerTestMaker(hls::IntBits bits, const CoarseAxes& coarse)
    : bits_(bits), coarse_(coarse) {
  check_format(bits, "IntPluckerTestMaker");
  check_coarse(coarse, bits.coord, "IntPluckerTestMaker");
}

}  // namespace hitpipe::ref
