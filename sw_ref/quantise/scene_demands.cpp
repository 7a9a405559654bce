#include "sw_ref/quantise/scene_demands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rays/trace/child_order.hpp"

namespace hitpipe::ref {
namespace {

/// 1: may be positive (or +0), 2: may be negative (or -0). The sign of a zero is not bounded.
unsigned possible_signs(const RayFamily& family, int axis) {
  return (family.direction.max[axis] >= 0.0F ? 1U : 0U) | (family.direction.min[axis] <= 0.0F ? 2U : 0U);
}

bool holds_zero(const RayFamily& family, int axis) {
  return family.direction.min[axis] <= 0.0F && family.direction.max[axis] >= 0.0F;
}

std::string class_name(unsigned c) {
  return fmt::format("{}{}{}", (c & 1U) != 0 ? '-' : '+', (c & 2U) != 0 ? '-' : '+',
                     (c & 4U) != 0 ? '-' : '+');
}

std::string span(float low, float high) {
  return low == high ? fmt::format("{:.6g}", low) : fmt::format("{:.6g} .. {:.6g}", low, high);
}

/// Where rays of the kinds that come start and end, in words.
std::string ends_of(const std::vector<RayFamily>& rays) {
  std::string words = "primary rays start without an end and end at the nearest hit so far";
  const auto any_shadow = [&](RayEnd end) {
    return std::any_of(rays.begin(), rays.end(), [&](const RayFamily& family) {
      return family.kind == RayKind::shadow && family.end == end;
    });
  };
  if (any_shadow(RayEnd::light)) words += "; shadow rays end at their light";
  if (any_shadow(RayEnd::reach)) words += "; shadow rays to what is near end beyond it";
  if (any_shadow(RayEnd::none)) words += "; shadow rays to a sun have no end";
  return words;
}

/// What all rays come from, in words; primary rays come first.
std::string sources_of(const std::vector<RayFamily>& rays) {
  const std::string first = rays.front().has_one_origin() ? "the eye" : "the image of the camera";
  return rays.size() == 1 ? first + " alone sends rays"
                          : first + ", and surfaces with the offset of rays that leave them";
}

std::string spans(const Aabb& box) {
  return fmt::format("x {}, y {}, z {}", span(box.min.x, box.max.x), span(box.min.y, box.max.y),
                     span(box.min.z, box.max.z));
}

}  // namespace

bool SceneDemands::has(RayKind kind) const {
  return std::any_of(rays.begin(), rays.end(), [&](const RayFamily& family) { return family.kind == kind; });
}

unsigned SceneDemands::classes() const {
  unsigned found = 0;
  for (const RayFamily& family : rays) {
    for (unsigned c = 0; c < direction_classes; ++c) {
      bool possible = true;
      for (int axis = 0; axis < 3; ++axis)
        possible =
            possible && (possible_signs(family, axis) >> (c >> static_cast<unsigned>(axis) & 1U) & 1U) != 0;
      if (possible) found |= 1U << c;
    }
  }
  return found;
}

bool SceneDemands::can_be_zero(int axis) const {
  return std::any_of(rays.begin(), rays.end(), [&](const RayFamily& f) { return holds_zero(f, axis); });
}

Aabb SceneDemands::origins() const {
  Aabb all;
  for (const RayFamily& family : rays) all.grow(family.origin);
  return all;
}

double SceneDemands::spread() const {
  double worst = 1.0;
  for (const RayFamily& family : rays) {
    double largest = 0.0;
    double smallest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::abs(family.direction.min[axis]);
      const double high = std::abs(family.direction.max[axis]);
      largest = std::max({largest, low, high});
      smallest = std::min(smallest, holds_zero(family, axis) ? 0.0 : std::min(low, high));
    }
    worst = std::max(worst, largest / smallest);
  }
  return worst;
}

std::vector<Evidence> SceneDemands::evidence() const {
  std::vector<Evidence> all;
  const bool bending = has(RayKind::secondary);
  const bool shadows = has(RayKind::shadow);
  all.push_back(
      {fmt::format("rays: primary{}{}", bending ? ", secondary" : "", shadows ? ", shadow" : ""),
       fmt::format(
           "{}; {}",
           bending ? "surfaces mirror, pass or scatter light on"
                   : "no surface mirrors, passes or scatters light on, or no bounce is followed",
           shadows ? "lights or the sky shine on surfaces that scatter" : "no light shines on any surface")});
  all.push_back({"rays with and without an end", ends_of(rays), !(finite && infinite)});
  all.push_back({"lengths and endpoints of rays", "they move with every hit", false});
  std::vector<std::string> names;
  for (unsigned c = 0; c < direction_classes; ++c)
    if ((classes() >> c & 1U) != 0) names.push_back(class_name(c));
  std::vector<std::string> sources;
  for (const RayFamily& family : rays) sources.push_back(family.why);
  all.push_back({fmt::format("direction classes {}", fmt::join(names, " ")),
                 fmt::format("{}", fmt::join(sources, "; ")), names.size() < direction_classes});
  std::string zeros;
  for (int axis = 0; axis < 3; ++axis)
    if (can_be_zero(axis)) zeros += "xyz"[axis];
  all.push_back(
      {zeros.empty() ? "no direction component is 0" : "direction components that may be 0: " + zeros,
       "bounds of the directions", zeros.empty()});
  all.push_back({std::isinf(spread())
                     ? "spread of direction components not bounded"
                     : fmt::format("direction components differ by at most {:.4g} times", spread()),
                 "bounds of the directions", !std::isinf(spread())});
  all.push_back({"origins: " + spans(origins()), sources_of(rays)});
  all.push_back({"boxes: " + spans(boxes), "all nodes of the hierarchy, padded"});
  Aabb coordinates = origins();
  coordinates.grow(boxes);
  std::string two_sided;
  std::string wide;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = coordinates.min[axis];
    const float high = coordinates.max[axis];
    if (low >= 0.0F || high <= 0.0F) continue;
    two_sided += "xyz"[axis];
    if (std::max(-low, high) >= 0.5F) wide += "xyz"[axis];
  }
  if (!two_sided.empty())
    all.push_back({"signs of float coordinates along " + two_sided, "they lie on both sides of 0", false});
  if (!wide.empty())
    all.push_back({"range of integer coordinates along " + wide,
                   "they lie on both sides of 0, and reach half of the way to the cube's faces", false});
  all.push_back({fmt::format("smallest boxes: x {:.4g}, y {:.4g}, z {:.4g}", smallest_extent.x,
                             smallest_extent.y, smallest_extent.z),
                 "all nodes of the hierarchy"});
  all.push_back({fmt::format("{} levels, at most {} triangles in a leaf", deepest, most_in_leaf),
                 "the hierarchy as built"});
  return all;
}

SceneDemands scene_demands(const Scene& scene, const Bvh& bvh, const ViewOptions& view) {
  SceneDemands demands;
  demands.rays = ray_families(scene, view);
  demands.smallest_extent = glm::vec3(std::numeric_limits<float>::infinity());
  for (const BvhNode& node : bvh.nodes) {
    demands.boxes.grow(node.box);
    demands.smallest_extent = glm::min(demands.smallest_extent, node.box.max - node.box.min);
    demands.most_in_leaf = std::max(demands.most_in_leaf, static_cast<int>(node.count));
  }
  demands.deepest = bvh.depth;
  return demands;
}

}  // namespace hitpipe::ref
