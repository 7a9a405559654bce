#include "sw_ref/scene/normalise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

#include "sw_ref/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

double Bounds::longest() const {
  const glm::dvec3 extent = max - min;
  return std::max({extent.x, extent.y, extent.z});
}

void Bounds::grow(const glm::dvec3& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

Bounds mesh_bounds(const Mesh& mesh) {
  Bounds box{glm::dvec3(std::numeric_limits<double>::infinity()),
             glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (const glm::uvec3& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) box.grow(glm::dvec3(mesh.vertices[t[k]]));
  }
  return box;
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

void normalise(Mesh& mesh, const Normalisation& normalisation) {
  std::vector<bool> used(mesh.vertices.size());
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  constexpr auto bound = static_cast<float>(cube_bound);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    glm::vec3& vertex = mesh.vertices[v];
    vertex = used[v] ? normalised(glm::dvec3(vertex), normalisation)
                     : glm::clamp(glm::vec3(normalisation.to_cube(glm::dvec3(vertex))), -bound, bound);
  }
  drop_degenerate(mesh);
  if (mesh.triangles.empty())
    throw std::runtime_error(
        "scene: no triangle keeps an area when its corners are rounded to binary32 in the cube; at least one "
        "must");
}

}  // namespace hitpipe::ref
