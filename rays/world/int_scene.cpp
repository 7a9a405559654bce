#include "rays/world/int_scene.hpp"

#include <cstdint>
#include <vector>

#include "rays/scene/triangle_numbers.hpp"
#include "rays/tree/refit.hpp"

namespace hitpipe::ref {

namespace {

/// By triangle of the smaller mesh: the triangle of the larger one that has its number.
std::vector<std::uint32_t> kept_of(const Mesh& larger, const Mesh& smaller) {
  const TriangleNumbers before(larger);
  const TriangleNumbers after(smaller);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < smaller.triangles.size(); ++i)
    kept.push_back(before.in_mesh(after.of_source(i)));
  return kept;
}

}  // namespace

IntScene int_scene(const Scene& scene, const hls::WorldBits& bits, const HierarchyOptions& hierarchy) {
  IntScene made{.bits = bits, .mesh = int_mesh(scene.mesh, bits.coord), .scene = scene, .bvh = {}};
  made.scene.mesh = made.mesh.mesh;
  if (made.mesh.triangles.empty()) return made;
  HierarchyOptions exact = hierarchy;
  exact.build.padding = 0.0F;
  made.bvh = exact.file.empty() ? build_bvh(made.mesh.mesh, exact.build)
                                : refitted(make_hierarchy(scene, exact).bvh, made.mesh.mesh,
                                           kept_of(scene.mesh, made.mesh.mesh));
  return made;
}

}  // namespace hitpipe::ref
