// Operands of hls::FpPluckerOperands, in its order (section 3.3).
#include <algorithm>

#include "sim/feeds/feeds.hpp"
#include "sim/feeds/float_patterns.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/quantise/float_ray.hpp"

namespace hitpipe::sim {

namespace {

class FpPluckerSetUp {
 public:
  using Box = PatternBox;
  using End = ref::FloatEndpoint;

  FpPluckerSetUp(const ref::Ray& ray, rtl::Format /*binary32*/) : ray_(ray) {}

  static void boxes(std::span<const ref::Aabb> boxes, rtl::Format /*binary32*/, std::span<Box> out) {
    std::transform(boxes.begin(), boxes.end(), out.begin(), [](const ref::Aabb& box) { return Box(box); });
  }
  [[nodiscard]] End end(float length) const { return ref::float_endpoint(ray_, length); }

  void write(const End& end, bool /*rinf*/, const Box& box, std::int64_t* out) const {
    out = put(patterns(ray_.origin), out);
    out = put(patterns(end.at), out);
    out = put(patterns(ray_.direction), out);
    *out++ = end.infinite ? 1 : 0;
    put_box(box, out);
  }

 private:
  ref::Ray ray_;
};

}  // namespace

std::unique_ptr<SceneFeed> fp_plucker_feed(rtl::Format format, const ref::Bvh& bvh) {
  return std::make_unique<SetUpScene<FpPluckerSetUp>>(format, bvh);
}

std::unique_ptr<BoxTest> fp_plucker_test(const rtl::Design& design, rtl::Format format) {
  return std::make_unique<SetUpTest<FpPluckerSetUp>>(design, format);
}

}  // namespace hitpipe::sim
