// Meshes and rays on which traversals might disagree. The meshes have shared vertices and edges, doubled
// triangles, and triangles in coordinate planes. The rays go through all of these, are parallel to axes and
// planes, or are cut where they hit.
#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "rays/exact/exact_triangle.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

using Random = std::mt19937;

inline int below(Random& random, int end) {
  return static_cast<int>(random() % static_cast<unsigned>(end));
}

/// In [-0.95, 0.95].
inline glm::vec3 any_point(Random& random) {
  std::uniform_real_distribution<float> value(-0.95F, 0.95F);
  return {value(random), value(random), value(random)};
}

/// On a grid of eighths: many coordinates are equal.
inline glm::vec3 grid_point(Random& random) {
  const auto value = [&] { return static_cast<float>(below(random, 15) - 7) * 0.125F; };
  return {value(), value(), value()};
}

inline void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.emplace_back(base, base + 1, base + 2);
}

/// Centres at powers of two leave one triangle for each level of a hierarchy, which is as deep as it can be.
inline Mesh one_triangle_a_level() {
  Mesh mesh;
  for (int i = 0; i < 100; ++i) {
    const float x = std::ldexp(0.9F, -i);
    add_triangle(mesh, {x, -0.5F, -0.5F}, {x, 0.5F, -0.5F}, {x, 0.0F, 0.5F});
  }
  return mesh;
}

/// Small triangles anywhere.
inline Mesh soup(Random& random, int triangles) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const glm::vec3 a = any_point(random);
    add_triangle(mesh, a, a + 0.05F * any_point(random), a + 0.05F * any_point(random));
  }
  for (glm::vec3& vertex : mesh.vertices) vertex = glm::clamp(vertex, -0.95F, 0.95F);
  return mesh;
}

/// Corners on the grid; every third lies in a coordinate plane, every fifth is there twice.
inline Mesh grid_soup(Random& random, int triangles) {
  Mesh mesh;
  while (mesh.triangles.size() < static_cast<std::size_t>(triangles)) {
    const glm::vec3 a = grid_point(random);
    glm::vec3 b = grid_point(random);
    glm::vec3 c = grid_point(random);
    if (below(random, 3) == 0) {
      const int axis = below(random, 3);
      b[axis] = c[axis] = a[axis];
    }
    if (!has_area(Mesh::Corners{a, b, c})) continue;
    add_triangle(mesh, a, b, c);
    if (below(random, 5) == 0) add_triangle(mesh, b, c, a);
  }
  return mesh;
}

/// A closed-looking sheet of hills: neighbours share vertices.
inline Mesh hills(int side) {
  Mesh mesh;
  const auto number = [&](int x, int z) { return static_cast<std::uint32_t>(z * (side + 1) + x); };
  for (int z = 0; z <= side; ++z) {
    for (int x = 0; x <= side; ++x) {
      const float u = 1.8F * static_cast<float>(x) / static_cast<float>(side) - 0.9F;
      const float v = 1.8F * static_cast<float>(z) / static_cast<float>(side) - 0.9F;
      mesh.vertices.emplace_back(u, 0.3F * std::sin(7 * u) * std::cos(5 * v), v);
      if (x == side || z == side) continue;
      mesh.triangles.emplace_back(number(x, z), number(x + 1, z), number(x, z + 1));
      mesh.triangles.emplace_back(number(x + 1, z + 1), number(x, z + 1), number(x + 1, z));
    }
  }
  return mesh;
}

inline Hit test_every_triangle(const Mesh& mesh, const Ray& ray) {
  Hit best;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) intersect_triangle(mesh, i, ray, best);
  return best;
}

/// One ray; `kind` selects what is special about it.
inline Ray special_ray(Random& random, const Mesh& mesh, int kind) {
  const auto vertex = [&] {
    return mesh.vertices[static_cast<std::size_t>(below(random, static_cast<int>(mesh.vertices.size())))];
  };
  const glm::vec3 target = vertex();
  Ray ray{any_point(random), {}, Ray::infinite};
  if (kind % 4 == 1) ray.origin = grid_point(random);
  if (kind % 7 == 2) ray.origin = vertex();
  ray.direction = (kind % 3 == 0 ? 0.5F * (target + vertex()) : target) - ray.origin;
  const int axis = below(random, 3);
  if (kind % 5 == 1) ray.direction[axis] = kind % 2 == 0 ? 0.0F : -0.0F;
  if (kind % 10 == 3) {  // along an axis, through a vertex
    ray.origin = target;
    ray.origin[axis] = -0.95F;
    ray.direction = {0.0F, -0.0F, 0.0F};
    ray.direction[axis] = 1.0F;
  }
  if (kind % 9 == 4) ray.direction[axis] = std::ldexp(ray.direction[axis], -below(random, 140));
  if (kind % 11 == 5) ray.direction *= std::ldexp(1.0F, 100 - below(random, 220));
  if (ray.direction == glm::vec3(0.0F)) ray.direction = {0.0F, 1.0F, 0.0F};
  if (kind % 6 == 5) {  // ends at, or just before, what it hits
    const float length = cull_length(test_every_triangle(mesh, ray));
    ray.length = kind % 12 == 5 ? length : std::nextafter(length, 0.0F);
  }
  return ray;
}

inline std::vector<Ray> special_rays(Random& random, const Mesh& mesh, int count) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) rays.push_back(special_ray(random, mesh, i));
  return rays;
}

/// Components that are zero or subnormal, lengths 0 and infinite, origins in planes of the mesh.
inline std::vector<Ray> stiff_rays(Random& random, const Mesh& mesh, int count) {
  std::vector<Ray> rays;
  const auto vertex = [&] {
    return mesh.vertices[static_cast<std::size_t>(below(random, static_cast<int>(mesh.vertices.size())))];
  };
  for (int i = 0; i < count; ++i) {
    Ray ray{any_point(random), {}, Ray::infinite};
    const glm::vec3 target = vertex();
    const int axis = below(random, 3);
    if (i % 2 == 0) ray.origin[axis] = target[axis];
    if (i % 8 == 3) ray.origin = target;
    ray.direction = (i % 8 == 3 ? vertex() : target) - ray.origin;
    if (i % 3 == 0) ray.direction[axis] = i % 2 == 0 ? 0.0F : -0.0F;
    if (i % 3 == 1) ray.direction[axis] = std::ldexp(ray.direction[axis], -120 - below(random, 30));
    if (i % 5 == 4) ray.direction *= std::ldexp(1.0F, i % 2 == 0 ? -125 : 125);
    if (i % 15 == 1) ray.direction *= std::ldexp(1.0F, 126);
    if (i % 7 == 6) ray.length = 0;
    if (ray.direction == glm::vec3(0.0F)) ray.direction[axis] = std::numeric_limits<float>::denorm_min();
    rays.push_back(ray);
  }
  return rays;
}

inline std::vector<Ray> hard_rays(Random& random, const Mesh& mesh, int count) {
  std::vector<Ray> rays = special_rays(random, mesh, count);
  for (const Ray& ray : stiff_rays(random, mesh, count)) rays.push_back(ray);
  return rays;
}

/// side x side rays from one point, close together.
inline std::vector<Ray> coherent_rays(const glm::vec3& eye, const glm::vec3& target, int side) {
  std::vector<Ray> rays;
  for (int i = 0; i < side * side; ++i) {
    const glm::vec3 offset(static_cast<float>(i % side), 0.0F, static_cast<float>(i / side));
    rays.push_back({eye, target + offset * (0.2F / static_cast<float>(side)) - eye, Ray::infinite});
  }
  return rays;
}

}  // namespace hitpipe::ref
