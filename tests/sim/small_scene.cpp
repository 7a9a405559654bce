#include "tests/sim/small_scene.hpp"

#include <cmath>

namespace hitpipe::sim {

ref::Scene hills() {
  constexpr unsigned side = 12;
  ref::SceneDescription scene;
  scene.name = "hills";
  for (unsigned z = 0; z <= side; ++z) {
    for (unsigned x = 0; x <= side; ++x) {
      const auto height = static_cast<float>(1.5 * std::sin(0.9 * x) + (z % 4 < 2 ? 1.0 : 0.0));
      scene.mesh.vertices.emplace_back(static_cast<float>(x), height, static_cast<float>(z));
    }
  }
  for (unsigned z = 0; z < side; ++z) {
    for (unsigned x = 0; x < side; ++x) {
      const unsigned corner = z * (side + 1) + x;
      scene.mesh.triangles.emplace_back(corner, corner + 1, corner + side + 1);
      scene.mesh.triangles.emplace_back(corner + 1, corner + side + 2, corner + side + 1);
    }
  }
  scene.materials.push_back({});
  scene.eye = {9.0, 7.0, 22.0};
  scene.target = {6.0, 0.5, 6.0};
  scene.fov_degrees = 45.0;
  scene.lights.push_back({{-4.0, 9.0, 10.0}, {0.8, 0.8, 0.7}});
  scene.lights.push_back({{16.0, 3.0, 6.0}, {0.3, 0.3, 0.4}});
  return ref::place(std::move(scene));
}

ref::Scene hills_from_outside() {
  ref::Scene scene = hills();
  scene.camera.eye.z = std::nextafter(1.0F, 2.0F);
  return scene;
}

}  // namespace hitpipe::sim
