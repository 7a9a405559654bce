// Makes the box test of each ray: a functor of (const Ray&).
#pragma once

#include <tuple>

#include "hls/box/int_format.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rays/world/ray_check.hpp"

namespace hitpipe::ref {

/// Makes Test(ray, parts...).
template <class Test, class... Parts>
class TestMaker {
 public:
  explicit TestMaker(const Parts&... parts) : parts_(parts...) {}

  [[nodiscard]] Test operator()(const Ray& ray) const {
    return std::apply([&](const Parts&... parts) { return Test(ray, parts...); }, parts_);
  }

 private:
  std::tuple<Parts...> parts_;
};

/// Makes the test of an integer unit.
template <class Test>
struct IntTestMaker : TestMaker<Test, hls::IntBits, CoarseAxes> {
  /// Throws std::invalid_argument unless an integer unit can have the format and these dropped bits.
  explicit IntTestMaker(hls::IntBits bits, const CoarseAxes& coarse = {})
      : TestMaker<Test, hls::IntBits, CoarseAxes>(bits, coarse) {
    check_format(bits, Test::maker_name);
    check_coarse(coarse, bits.coord, Test::maker_name);
  }
};

}  // namespace hitpipe::ref
