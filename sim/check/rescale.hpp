// A scene in other units and at another place: mesh, camera and lights moved alike, the mesh in binary32 as a
// file would hold it, then placed and rendered as any scene. A power of two moves no bit of the picture;
// another scale or a far offset rounds the mesh, and what comes of that is counted. Each moved scene is
// judged on its own mesh too: the Verilog, when given, beside the reference.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/verilated_design.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::sim {

/// own = scale * own + offset, scale > 0 and finite.
struct Transform {
  double scale = 1.0;
  glm::dvec3 offset{0.0};
};

struct MovedScene {
  ref::SceneDescription description;
  std::uint64_t vertices_moved = 0;  ///< which undoing the transform in double does not bring back
};

/// Vertices computed in double and rounded to binary32 once; camera and lights stay double. Throws
/// std::runtime_error when a vertex leaves binary32's range.
[[nodiscard]] MovedScene moved(const ref::SceneDescription& scene, const Transform& transform);

/// What answers the box tests of a picture: a design's Verilog, or the robust float slabs in software.
struct PictureUnit {
  const rtl::Design* design = nullptr;
  std::optional<rtl::Format> format{};
  const VerilatedDesign* verilated = nullptr;  ///< null: software
};

struct PictureOptions {
  int width = 256;
  int height = 256;
  int threads = 1;
  PictureUnit unit;
};

struct Picture {
  std::vector<glm::vec3> image;
  std::vector<std::uint32_t> triangles;   ///< by pixel, as the mesh was before placing; Hit::none for the sky
  std::uint64_t degenerate_dropped = 0;   ///< triangles that lost their area
  std::uint64_t different_triangles = 0;  ///< of the Verilog, against the reference on the same mesh
  std::uint64_t rtl_mismatches = 0;
};

/// Places and renders. Throws as ref::place() and cosimulate() do.
[[nodiscard]] Picture picture(const ref::SceneDescription& scene, const PictureOptions& options);

struct PixelChanges {
  std::uint64_t other_triangle = 0;
  std::uint64_t other_colour = 0;  ///< a channel more than 1/255 apart, whatever triangle is seen
};

/// Pixels of one picture that are not as in the other; of the same size.
[[nodiscard]] PixelChanges pixel_changes(const Picture& one, const Picture& other);

}  // namespace hitpipe::sim
