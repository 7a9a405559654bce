// Operands of hls::IntSlabsOperands, in its order (section 6.2.1).
#include "sim/feeds/feeds.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"

namespace hitpipe::sim {

namespace {

class IntSlabsSetUp {
 public:
  using Box = ref::IntBox;
  using End = std::int64_t;

  IntSlabsSetUp(const ref::Ray& ray, rtl::Format format) : set_up_(ray, format.bits()) {}

  static void boxes(std::span<const ref::Aabb> boxes, rtl::Format format, std::span<Box> out) {
    ref::quantise_boxes(boxes, format.bits().coord, out);
  }
  [[nodiscard]] End end(float length) const { return set_up_.length(length); }

  void write(End irlen, bool rinf, const Box& box, std::int64_t* out) const {
    const ref::IntSlabsRay& ray = set_up_.ray();
    out = put(ray.origin, out);
    *out++ = irlen;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *out++ = ray.irdvc_floor[axis];
      *out++ = ray.irdvc_ceil[axis];
    }
    *out++ = rinf ? 1 : 0;
    put_box(box, out);
  }

 private:
  ref::IntSlabsRaySetup set_up_;
};

}  // namespace

std::unique_ptr<SceneFeed> int_slabs_feed(rtl::Format format, const ref::Bvh& bvh) {
  return std::make_unique<SetUpScene<IntSlabsSetUp>>(format, bvh);
}

std::unique_ptr<BoxTest> int_slabs_test(const rtl::Design& design, rtl::Format format) {
  return std::make_unique<SetUpTest<IntSlabsSetUp>>(design, format);
}

}  // namespace hitpipe::sim
