// What a scene can ever ask of a box-test unit: its rays, bounded by intervals, and its boxes, all of which
// are known. Conservative: a unit that meets the demands answers right for every image of the scene with this
// camera and no wider a view.
#pragma once

#include <string>
#include <vector>

#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/demands/ray_family.hpp"

namespace hitpipe::ref {

/// A demand and what it follows from, in words.
struct Evidence {
  std::string demand;
  std::string why;
  bool bounds = true;  ///< else it says what cannot be bounded, and is kept whole
};

struct SceneDemands {
  std::vector<RayFamily> rays;
  Aabb boxes;                    ///< holds all nodes' boxes, as padded
  glm::vec3 smallest_extent{0};  ///< of any box, by axis
  int deepest = 0;               ///< levels of the hierarchy: what a stack must hold
  int most_in_leaf = 0;          ///< triangles
  bool infinite = true;          ///< rays without an end are tested
  bool finite = true;            ///< rays with one are

  [[nodiscard]] bool has(RayKind kind) const;
  /// Bit c: rays of class c (direction_class(), child_order.hpp) may come.
  [[nodiscard]] unsigned classes() const;
  [[nodiscard]] bool can_be_zero(int axis) const;
  /// Of all rays.
  [[nodiscard]] Aabb origins() const;
  /// Of a ray's direction, the largest component's magnitude over the smallest's is at most this; infinite
  /// where a component can be 0.
  [[nodiscard]] double spread() const;
  /// Every demand in words, also what could not be bounded.
  [[nodiscard]] std::vector<Evidence> evidence() const;
};

/// The hierarchy is of the scene's mesh.
[[nodiscard]] SceneDemands scene_demands(const Scene& scene, const Bvh& bvh, const ViewOptions& view);

}  // namespace hitpipe::ref
