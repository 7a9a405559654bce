#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/plant_parts.hpp"

namespace hitpipe::ref {
namespace {

void build_plant(Shapes& shapes, double detail) {
  shapes.material(plant::yard);
  shapes.quad({-40, 0, 80}, {100, 0, 80}, {100, 0, -40}, {-40, 0, -40});
  plant::add_steelwork(shapes, detail);
  plant::add_pipework(shapes, detail);
  plant::add_vessels(shapes, detail);
  plant::add_boiler(shapes, detail);
}

BuiltInDescription whole_plant(std::size_t triangles) {
  BuiltInDescription scene;
  scene.mesh.triangles.reserve(triangles);
  scene.mesh.materials.reserve(triangles);
  scene.mesh.vertices.reserve(triangles * 2 / 3);  // a box has 8 vertices for 12 triangles, a rod 1 for 1
  Shapes shapes(scene.mesh, Shapes::Normals::flat);
  build_plant(shapes, detail_for(triangles, build_plant));
  scene.materials = {{.albedo = {0.30F, 0.30F, 0.30F}, .reflect = glm::vec3(0.18F)},
                     {.albedo = {0.62F, 0.60F, 0.57F}},
                     {.albedo = {0.44F, 0.32F, 0.27F}},
                     {.albedo = {0.52F, 0.54F, 0.56F}},
                     {.albedo = {0.90F, 0.72F, 0.18F}},
                     {.albedo = {0.60F, 0.63F, 0.66F}},
                     {.albedo = {0.30F, 0.52F, 0.40F}},
                     {.albedo = {0.27F, 0.42F, 0.62F}},
                     {.albedo = {0.72F, 0.27F, 0.20F}},
                     {.albedo = {0.74F, 0.73F, 0.70F}},
                     {.albedo = {0.84F, 0.83F, 0.80F}},
                     {.albedo = {0.20F, 0.21F, 0.23F}},
                     {.albedo = {0.62F, 0.46F, 0.36F}}};
  return scene;
}

/// Keeps the triangles whose corners all lie within `reach` of the plane z = `middle`, and their vertices.
void cut_to_slab(Mesh& mesh, double middle, double reach) {
  constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
  const Mesh whole = std::exchange(mesh, {});
  std::vector<std::uint32_t> moved(whole.vertices.size(), unused);
  const auto kept = [&](std::uint32_t vertex) {
    if (moved[vertex] == unused) {
      moved[vertex] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(whole.vertices[vertex]);
    }
    return moved[vertex];
  };
  for (std::uint32_t i = 0; i < whole.triangles.size(); ++i) {
    const Mesh::Corners corners = whole.corners(i);
    const auto within = [&](const glm::vec3& p) { return std::abs(double{p.z} - middle) <= reach; };
    if (!within(corners.a) || !within(corners.b) || !within(corners.c)) continue;
    const glm::uvec3& t = whole.triangles[i];
    mesh.triangles.push_back({kept(t.x), kept(t.y), kept(t.z)});
    mesh.materials.push_back(whole.materials[i]);
  }
}

}  // namespace

BuiltInDescription plant_front(std::size_t triangles) {
  BuiltInDescription scene = whole_plant(triangles);
  scene.eye = {6.0, 24.0, 96.0};
  scene.target = {33.0, 19.5, 16.0};
  scene.fov_degrees = 50.0;
  scene.lights = {{{-25.0, 62.0, 85.0}, {0.95, 0.89, 0.78}}};
  return scene;
}

BuiltInDescription plant_north(std::size_t triangles) {
  BuiltInDescription scene = whole_plant(triangles);
  scene.eye = {66.0, 2.2, -14.0};
  scene.target = {34.0, 19.0, 20.0};
  scene.fov_degrees = 60.0;
  scene.lights = {{{85.0, 30.0, -35.0}, {0.62, 0.58, 0.50}},
                  {{20.0, 3.5, -20.0}, {0.42, 0.38, 0.32}},
                  {{56.0, 15.0, 18.0}, {0.34, 0.38, 0.42}}};
  return scene;
}

BuiltInDescription plant_boiler(std::size_t triangles) {
  BuiltInDescription scene = whole_plant(triangles);
  scene.eye = {25.0, 9.5, 20.4};
  scene.target = {31.0, 18.5, 13.5};
  scene.fov_degrees = 75.0;
  scene.lights = {{{27.5, 12.0, 17.5}, {1.0, 0.90, 0.74}}};
  return scene;
}

BuiltInDescription plant_slice(std::size_t /*triangles*/) {
  BuiltInDescription scene = whole_plant(400'000);
  constexpr double middle = 20.0;  // of the yard
  cut_to_slab(scene.mesh, middle, 1.4);
  scene.eye = {-2.0, 12.0, middle + 0.3};
  scene.target = {50.0, 19.0, middle - 0.2};
  scene.fov_degrees = 60.0;
  scene.lights = {{{-20.0, 62.0, middle}, {1.0, 0.94, 0.84}}};
  return scene;
}

}  // namespace hitpipe::ref
