// A mesh file of one format (HITPIPE_EXTENSION) as a scene: its mesh keeps the reader's promises, also in the
// cube, or one line says what is wrong.
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <glm/common.hpp>

#include "sw_ref/judge/triangle_test.hpp"
#include "sw_ref/scene/scene.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

void expect_whole(const ref::Mesh& mesh) {
  expect(!mesh.triangles.empty(), "at least one triangle is left");
  for (const glm::vec3& v : mesh.vertices)
    expect(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), "vertices are finite");
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const auto vertices = mesh.vertices.size();
    expect(t.x < vertices && t.y < vertices && t.z < vertices, "indices name vertices");
    expect(ref::has_area(mesh.corners(i)), "triangles have area");
  }
}

}  // namespace

/// Assimp leaks what it has built when it refuses a file. We cannot free that. Leaks of our own are still
/// found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp.so";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sim::TemporaryFolder folder;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = folder.write("mesh." HITPIPE_EXTENSION, bytes);
  try {
    expect_whole(ref::load_scene(file.string()).mesh);
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
