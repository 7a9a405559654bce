// A hierarchy from a file for a small mesh: it is a tree of boxes over all triangles, as our own is, or one
// line says what is wrong.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "rays/tree/load_bvh.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/fuzz/expect.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

void expect_box(const ref::Aabb& box, const ref::Aabb& around) {
  expect(box.min == glm::max(box.min, around.min) && box.max == glm::min(box.max, around.max),
         "a box lies in its parent's");
  expect(box.min == glm::min(box.min, box.max), "a box is not inverted");
}

void expect_whole(const ref::Bvh& bvh, const ref::Mesh& mesh) {
  const ref::Aabb cube{glm::vec3(-1.0F), glm::vec3(1.0F)};
  expect_box(bvh.nodes.at(0).box, cube);
  std::size_t next = 1;
  std::vector<std::uint32_t> levels(bvh.nodes.size(), 1);
  std::vector<bool> found(mesh.triangles.size());
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i) {
    const ref::BvhNode& node = bvh.nodes[i];
    expect(levels[i] <= ref::BuildOptions::deepest, "the tree is not too deep");
    if (node.is_leaf()) {
      for (std::int32_t k = 0; k < node.count; ++k)
        found.at(bvh.order.at(node.first + static_cast<std::uint32_t>(k))) = true;
      continue;
    }
    expect(node.split_axis() >= 0 && node.split_axis() < 3, "a split is along an axis");
    expect(node.first > i && node.first + 1 < bvh.nodes.size(), "children come after their parent");
    for (const std::uint32_t child : {node.first, node.first + 1}) {
      expect_box(bvh.nodes[child].box, node.box);
      levels[child] = levels[i] + 1;
      ++next;
    }
  }
  expect(next == bvh.nodes.size(), "every node is the child of one");
  for (const bool each : found) expect(each, "every triangle is in a leaf");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const sim::TemporaryFolder folder;
  static const ref::Scene scene =
      ref::load_scene(folder
                          .write("mesh.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 3 1 0.5\nv 4 1 0.5\n"
                                 "f 1 2 3\nf 4 5 6\nf 5 7 6\n")
                          .string());
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = folder.write("a.bvh", text);
  try {
    expect_whole(ref::load_bvh(file, scene).bvh, scene.mesh);
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
