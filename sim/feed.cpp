#include "sim/feed.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/pipelines/int_slabs.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_ray.hpp"

namespace hitpipe::sim {

namespace {

/// Operands of IntSlabsOperands, in its order (section 6.2.1).
class IntSlabsRays final : public RayFeed {
 public:
  IntSlabsRays(const std::vector<ref::IntBox>& boxes, hls::IntBits bits, std::size_t slots)
      : boxes_(boxes), bits_(bits), slots_(slots, ref::IntRaySetup(unit_ray(), bits)), last_(slots) {}

  void start(std::size_t slot, const ref::Ray& ray) override {
    slots_[slot] = ref::IntRaySetup(ray, bits_);
    last_[slot] = {ray.length, slots_[slot].ray().length};
  }

  void operands(std::size_t slot, std::uint32_t node, float length, std::int64_t* out) const override {
    const ref::IntRaySetup& setup = slots_[slot];
    const ref::IntRay& ray = setup.ray();
    Length& cut = last_[slot];
    if (cut.given != length) cut = {length, setup.length(length)};
    for (const std::int32_t o : ray.origin) *out++ = o;
    *out++ = cut.irlen;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *out++ = ray.irdvc_floor[axis];
      *out++ = ray.irdvc_ceil[axis];
    }
    *out++ = std::isinf(length) ? 1 : 0;
    const ref::IntBox& box = boxes_[node];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *out++ = box.min[axis];
      *out++ = box.max[axis];
    }
  }

 private:
  struct Length {
    float given = 0;
    std::int64_t irlen = 0;
  };
  static ref::Ray unit_ray() { return {glm::vec3(0), glm::vec3(1), ref::Ray::infinite}; }

  const std::vector<ref::IntBox>& boxes_;
  hls::IntBits bits_;
  std::vector<ref::IntRaySetup> slots_;
  mutable std::vector<Length> last_;  // a ray's length changes only when a closer hit is found
};

class IntSlabsScene final : public SceneFeed {
 public:
  IntSlabsScene(const ref::Bvh& bvh, hls::IntBits bits) : bits_(bits) {
    boxes_.reserve(bvh.nodes.size());
    for (const ref::BvhNode& node : bvh.nodes) boxes_.push_back(ref::quantise_box(node.box, bits.coord));
  }
  [[nodiscard]] std::unique_ptr<RayFeed> unit(std::size_t slots) const override {
    return std::make_unique<IntSlabsRays>(boxes_, bits_, slots);
  }

 private:
  hls::IntBits bits_;
  std::vector<ref::IntBox> boxes_;
};

}  // namespace

std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, hls::IntBits bits, const ref::Bvh& bvh) {
  if (design.name == hls::IntSlabs::name) return std::make_unique<IntSlabsScene>(bvh, bits);
  throw std::runtime_error(
      fmt::format("design {}: there is no set-up of rays and boxes for its operands", design.name));
}

}  // namespace hitpipe::sim
