#include "rays/world/int_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/world/world_format.hpp"
#include "rays/exact/grid.hpp"
#include "rays/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

namespace {

using Corner = IntTriangle::Corner;

Corner on_grid(const glm::vec3& vertex, int coord_bits) {
  Corner corner{};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(vertex[axis]) <= 1.0F))
      throw std::out_of_range(fmt::format("a corner at {} is outside the cube", vertex[axis]));
    corner[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(fine_nearest(vertex[axis], coord_bits));
  }
  return corner;
}

}  // namespace

bool is_degenerate(const IntTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  std::array<std::int64_t, 3> p{}, q{};
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = std::int64_t{b[i]} - a[i];
    q[i] = std::int64_t{c[i]} - a[i];
  }
  return p[1] * q[2] == p[2] * q[1] && p[2] * q[0] == p[0] * q[2] && p[0] * q[1] == p[1] * q[0];
}

IntMesh int_mesh(const Mesh& mesh, int coord_bits) {
  if (coord_bits < hls::WorldBits::min_proved_coord || coord_bits > hls::WorldBits::max_coord)
    throw std::invalid_argument(fmt::format("a mesh on a grid of {} bits: allowed is {} to {}", coord_bits,
                                            hls::WorldBits::min_proved_coord, hls::WorldBits::max_coord));
  const auto scale = static_cast<double>(grid_scale(coord_bits));
  IntMesh made;
  made.coord_bits = coord_bits;
  made.mesh = mesh;
  std::vector<Corner> corners;
  corners.reserve(mesh.vertices.size());
  for (glm::vec3& vertex : made.mesh.vertices) {
    const Corner corner = on_grid(vertex, coord_bits);
    for (int axis = 0; axis < 3; ++axis) {
      const double place = static_cast<double>(corner[static_cast<std::size_t>(axis)]) / scale;
      made.largest_movement =
          std::max(made.largest_movement, std::abs(place - static_cast<double>(vertex[axis])));
      vertex[axis] = static_cast<float>(place);
    }
    corners.push_back(corner);
  }
  std::vector<std::uint32_t> flat;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const IntTriangle triangle{{corners[t.x], corners[t.y], corners[t.z]}};
    if (!is_degenerate(triangle)) {
      made.triangles.push_back(triangle);
      continue;
    }
    flat.push_back(i);
    made.lost.add(thickness({mesh.vertices[t.x], mesh.vertices[t.y], mesh.vertices[t.z]}));
  }
  drop(made.mesh, flat);
  return made;
}

std::uint32_t lost_on_grid(const Mesh& mesh, int coord_bits) {
  return static_cast<std::uint32_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
        return is_degenerate(
            {{on_grid(mesh.vertices[t.x], coord_bits), on_grid(mesh.vertices[t.y], coord_bits),
              on_grid(mesh.vertices[t.z], coord_bits)}});
      }));
}

Closedness closedness(const IntMesh& mesh) {
  return closedness(mesh.triangles);
}

Closedness closedness(std::span<const IntTriangle> triangles) {
  Mesh on_grid;  // corners have at most 23 bits, so binary32 holds them
  for (const IntTriangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(on_grid.vertices.size());
    for (const auto& [x, y, z] : triangle.corners) on_grid.vertices.emplace_back(x, y, z);
    on_grid.triangles.emplace_back(first, first + 1, first + 2);
  }
  return closedness(on_grid);
}

}  // namespace hitpipe::ref
