// Rays at edges and corners in place of a picture's, for a core that counts crossings.
#pragma once

#include <cstdint>
#include <vector>

#include "host/piece.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_scene.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct EdgeRayChoice {
  std::uint64_t rays = 0;  ///< 0: a picture's, or those of a list
  std::uint64_t seed = 1;
  bool count_alone = false;  ///< else each ray is asked all that the core answers

  [[nodiscard]] bool given() const { return rays > 0; }
  /// Throws std::runtime_error, one line, when the core has no count, or when other options of these are given without
  /// --edge-rays.
  void check(const CLI::App& command, bool core_counts) const;
  /// Throws std::runtime_error, one line, when the mesh has no triangle.
  [[nodiscard]] std::vector<ref::Ray> of_part(const ref::IntScene& scene, host::Piece part) const;
};

/// Adds --edge-rays, --seed and --ask. The command has the options of its picture and of a list of rays already.
void add_edge_ray_options(CLI::App& command, EdgeRayChoice& choice);

}  // namespace hitpipe::cli
