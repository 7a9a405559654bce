#include "sim/check/box_test.hpp"

#include <limits>
#include <optional>

#include "sw_ref/traverse/slabs.hpp"

namespace hitpipe::sim {

namespace {

class RobustFloatSlabsTest final : public BoxTest {
 public:
  void start(const ref::Ray& ray) override {
    ray_ = ray;
    irdvc_ = 1.0F / ray.direction;
    faces_.emplace(ray.direction);
  }
  bool hit(const ref::Aabb& box) override {
    constexpr float widened = 1.0F + 2 * std::numeric_limits<float>::epsilon();
    const ref::SlabInterval t(box, *faces_, ray_.origin, irdvc_, std::numeric_limits<float>::infinity());
    const float far = t.far * widened;
    return t.near <= (far < ray_.length ? far : ray_.length);
  }

 private:
  ref::Ray ray_;
  glm::vec3 irdvc_{0};
  std::optional<ref::SlabFaces> faces_;
};

}  // namespace

std::unique_ptr<BoxTest> robust_float_slabs_test() {
  return std::make_unique<RobustFloatSlabsTest>();
}

}  // namespace hitpipe::sim
