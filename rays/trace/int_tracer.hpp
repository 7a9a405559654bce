// Traces binary32 rays in the integer world: each ray is rounded at the door, and after that nothing is.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/int_mesh.hpp"

namespace hitpipe::ref {

struct IntTracerOptions {
  hls::WorldBits world{};
  /// Boxes are tested as int_major does in this format; nothing: exactly. Its n, g and S must be the world's,
  /// and its F at most g + F of the world.
  std::optional<hls::MajorBits> boxes{};
};

/// Throws std::invalid_argument, one line, when boxes of the format cannot be tested for rays of the world.
void check_box_format(const hls::WorldBits& world, const hls::MajorBits& boxes);

/// Throws std::invalid_argument, one line, when formats do not fit each other or the mesh.
void check_world(const IntMesh& mesh, const IntTracerOptions& options);

/// `bvh` is a hierarchy over mesh.mesh; nothing, for a mesh without triangles, which no ray hits. Boxes are
/// made from the corners, so a box of the hierarchy need not hold them. Mesh and hierarchy must outlive the
/// tracer. Throws as check_world().
[[nodiscard]] std::unique_ptr<Tracer> int_tracer(const IntMesh& mesh, const Bvh* bvh,
                                                 const IntTracerOptions& options);

}  // namespace hitpipe::ref
