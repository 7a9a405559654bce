#include "sw_ref/core/image_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hls/machines/block_kind.hpp"
#include "rays/exact/grid.hpp"
#include "sw_ref/scene/mesh_scene.hpp"

namespace hitpipe::ref {

namespace {

/// A scene has a list of them.
constexpr std::uint32_t most_missing = 1U << 26;

/// By number.
std::vector<CoreTriangle> triangles_of(const CoreImage& image) {
  std::vector<CoreTriangle> triangles;
  triangles.reserve(image.header.triangles);
  for (const CoreBlock& block : image.blocks)
    if (block.back() >> 56 ==
        static_cast<std::uint64_t>(hls::kind_byte(hls::triangle_block, image.header.coord_bits)))
      triangles.push_back(triangle_of(block));
  std::sort(triangles.begin(), triangles.end(),
            [](const CoreTriangle& a, const CoreTriangle& b) { return a.number < b.number; });
  return triangles;
}

Mesh mesh_of(const CoreImage& image) {
  const auto scale = static_cast<double>(grid_scale(image.header.coord_bits));
  Mesh mesh;
  mesh.dropped.reserve(image.header.missing);
  std::uint32_t number = 0;
  for (const CoreTriangle& triangle : triangles_of(image)) {
    for (; number < triangle.number; ++number) mesh.dropped.push_back(number);
    ++number;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    for (const auto& [x, y, z] : triangle.triangle.corners)
      mesh.vertices.emplace_back(glm::dvec3(x, y, z) / scale);
  }
  while (mesh.dropped.size() < image.header.missing) mesh.dropped.push_back(number++);
  return mesh;
}

/// The eye of a mesh file may lie outside the image's cube: then as far from the target as the cube reaches.
void move_inside(SceneDescription& scene, const Normalisation& to_cube) {
  const glm::dvec3 target = to_cube.to_cube(scene.target);
  const glm::dvec3 view = to_cube.to_cube(scene.eye) - target;
  double part = 1.0;
  for (int axis = 0; axis < 3; ++axis)
    if (view[axis] != 0.0)
      part = std::min(part, ((view[axis] > 0.0 ? cube_bound : -cube_bound) - target[axis]) / view[axis]);
  if (part > 0.0 && part < 1.0) scene.eye = to_cube.to_own(target + part * view);
}

}  // namespace

IntScene image_scene(const CoreImage& image, const hls::WorldBits& bits, std::string name,
                     const SceneOptions& options) {
  const CoreHeader& header = image.header;
  if (bits.coord != header.coord_bits) throw std::invalid_argument("the image has a grid of other bits");
  if (header.triangles == 0) throw std::runtime_error("the image has no triangle; at least one is needed");
  if (header.missing > most_missing)
    throw std::runtime_error(fmt::format("the image lacks {} triangles of its mesh; allowed are {} at most",
                                         header.missing, most_missing));
  IntScene made{.bits = bits, .mesh = int_mesh(mesh_of(image), bits.coord), .scene = {}, .bvh = {}};
  std::vector<glm::dvec3> own;
  own.reserve(made.mesh.mesh.vertices.size());
  for (const glm::vec3& vertex : made.mesh.mesh.vertices) own.push_back(header.to_cube.to_own(vertex));
  SceneDescription description = mesh_scene(with_vertices(made.mesh.mesh, std::move(own)), std::move(name));
  move_inside(description, header.to_cube);
  made.scene = place_in(with_options(std::move(description), options), header.to_cube, made.mesh.mesh);
  return made;
}

}  // namespace hitpipe::ref
