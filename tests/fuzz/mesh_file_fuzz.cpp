// A mesh file of one format (HITPIPE_EXTENSION) as a scene: its mesh keeps the reader's promises, also in the
// cube, or one line says what is wrong.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include "rays/exact/exact_triangle.hpp"
#include "rays/files/mesh_file.hpp"
#include "rays/scene/scene.hpp"
#include "sw_ref/scene/mesh_scene.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

template <class Vertex>
void expect_whole(const ref::MeshOf<Vertex>& mesh) {
  expect(!mesh.triangles.empty(), "at least one triangle is left");
  for (const Vertex& v : mesh.vertices)
    expect(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), "vertices are finite");
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const auto vertices = mesh.vertices.size();
    expect(t.x < vertices && t.y < vertices && t.z < vertices, "indices name vertices");
    expect(ref::has_area(mesh.corners(i)), "triangles have area");
  }
}

void expect_covering(const std::vector<ref::MeshGroup>& groups, const ref::SourceMesh& mesh) {
  std::uint32_t end = 0;
  for (const ref::MeshGroup& group : groups) {
    expect(group.first == end, "groups follow one another");
    end += group.count;
  }
  expect(end == mesh.triangles.size(), "groups cover the mesh");
}

/// Flattened, instances have as many triangles as the mesh, which is null where the file is refused.
void expect_instances(std::string_view bytes, const std::filesystem::path& file,
                      const ref::SourceMesh* mesh) {
  try {
    const ref::OwnInstances own = ref::load_instances(bytes, file);
    std::size_t triangles = 0;
    for (const ref::OwnInstance& instance : own.instances) {
      expect(instance.mesh < own.meshes.size(), "instances name meshes");
      triangles += own.meshes[instance.mesh].triangles.size();
    }
    if (mesh != nullptr)
      expect(triangles == mesh->triangles.size() + mesh->dropped.size(), "instances have all triangles");
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sim::TemporaryFolder folder;  // where files that the mesh names would be
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = folder / "mesh." HITPIPE_EXTENSION;
  std::optional<ref::SourceMesh> read;
  try {
    std::vector<ref::MeshGroup> groups;
    read = ref::load_mesh(bytes, file, groups);
    ref::SourceMesh mesh = *read;
    expect_whole(mesh);
    expect_covering(groups, mesh);
    expect_whole(ref::place(ref::mesh_scene(std::move(mesh), "mesh", groups)).mesh);
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
  expect_instances(bytes, file, read ? &*read : nullptr);
  return 0;
}
