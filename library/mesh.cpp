#include "library/mesh.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "library/failure.hpp"
#include "library/transform.hpp"

namespace hitpipe::library {

namespace {

void check_place(const glm::dvec3& place, const char* what, std::size_t i, hitpipe_status status) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(place[axis]) <= most_coordinate))
      throw Refusal(status, fmt::format("{} {}: {} = {}; allowed is -2^24 to 2^24", what, i, "xyz"[axis],
                                        static_cast<float>(place[axis])));
}

std::vector<glm::uvec3> checked_triangles(const hitpipe_mesh& mesh) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  if (mesh.triangle_count > most)
    throw Refusal(HITPIPE_BAD_MESH,
                  fmt::format("{} triangles; allowed are up to {}", mesh.triangle_count, most));
  if (mesh.triangle_count != 0) static_cast<void>(given(mesh.triangles, "triangles"));
  std::vector<glm::uvec3> own;
  own.reserve(mesh.triangle_count);
  for (std::size_t i = 0; i < mesh.triangle_count; ++i) {
    const std::uint32_t* const corner = mesh.triangles + 3 * i;
    for (std::size_t k = 0; k < 3; ++k)
      if (corner[k] >= mesh.corner_count)
        throw Refusal(HITPIPE_BAD_MESH,
                      fmt::format("triangle {}: corner {} of {}", i, corner[k], mesh.corner_count));
    own.emplace_back(corner[0], corner[1], corner[2]);
  }
  return own;
}

}  // namespace

CheckedMesh checked_mesh(const hitpipe_mesh& mesh) {
  auto triangles = checked_triangles(mesh);
  return with_corners(mesh.corners, mesh.corner_count, std::move(triangles));
}

CheckedMesh with_corners(const float* corners, std::size_t corner_count, std::vector<glm::uvec3> triangles) {
  CheckedMesh own{{}, std::vector<bool>(corner_count)};
  for (const glm::uvec3& triangle : triangles)
    own.used[triangle.x] = own.used[triangle.y] = own.used[triangle.z] = true;
  own.mesh.triangles = std::move(triangles);
  own.mesh.vertices.resize(corner_count, glm::vec3(0));
  if (corner_count != 0) static_cast<void>(given(corners, "corners"));
  for (std::size_t i = 0; i < corner_count; ++i) {
    if (!own.used[i]) continue;
    own.mesh.vertices[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    check_place(own.mesh.vertices[i], "corner", i, HITPIPE_BAD_MESH);
  }
  return own;
}

std::vector<glm::dvec3> checked_points(const float* points, std::size_t count) {
  if (count != 0) static_cast<void>(given(points, "points"));
  std::vector<glm::dvec3> own;
  for (std::size_t i = 0; i < count; ++i) {
    own.emplace_back(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    check_place(own.back(), "point", i, HITPIPE_BAD_ARGUMENT);
  }
  return own;
}

ref::Normalisation fitted(const ref::Mesh& mesh, std::span<const glm::dvec3> points) {
  if (mesh.triangles.empty() && points.empty()) return {};
  ref::Bounds bounds =
      mesh.triangles.empty() ? ref::Bounds{points.front(), points.front()} : ref::mesh_bounds(mesh);
  for (const glm::dvec3& point : points) bounds.grow(point);
  if (!(bounds.longest() > 0))
    throw Refusal(HITPIPE_BAD_MESH,
                  "all corners are in one place; an integer world needs a mesh with some extent");
  return ref::fit_to_cube(bounds, {});
}

void move_into_cube(CheckedMesh& own, const ref::Normalisation& transform) {
  for (std::size_t i = 0; i < own.mesh.vertices.size(); ++i) {
    if (!own.used[i]) continue;
    glm::vec3& vertex = own.mesh.vertices[i];
    vertex = glm::vec3(transform.to_cube(glm::dvec3(vertex)));
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(vertex[axis]) <= 1.0F))
        throw Refusal(HITPIPE_BAD_MESH,
                      fmt::format("corner {}: {} is {} in the cube of the integer world; allowed is "
                                  "[-1, 1]",
                                  i, "xyz"[axis], vertex[axis]));
  }
}

}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_fit_scene(const hitpipe_mesh* mesh, const float* points, size_t point_count,
                                 hitpipe_transform* out) {
  return guarded([&] {
    const CheckedMesh own = checked_mesh(given(mesh, "mesh"));
    given(out, "out") = c_transform(fitted(own.mesh, checked_points(points, point_count)));
  });
}
