// Operands of hls::IntPluckerOperands, in its order (section 6.3.1).
#include "sim/feeds/feeds.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"

namespace hitpipe::sim {

namespace {

class IntPluckerSetUp {
 public:
  using Box = ref::IntBox;
  using End = ref::IntEndpoint;

  IntPluckerSetUp(const ref::Ray& ray, rtl::Format format) : set_up_(ray, format.bits()) {}

  static void boxes(std::span<const ref::Aabb> boxes, rtl::Format format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.bits().coord, out);
  }
  [[nodiscard]] End end(float length) const { return set_up_.endpoint(length); }

  void write(const End& end, bool /*rinf*/, const Box& box, std::int64_t* out) const {
    const ref::IntPluckerRay& ray = set_up_.ray();
    out = put(ray.origin, out);
    out = put(end.at, out);
    out = put(ray.direction, out);
    *out++ = end.infinite ? 1 : 0;
    put_box(box, out);
  }

 private:
  ref::IntPluckerRaySetup set_up_;
};

}  // namespace

std::unique_ptr<SceneFeed> int_plucker_feed(rtl::Format format, const ref::Bvh& bvh) {
  return std::make_unique<SetUpScene<IntPluckerSetUp>>(format, bvh);
}

std::unique_ptr<BoxTest> int_plucker_test(const rtl::Design& design, rtl::Format format) {
  return std::make_unique<SetUpTest<IntPluckerSetUp>>(design, format);
}

}  // namespace hitpipe::sim
