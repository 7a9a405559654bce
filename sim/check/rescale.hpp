// A scene in other units and at another place. Mesh, camera and lights are moved alike; the mesh is stored in
// binary32 as in a file, then placed and rendered as any scene. Scaling by a power of two changes no bit of
// the picture. Another scale or a far offset rounds the mesh, and the effect of that is counted. Each moved
// scene is also judged on its own mesh: the Verilog, if given, against the reference.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"
#include "sim/unit/verilated_design.hpp"

namespace hitpipe::sim {

/// own = scale * own + offset, scale > 0 and finite.
struct Transform {
  double scale = 1.0;
  glm::dvec3 offset{0.0};
};

struct MovedScene {
  ref::SceneDescription description;
  std::uint64_t vertices_moved = 0;  ///< the inverse transform in double does not give them back
};

/// Computes vertices in double and rounds them to binary32 once. Camera and lights stay double. Throws
/// std::runtime_error when a vertex leaves the range of binary32.
[[nodiscard]] MovedScene moved(const ref::SceneDescription& scene, const Transform& transform);

struct PictureOptions {
  int width = 256;
  int height = 256;
  int threads = 1;
  ref::BuildOptions build{};  ///< of each picture's hierarchy
  const VerilatedDesign* verilated =
      nullptr;  ///< answers the box tests; null: conservative float slabs in software
};

struct Picture {
  std::vector<glm::vec3> image;
  std::vector<std::uint32_t> triangles;  ///< by pixel, the triangle's number; Hit::none for the sky
  std::uint64_t lost_to_rounding =
      0;  ///< triangles that have an area in the moved file, and none in the cube
  std::uint64_t different_triangles = 0;  ///< the Verilog against the reference on the same mesh
  std::uint64_t rtl_mismatches = 0;
};

/// Places and renders. Throws what ref::place() and cosimulate() throw.
[[nodiscard]] Picture picture(const ref::SceneDescription& scene, const PictureOptions& options);

struct PixelChanges {
  std::uint64_t other_triangle = 0;
  std::uint64_t other_colour = 0;  ///< a channel differs by more than 1/255, for any triangle
};

/// Pixels that differ between two pictures of the same size.
[[nodiscard]] PixelChanges pixel_changes(const Picture& one, const Picture& other);

}  // namespace hitpipe::sim
