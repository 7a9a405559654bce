// What a scene can ever demand of a box-test unit: its rays, bounded by intervals, and its boxes, which are
// all known. The bounds are conservative: a unit that meets the demands answers correctly for every image of
// the scene with this camera and a view that is no wider.
#pragma once

#include <string>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "sw_ref/quantise/ray_family.hpp"

namespace hitpipe::ref {

/// A demand and what it follows from, in words.
struct Evidence {
  std::string demand;
  std::string why;
  bool bounds = true;  ///< false: it says what cannot be bounded and is kept whole
};

struct SceneDemands {
  std::vector<RayFamily> rays;
  Aabb boxes;                    ///< contains the padded boxes of all nodes
  glm::vec3 smallest_extent{0};  ///< of any box, by axis
  int deepest = 0;               ///< levels of the hierarchy, which a stack must hold
  int most_in_leaf = 0;          ///< triangles
  bool infinite = true;          ///< rays without an end are tested
  bool finite = true;            ///< rays with an end are tested

  [[nodiscard]] bool has(RayKind kind) const;
  /// Bit c: rays of class c (direction_class(), child_order.hpp) may come.
  [[nodiscard]] unsigned classes() const;
  [[nodiscard]] bool can_be_zero(int axis) const;
  /// The bounds of all origins.
  [[nodiscard]] Aabb origins() const;
  /// The largest possible ratio of the magnitudes of a direction's largest and smallest component; infinite
  /// if a component can be 0.
  [[nodiscard]] double spread() const;
  /// Every demand in words, and what could not be bounded.
  [[nodiscard]] std::vector<Evidence> evidence() const;
};

/// The hierarchy must be of the scene's mesh.
[[nodiscard]] SceneDemands scene_demands(const Scene& scene, const Bvh& bvh, const ViewOptions& view);

}  // namespace hitpipe::ref
