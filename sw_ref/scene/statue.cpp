#include <cmath>
#include <vector>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/figure.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::uint8_t floor_material = 0;
constexpr std::uint8_t wall_material = 1;
constexpr std::uint8_t marble = 2;
constexpr std::size_t hall_triangles = 4;  // floor and wall

/// The edge length at which all parts together have just under `wanted` triangles.
double edge_for(const std::vector<EvenSurface>& parts, std::size_t wanted) {
  double low = 1e-5;
  double high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    std::size_t total = 0;
    for (const EvenSurface& part : parts) total += part.triangles(middle);
    (total > wanted ? low : high) = middle;
  }
  return high;
}

/// Adds the figure, mirrored left to right if `mirrored`, and moved along x.
void append_figure(Mesh& mesh, std::size_t wanted, float x, bool mirrored) {
  const std::vector<EvenSurface> parts = winged_figure();
  const double edge = edge_for(parts, wanted);
  const std::size_t first_vertex = mesh.vertices.size();
  const std::size_t first_triangle = mesh.triangles.size();
  for (const EvenSurface& part : parts) part.append(mesh, edge, marble);
  for (std::size_t v = first_vertex; v < mesh.vertices.size(); ++v) {
    glm::vec3& p = mesh.vertices[v];
    p = {(mirrored ? -p.x : p.x) + x, p.y, p.z};
  }
  if (!mirrored) return;
  for (std::size_t t = first_triangle; t < mesh.triangles.size(); ++t)
    std::swap(mesh.triangles[t].y, mesh.triangles[t].z);  // still counter-clockwise from outside
}

BuiltInDescription hall(std::size_t triangles) {
  BuiltInDescription scene;
  scene.mesh.vertices.reserve(triangles / 2 + 1000);
  scene.mesh.triangles.reserve(triangles);
  scene.mesh.materials.reserve(triangles);
  constexpr float half = 5.0F;
  constexpr float ground = -0.12F;
  constexpr float back = -2.4F;
  scene.mesh.vertices = {{-half, ground, back}, {-half, ground, half}, {half, ground, half},
                         {half, ground, back},  {-half, half, back},   {half, half, back}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
  scene.mesh.materials = {floor_material, floor_material, wall_material, wall_material};
  scene.materials = {{.albedo = {0.26F, 0.25F, 0.24F}, .reflect = glm::vec3(0.35F)},
                     {.albedo = {0.30F, 0.36F, 0.40F}},
                     {.albedo = {0.84F, 0.78F, 0.69F}}};
  scene.target = {0.06, 1.0, 0.0};
  scene.eye = {-1.2, 2.2, 4.9};
  scene.fov_degrees = 27.0;
  scene.lights = {{{-3.4, 4.6, 3.4}, {0.85, 0.80, 0.72}}, {{4.2, 2.6, 2.6}, {0.26, 0.29, 0.34}}};
  return scene;
}

}  // namespace

BuiltInDescription statue(std::size_t triangles) {
  BuiltInDescription scene = hall(triangles);
  append_figure(scene.mesh, triangles - hall_triangles, 0.0F, false);
  return scene;
}

BuiltInDescription two_statues(std::size_t triangles) {
  BuiltInDescription scene = hall(triangles);
  const std::size_t second = triangles * 15'000'000 / 43'057'792;  // figure 5.4: 28,057,792 and 15,000,000
  append_figure(scene.mesh, triangles - second - hall_triangles, -0.78F, true);
  append_figure(scene.mesh, second, 0.78F, false);
  scene.target.x = -0.06;
  scene.eye = {-0.7, 1.3, 5.9};
  scene.fov_degrees = 29.0;
  return scene;
}

}  // namespace hitpipe::ref
