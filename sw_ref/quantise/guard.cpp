#include "sw_ref/quantise/guard.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace hitpipe::ref {
namespace {

constexpr const char* name_of(RayKind kind) {
  return kind == RayKind::primary ? "primary" : kind == RayKind::secondary ? "secondary" : "shadow";
}

[[noreturn]] void fail(const std::string& reason) {
  throw std::out_of_range("outside the demands that the unit was fitted to: " + reason);
}

/// Describes a coordinate of `inner` that lies outside `outer`; empty if there is none. NaN lies outside.
std::string outside(const Aabb& outer, const Aabb& inner, const char* what) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float x : {inner.min[axis], inner.max[axis]}) {
      if (x >= outer.min[axis] && x <= outer.max[axis]) continue;
      return fmt::format("{}.{} = {:.9g}, demanded is {:.9g} to {:.9g}", what, "xyz"[axis], x,
                         outer.min[axis], outer.max[axis]);
    }
  }
  return {};
}

/// Throws unless one demanded family of this kind contains all these rays. The message is about the last
/// family.
void check_family(const SceneDemands& demands, RayKind kind, const Aabb& origin, const Aabb& direction) {
  std::string reason = fmt::format("{} rays; the demands allow none", name_of(kind));
  for (const RayFamily& family : demands.rays) {
    if (family.kind != kind) continue;
    reason = outside(family.origin, origin, "origin");
    if (reason.empty()) reason = outside(family.direction, direction, "direction");
    if (reason.empty()) return;
    reason = fmt::format("{} ray with {}", name_of(kind), reason);
  }
  fail(reason);
}

}  // namespace

void check_ray_against(const SceneDemands& demands, RayKind kind, const Ray& ray) {
  if (ray.is_infinite() ? !demands.infinite : !demands.finite)
    fail(fmt::format("a ray {} an end", ray.is_infinite() ? "without" : "with"));
  check_family(demands, kind, {ray.origin, ray.origin}, {ray.direction, ray.direction});
}

}  // namespace hitpipe::ref
