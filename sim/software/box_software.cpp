#include "sim/software/box_software.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "rays/exact/box_referee.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

namespace {

class IzeSlabsTest final : public BoxTest {
 public:
  void start(const ref::Ray& ray) override {
    ray_ = ray;
    irdvc_ = 1.0F / ray.direction;
  }
  bool hit(const ref::Aabb& box) override {
    constexpr float widened = 1.0F + 2 * std::numeric_limits<float>::epsilon();
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const float at_min = (box.min[axis] - ray_.origin[axis]) * irdvc_[axis];
      const float at_max = (box.max[axis] - ray_.origin[axis]) * irdvc_[axis];
      const bool backward = std::signbit(ray_.direction[axis]);
      // With a zero component a distance may be NaN. NaN compares false, so it is no constraint.
      raise(near, backward ? at_max : at_min);
      lower(far, backward ? at_min : at_max);
    }
    lower(far *= widened, ray_.length);
    return near <= far;
  }

 private:
  static void raise(float& kept, float t) { kept = t > kept ? t : kept; }
  static void lower(float& kept, float t) { kept = t < kept ? t : kept; }

  ref::Ray ray_;
  glm::vec3 irdvc_{0};
};

}  // namespace

void BoxTest::meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, std::span<bool> out) const {
  ref::BoxReferee(ray).meet(boxes, out);
}

std::array<bool, 2> BoxTest::siblings(const ref::Aabb& /*first*/, const ref::Aabb& /*second*/) {
  throw std::logic_error("a test of one box at a time has no siblings");
}

std::unique_ptr<BoxTest> make_box_test(const rtl::Design& design, const Format& format) {
  const Software& software = software_of(design);
  if (software.box_test == nullptr) throw std::runtime_error(missing(design, set_up_part));
  return software.box_test(design, format);
}

std::unique_ptr<BoxTest> ize_slabs_test() {
  return std::make_unique<IzeSlabsTest>();
}

}  // namespace hitpipe::sim
