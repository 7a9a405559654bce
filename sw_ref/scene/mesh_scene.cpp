#include "sw_ref/scene/mesh_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "rays/mesh/mesh.hpp"
#include "rays/scene/normalise.hpp"

namespace hitpipe::ref {
namespace {

/// The side of the box that the triangle lies in, 0..5 (axis, then min or max), or -1. Bounds are coordinates of
/// vertices, so equality is exact.
int side_of(const SourceMesh::Corners& t, const Bounds& walls) {
  for (int axis = 0; axis < 3; ++axis) {
    if (t.a[axis] != t.b[axis] || t.a[axis] != t.c[axis]) continue;
    if (t.a[axis] == walls.min[axis]) return 2 * axis;
    if (t.a[axis] == walls.max[axis]) return 2 * axis + 1;
  }
  return -1;
}

/// A room is a mesh whose triangles cover its own bounding box. From outside it looks like a closed box, so
/// its camera must be inside. The bounds of the room's contents; nothing if the mesh is not a room or the
/// room is empty. In a room the triangles in each of the six planes of the bounding box have a total area of
/// at least 99 % of that side.
std::optional<Bounds> room_contents(const SourceMesh& mesh, const Bounds& walls) {
  constexpr double covered = 0.99;
  const glm::dvec3 size = walls.max - walls.min;
  std::array<double, 6> area{};
  std::optional<Bounds> contents;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const SourceMesh::Corners t = mesh.corners(i);
    if (const int side = side_of(t, walls); side >= 0) {
      area[static_cast<std::size_t>(side)] += 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
      continue;
    }
    if (!contents) contents = Bounds{t.a, t.a};
    for (const glm::dvec3& corner : {t.a, t.b, t.c}) contents->grow(corner);
  }
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double whole = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    if (!(area[static_cast<std::size_t>(side)] >= covered * whole) || whole == 0.0) return std::nullopt;
  }
  return contents;
}

/// The view from inside a room towards its contents, lit from below the ceiling.
void move_inside(SceneDescription& scene, const Bounds& walls, const Bounds& contents) {
  constexpr double margin = 0.05;  // of the room, kept between the walls and camera or lights
  const glm::dvec3 low = walls.min + margin * (walls.max - walls.min);
  const glm::dvec3 high = walls.max - margin * (walls.max - walls.min);
  scene.target = contents.centre();
  const double radius = glm::length(contents.max - contents.min) * 0.5;
  const glm::dvec3 back = glm::normalize(glm::dvec3(0.35, 0.25, 1.0));
  constexpr double widest = 75.0;  // degrees; a wider view looks distorted
  const double away = radius / std::sin(glm::radians(50.0 / 2.0));
  scene.eye = glm::clamp(scene.target + back * away, low, high);
  // If the room is too small for that distance, the view is as wide as the contents need.
  const double sine = std::min(1.0, radius / glm::length(scene.eye - scene.target));
  scene.fov_degrees = std::min(widest, glm::degrees(2.0 * std::asin(sine)));
  scene.lights[0].position = glm::mix(low, high, glm::dvec3(0.2, 1.0, 0.8));
  scene.lights[1].position = glm::mix(low, high, glm::dvec3(0.9, 0.8, 0.6));
}

float distance(const Material& a, const Material& b) {
  const float index = a.refractive_index - b.refractive_index;
  return glm::dot(a.albedo - b.albedo, a.albedo - b.albedo) +
         glm::dot(a.reflect - b.reflect, a.reflect - b.reflect) +
         glm::dot(a.transmit - b.transmit, a.transmit - b.transmit) + index * index;
}

/// The number of the surface among the materials, where it is added if there is room.
std::uint8_t number_of(const Material& surface, std::vector<Material>& materials) {
  constexpr std::size_t most = 256;  // the index of a triangle's material is one byte
  const auto nearest = std::min_element(
      materials.begin(), materials.end(),
      [&](const Material& a, const Material& b) { return distance(a, surface) < distance(b, surface); });
  if (distance(*nearest, surface) == 0.0F || materials.size() == most)
    return static_cast<std::uint8_t>(nearest - materials.begin());
  materials.push_back(surface);
  return static_cast<std::uint8_t>(materials.size() - 1);
}

void assign_surfaces(SceneDescription& scene, std::span<const MeshGroup> groups) {
  if (std::none_of(groups.begin(), groups.end(),
                   [](const MeshGroup& group) { return group.surface.has_value(); }))
    return;
  scene.mesh.materials.assign(scene.mesh.triangles.size(), 0);
  for (const MeshGroup& group : groups) {
    if (!group.surface) continue;
    std::fill_n(scene.mesh.materials.begin() + group.first, group.count,
                number_of(*group.surface, scene.materials));
  }
}

}  // namespace

SceneDescription mesh_scene(SourceMesh mesh, std::string name, std::span<const MeshGroup> groups) {
  const Bounds box = mesh_bounds(mesh);
  const double radius = glm::length((box.max - box.min) / box.longest()) * 0.5 * box.longest();
  SceneDescription scene{std::move(name), std::move(mesh), {}, {}, box.centre(), {0.0, 1.0, 0.0}, 40.0, {}};
  scene.materials.push_back({{0.72F, 0.66F, 0.58F}});
  scene.eye = scene.target + glm::normalize(glm::dvec3(0.45, 0.35, 1.0)) *
                                 (radius / std::sin(glm::radians(scene.fov_degrees / 2.0)));
  scene.lights.push_back({scene.target + glm::dvec3(-1.2, 1.8, 1.6) * radius, {0.85, 0.80, 0.72}});
  scene.lights.push_back({scene.target + glm::dvec3(2.0, 0.7, 1.2) * radius, {0.22, 0.25, 0.30}});
  assign_surfaces(scene, groups);
  if (const auto contents = room_contents(scene.mesh, box)) move_inside(scene, box, *contents);
  return scene;
}

}  // namespace hitpipe::ref
