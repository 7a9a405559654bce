#include "library/shapes.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "library/failure.hpp"
#include "rays/exact/box_referee.hpp"
#include "rays/world/ray_check.hpp"

namespace hitpipe::library {

namespace {

glm::vec3 vector(const float (&v)[3]) {  // NOLINT(modernize-avoid-c-arrays): the C interface has them
  return {v[0], v[1], v[2]};
}

std::string why_refused(const ref::Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    const float low = box.min[axis];
    const float high = box.max[axis];
    if (!(std::abs(low) <= 1.0F))
      return fmt::format("min.{} = {} is outside the cube; allowed is [-1, 1]", name, low);
    if (!(std::abs(high) <= 1.0F))
      return fmt::format("max.{} = {} is outside the cube; allowed is [-1, 1]", name, high);
    if (low > high) return fmt::format("min.{0} = {1} is above max.{0} = {2}", name, low, high);
  }
  return "";
}

/// Throws a Refusal, which calls the ray by this name.
void refuse_unless_acceptable(const ref::Ray& ray, std::string_view name) {
  try {
    ref::check_ray(ray, name);
    ref::check_length(ray.length, name);
  } catch (const std::logic_error& refused) {
    throw Refusal(HITPIPE_BAD_RAY, refused.what());
  }
}

}  // namespace

ref::Ray checked(const hitpipe_ray& ray) {
  const ref::Ray own{vector(ray.origin), vector(ray.direction), ray.length};
  refuse_unless_acceptable(own, "ray");
  return own;
}

std::vector<ref::Ray> checked(std::span<const hitpipe_ray> rays) {
  std::vector<ref::Ray> own;
  own.reserve(rays.size());
  for (const hitpipe_ray& ray : rays) {
    own.push_back({vector(ray.origin), vector(ray.direction), ray.length});
    if (!ref::acceptable(own.back()))
      refuse_unless_acceptable(own.back(), fmt::format("ray {}", own.size() - 1));
  }
  return own;
}

std::vector<ref::Aabb> checked(std::span<const hitpipe_box> boxes) {
  std::vector<ref::Aabb> own;
  own.reserve(boxes.size());
  for (const hitpipe_box& box : boxes) {
    own.push_back({vector(box.min), vector(box.max)});
    if (!ref::acceptable(own.back()))
      throw Refusal(HITPIPE_BAD_BOX, fmt::format("box {}: {}", own.size() - 1, why_refused(own.back())));
  }
  return own;
}

std::span<const hitpipe_ray> given(const hitpipe_ray* rays, std::size_t count) {
  if (count != 0) static_cast<void>(given(rays, "rays"));
  return {rays, count};
}

std::span<const hitpipe_box> given(const hitpipe_box* boxes, std::size_t count) {
  if (count != 0) static_cast<void>(given(boxes, "boxes"));
  return {boxes, count};
}

}  // namespace hitpipe::library
