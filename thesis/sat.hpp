// The separating axis test of a segment and a box (section 2.3.3; Gregory et al. 1999), for rays of the [-1,
// 1] cube, which become segments that leave the cube. There are six axes: the three of the box, and their
// cross products with the segment. It gives no distance. All coordinates are doubled, so that no centre needs
// a division by two.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

template <class T>
struct Sat {
  static constexpr bool has_distance = false;
  using Vec = glm::vec<3, T>;

  struct Ray {
    Vec ends;    ///< sum of both ends: twice the centre
    Vec vector;  ///< from end to end
    Vec size;    ///< its magnitude along each axis

    /// More than the cube's side along the largest component of the direction.
    explicit Ray(const ref::Ray& ray) {
      const Vec d(ray.direction);
      const Vec magnitude = absolute(d);
      vector = d / std::max({magnitude.x, magnitude.y, magnitude.z}) * T(2.125);
      ends = T(2) * Vec(ray.origin) + vector;
      size = absolute(vector);
    }
  };

  static bool test(const Ray& ray, const BasicAabb<T>& box, T& /*entry*/) {
    const Vec apart = ray.ends - (box.min + box.max);
    const Vec side = box.max - box.min;
    const Vec reach = absolute(apart) - (side + ray.size);
    if (reach.x > 0 || reach.y > 0 || reach.z > 0) return false;
    const Vec moment = absolute(glm::cross(apart, ray.vector));
    return moment.x <= side.y * ray.size.z + side.z * ray.size.y &&
           moment.y <= side.z * ray.size.x + side.x * ray.size.z &&
           moment.z <= side.x * ray.size.y + side.y * ray.size.x;
  }

 private:
  static Vec absolute(const Vec& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
};

}  // namespace hitpipe::thesis
