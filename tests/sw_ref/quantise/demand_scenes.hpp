// Scenes that need little and one that needs everything, made in code.
#pragma once

#include <utility>

#include <glm/geometric.hpp>

#include "rays/scene/scene.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref {

/// A scene with primary rays only.
inline Scene unlit_hills() {
  Scene scene = sim::hills();
  scene.lights.clear();
  return scene;
}

/// Stairs between an eye and a light, placed so that all rays go towards +x, +y, -z.
inline Scene stairs_along_one_class() {
  SceneDescription scene;
  scene.name = "stairs";
  constexpr unsigned steps = 8;
  for (unsigned step = 0; step < steps; ++step) {
    const auto at = static_cast<float>(step);
    const auto first = static_cast<unsigned>(scene.mesh.vertices.size());
    // A tread that rises a little less steeply than the view, and a riser behind it.
    scene.mesh.vertices.emplace_back(at, at, 0.0F);
    scene.mesh.vertices.emplace_back(at, at, -8.0F);
    scene.mesh.vertices.emplace_back(at + 1.0F, at + 0.5F, 0.0F);
    scene.mesh.vertices.emplace_back(at + 1.0F, at + 0.5F, -8.0F);
    scene.mesh.vertices.emplace_back(at + 1.0F, at + 1.0F, 0.0F);
    scene.mesh.vertices.emplace_back(at + 1.0F, at + 1.0F, -8.0F);
    for (const unsigned part : {0U, 2U}) {
      const unsigned corner = first + part;
      scene.mesh.triangles.emplace_back(corner, corner + 2, corner + 1);
      scene.mesh.triangles.emplace_back(corner + 1, corner + 2, corner + 3);
    }
  }
  scene.materials.push_back({});
  scene.eye = {-20.0, -4.0, 12.0};
  scene.target = {4.0, 3.5, -4.0};
  scene.fov_degrees = 20.0;
  scene.lights.push_back({{14.0, 40.0, -12.0}, {1.0, 1.0, 1.0}});
  return place(std::move(scene));
}

/// The octahedron |x| + |y| + |z| = 1, with mirrors that also scatter, seen from inside its box.
inline Scene demanding_octahedron() {
  SceneDescription scene;
  scene.name = "octahedron";
  for (const float side : {-1.0F, 1.0F}) {
    scene.mesh.vertices.emplace_back(side, 0.0F, 0.0F);
    scene.mesh.vertices.emplace_back(0.0F, side, 0.0F);
    scene.mesh.vertices.emplace_back(0.0F, 0.0F, side);
  }
  for (unsigned octant = 0; octant < 8; ++octant)
    scene.mesh.triangles.emplace_back(3 * (octant & 1U), 3 * (octant >> 1U & 1U) + 1, 3 * (octant >> 2U) + 2);
  scene.materials = {{glm::vec3(0.5F), glm::vec3(0.4F), glm::vec3(0.0F), 1.0F}};
  scene.eye = {0.9, 0.8, 0.95};
  scene.target = {0.0, 0.0, 0.1};
  scene.lights.push_back({{-0.5, 0.9, 0.95}, {1.0, 1.0, 1.0}});
  return place(std::move(scene));
}

/// A square. Every shadow ray starts above its bounds, by the offset at which rays leave surfaces.
inline Scene table_top() {
  SceneDescription scene;
  scene.name = "table";
  for (const float x : {-1.0F, 1.0F})
    for (const float z : {-1.0F, 1.0F}) scene.mesh.vertices.emplace_back(x, 0.0F, z);
  scene.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  scene.materials.push_back({});
  scene.eye = {0.3, 0.8, 0.9};
  scene.lights.push_back({{0.5, 0.9, -0.5}, {1.0, 1.0, 1.0}});
  return place(std::move(scene));
}

/// Hills seen from straight above by an orthographic camera, under a sun straight above.
inline Scene plan_of_hills() {
  Scene scene = sim::hills();
  scene.camera.eye = {0.0F, 0.9F, 0.0F};
  scene.camera.forward = {0.0, -1.0, 0.0};
  scene.camera.right = {1.0, 0.0, 0.0};
  scene.camera.up = {0.0, 0.0, -1.0};
  scene.camera.projection = Projection::orthographic;
  scene.camera.half_height = 0.4;
  scene.lights = {{{0.0F, 1.0F, 0.0F}, glm::vec3(1.0F), LightKind::sun}};
  return scene;
}

/// Hills seen at a slant by an orthographic camera; a part of its image is outside the cube. One light is a
/// sun at a slant, one a point.
inline Scene slanted_hills() {
  Scene scene = sim::hills();
  scene.camera.projection = Projection::orthographic;
  scene.camera.half_height = 0.7;
  scene.lights[1] = {glm::normalize(glm::vec3(0.4F, 0.5F, -0.3F)), glm::vec3(1.0F), LightKind::sun};
  return scene;
}

/// Flattened hills, seen and lit from inside their own slab.
inline Scene flat_hills() {
  Scene scene = sim::hills();
  for (glm::vec3& vertex : scene.mesh.vertices) vertex.y *= 0x1p-3F;
  scene.camera.eye.y = -0x1p-6F;
  scene.camera.forward = {0.0, 0.0, -1.0};
  scene.camera.right = {1.0, 0.0, 0.0};
  scene.camera.up = {0.0, 1.0, 0.0};
  for (Light& light : scene.lights) light.position.y = -0x1p-7F;
  return scene;
}

}  // namespace hitpipe::ref
