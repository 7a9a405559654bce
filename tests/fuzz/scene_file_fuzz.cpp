// A scene file beside a small mesh: it makes a scene that keeps its promises in the cube, or one line says
// what is wrong.
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "rays/scene/scene.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

bool in_cube(const glm::vec3& p) {
  constexpr auto bound = static_cast<float>(ref::cube_bound);
  return std::abs(p.x) <= bound && std::abs(p.y) <= bound && std::abs(p.z) <= bound;
}

void expect_whole(const ref::Scene& scene) {
  for (const glm::vec3& v : scene.mesh.vertices) expect(in_cube(v), "the mesh is in the cube");
  expect(in_cube(scene.camera.eye), "the eye is in the cube");
  for (const ref::Light& light : scene.lights)
    expect(light.kind == ref::LightKind::sun || in_cube(light.position), "lights are in the cube");
  expect(!scene.materials.empty() && scene.materials.size() <= 256, "a byte names each material");
  expect(scene.mesh.materials.empty() || scene.mesh.materials.size() == scene.mesh.triangles.size(),
         "every triangle has a material");
  for (const std::uint8_t material : scene.mesh.materials)
    expect(material < scene.materials.size(), "materials exist");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sim::TemporaryFolder folder;
  static const std::filesystem::path mesh = folder.write(
      "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng a\nusemtl m\nf 1 2 3\nf 1 2 4\ng b\nf 1 3 4\n");
  const std::string text(reinterpret_cast<const char*>(data), size);
  // Making millions of triangles takes longer than a run may.
  if (text.find("built_in") != std::string::npos && text.find("\"spheres\"") == std::string::npos) return 0;
  const std::filesystem::path file = folder.write("scene.json", text);
  try {
    expect_whole(ref::load_scene(file.string()));
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
