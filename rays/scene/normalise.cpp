#include "rays/scene/normalise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "rays/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

namespace {

template <class Vertex>
Bounds bounds_of(const MeshOf<Vertex>& mesh) {
  Bounds box{glm::dvec3(std::numeric_limits<double>::infinity()),
             glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) box.grow(glm::dvec3(mesh.vertices[t[k]]));
  }
  return box;
}

}  // namespace

double Bounds::longest() const {
  const glm::dvec3 extent = max - min;
  return std::max({extent.x, extent.y, extent.z});
}

void Bounds::grow(const glm::dvec3& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

void Losses::add(double thickness) {
  thinnest = triangles == 0 ? thickness : std::min(thinnest, thickness);
  thickest = std::max(thickest, thickness);
  ++triangles;
}

double thickness(const SourceMesh::Corners& corners) {
  const glm::dvec3 b = corners.b - corners.a;
  const glm::dvec3 c = corners.c - corners.a;
  const double longest = std::max({glm::length(b), glm::length(c), glm::length(c - b)});
  return longest == 0.0 ? 0.0 : glm::length(glm::cross(b, c)) / longest;
}

Bounds mesh_bounds(const SourceMesh& mesh) {
  return bounds_of(mesh);
}
Bounds mesh_bounds(const Mesh& mesh) {
  return bounds_of(mesh);
}

Normalisation fit_to_cube(Bounds box, std::span<const glm::dvec3> points) {
  for (const glm::dvec3& point : points) box.grow(point);
  return {box.centre(), cube_bound / (0.5 * box.longest())};
}

glm::vec3 normalised(const glm::dvec3& own, const Normalisation& normalisation) {
  const glm::vec3 p(normalisation.to_cube(own));
  // The extreme points end within a few units of the last place of a double from the bound. The bound is a
  // binary32 number, so rounding to nearest moves them onto it.
  constexpr auto bound = static_cast<float>(cube_bound);
  if (!(std::abs(p.x) <= bound && std::abs(p.y) <= bound && std::abs(p.z) <= bound))
    throw std::logic_error("normalised: the transform does not take the point into the cube");
  return p;
}

Mesh normalise(SourceMesh mesh, const Normalisation& normalisation, Losses& lost) {
  std::vector<bool> used(mesh.vertices.size());
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  constexpr auto bound = static_cast<float>(cube_bound);
  std::vector<glm::vec3> vertices;
  vertices.reserve(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    vertices.push_back(used[v]
                           ? normalised(mesh.vertices[v], normalisation)
                           : glm::clamp(glm::vec3(normalisation.to_cube(mesh.vertices[v])), -bound, bound));
  }
  const std::vector<glm::dvec3> own = std::exchange(mesh.vertices, {});
  Mesh placed = with_vertices(std::move(mesh), std::move(vertices));
  const std::vector<std::uint32_t> flat = flat_triangles(placed);
  for (const std::uint32_t triangle : flat) {
    const glm::uvec3& t = placed.triangles[triangle];
    lost.add(thickness({own[t.x], own[t.y], own[t.z]}));
  }
  drop(placed, flat);
  if (placed.triangles.empty())
    throw std::runtime_error(
        "scene: no triangle keeps an area when its corners are rounded to binary32 in the cube; at least one "
        "must");
  return placed;
}

}  // namespace hitpipe::ref
