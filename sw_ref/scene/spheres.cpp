// The built-in scene: an octahedron's eight faces, halved along their edges four times and pushed out to the
// sphere, give 8 * 4^4 = 2,048 triangles; twelve such spheres and a square floor make 24,578.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {
namespace {

struct UnitSphere {
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
};

/// Each triangle becomes four; a new point on an edge is made once for both its triangles.
UnitSphere refined(const UnitSphere& coarse) {
  UnitSphere fine{coarse.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> on_edge;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [entry, is_new] =
        on_edge.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.points.size()));
    if (is_new) fine.points.push_back(glm::normalize(fine.points[a] + fine.points[b]));
    return entry->second;
  };
  for (const glm::uvec3& t : coarse.triangles) {
    // In braces the vertices are made from left to right.
    const glm::uvec3 m{middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x)};
    fine.triangles.insert(fine.triangles.end(), {{t.x, m.x, m.z}, {m.x, t.y, m.y}, {m.z, m.y, t.z}, m});
  }
  return fine;
}

UnitSphere unit_sphere() {
  UnitSphere sphere{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < 4; ++level) sphere = refined(sphere);
  return sphere;
}

struct Ball {
  glm::dvec3 centre;
  double radius;
};

constexpr double half_floor = 9.0;

/// y is up, and the floor is at y = 0. Nine balls rest on the floor and three on other balls.
constexpr std::array<Ball, 12> balls{{{{-0.15, 1.30, -0.60}, 1.30},
                                      {{2.15, 0.95, -0.35}, 0.95},
                                      {{-2.35, 0.80, 0.10}, 0.80},
                                      {{0.95, 0.55, 1.25}, 0.55},
                                      {{-1.05, 0.45, 1.50}, 0.45},
                                      {{2.55, 0.40, 1.35}, 0.40},
                                      {{-2.35, 0.36, 1.60}, 0.36},
                                      {{0.05, 0.28, 2.15}, 0.28},
                                      {{1.75, 0.26, 2.15}, 0.26},
                                      {{-0.15, 3.22, -0.60}, 0.62},
                                      {{2.15, 2.32, -0.35}, 0.42},
                                      {{-2.35, 1.95, 0.10}, 0.35}}};

Material solid(const glm::vec3& albedo) {
  return {.albedo = albedo};
}

/// It mirrors light in its own colour and loses the rest.
Material mirror(const glm::vec3& colour) {
  return {.albedo = 0.06F * colour, .reflect = 0.84F * colour};
}

/// It does not mirror from outside, so that no ray becomes two.
Material glass(const glm::vec3& colour) {
  return {.albedo = glm::vec3(0.0F), .transmit = 0.92F * colour, .refractive_index = 1.5F};
}

const std::vector<Material> palette{solid({0.66F, 0.63F, 0.60F}),   // floor: warm grey
                                    mirror({1.00F, 0.97F, 0.92F}),  // silver
                                    glass({0.96F, 1.00F, 0.98F}),   // clear
                                    solid({0.82F, 0.47F, 0.38F}),   // coral
                                    glass({1.00F, 0.90F, 0.72F}),   // amber
                                    solid({0.47F, 0.60F, 0.47F}),   // sage
                                    mirror({1.00F, 0.80F, 0.50F}),  // gold
                                    solid({0.38F, 0.47F, 0.66F}),   // slate blue
                                    glass({0.80F, 0.92F, 1.00F}),   // ice
                                    solid({0.60F, 0.66F, 0.72F}),   // mist
                                    solid({0.88F, 0.68F, 0.35F}),   // ochre
                                    mirror({1.00F, 0.80F, 0.72F}),  // copper
                                    solid({0.36F, 0.55F, 0.58F})};  // teal

void append(Mesh& mesh, const UnitSphere& sphere, const Ball& ball, std::uint8_t material) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const glm::dvec3& p : sphere.points) {
    mesh.vertices.emplace_back(ball.centre + p * ball.radius);
    mesh.normals.emplace_back(p);
  }
  for (const glm::uvec3& t : sphere.triangles) {
    mesh.triangles.push_back(t + base);
    mesh.materials.push_back(material);
  }
}

void append_floor(Mesh& mesh) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  constexpr auto h = static_cast<float>(half_floor);
  mesh.vertices.insert(mesh.vertices.end(), {{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}});
  mesh.normals.insert(mesh.normals.end(), 4, {0, 1, 0});
  mesh.triangles.insert(mesh.triangles.end(), {{base, base + 1, base + 2}, {base, base + 2, base + 3}});
  mesh.materials.insert(mesh.materials.end(), 2, 0);
}

}  // namespace

BuiltInDescription spheres() {
  BuiltInDescription scene;
  scene.name = "spheres";
  append_floor(scene.mesh);
  const UnitSphere sphere = unit_sphere();
  for (std::size_t i = 0; i < balls.size(); ++i)
    append(scene.mesh, sphere, balls[i], static_cast<std::uint8_t>(i + 1));
  scene.materials = palette;
  scene.eye = {0.5, 3.9, 9.4};
  scene.target = {0.0, 1.42, 0.0};
  scene.fov_degrees = 39.0;
  scene.lights = {{{-5.5, 8.5, 6.0}, {0.90, 0.83, 0.70}}, {{7.0, 6.0, 5.0}, {0.16, 0.19, 0.25}}};
  return scene;
}

}  // namespace hitpipe::ref
