// Records of two boxes, and the test of two boxes at a time: every child is hit exactly when its box alone is
// hit.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rays/world/pair_nodes.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "tests/rays/trace/tracer_scenes.hpp"

namespace hitpipe::ref::pair_test {
namespace {

using hls::MajorBits;

constexpr unsigned seed = 2022;

/// The box of a child: its own planes, and else its parent's.
IntBox box_of_child(const PairBoxes& pair, unsigned which, const IntBox& parent) {
  IntBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] = (pair.owners >> i & 1U) == which ? pair.planes.min[i] : parent.min[i];
    box.max[i] = (pair.owners >> (i + 3) & 1U) == which ? pair.planes.max[i] : parent.max[i];
  }
  return box;
}

std::vector<Mesh> meshes() {
  Random random(seed);
  std::vector<Mesh> all{soup(random, 300), grid_soup(random, 200)};
  Mesh one;
  add_triangle(one, {-0.5F, 0, 0}, {0.5F, 0, 0}, {0, 0.5F, 0.25F});
  all.push_back(one);
  return all;
}

std::vector<Bvh> trees(const Mesh& mesh) {
  return {build_bvh(mesh), build_bvh(mesh, {.builder = Builder::sah, .max_triangles = 1})};
}

/// Calls visit(record, which child, its node, its box) for every child of the records.
template <class Visit>
void each_child(const Bvh& bvh, const PairNodes& records, Visit&& visit) {
  struct Open {
    std::uint32_t record;
    IntBox parent;
  };
  std::vector<Open> open{{0, records.boxes(0).planes}};
  while (!open.empty()) {
    const auto [record, parent] = open.back();
    open.pop_back();
    for (unsigned which = 0; which < 2; ++which) {
      const PairChild child = records.child(record, which);
      if (child.count == PairChild::none) continue;
      const IntBox box = box_of_child(records.boxes(record), which, parent);
      visit(record, which, bvh.nodes[records.first_node(record) + which], box);
      if (child.count == PairChild::branch) open.push_back({child.first, box});
    }
  }
}

TEST(PairNodes, HoldTheBoxesAndTrianglesOfAllNodes) {
  for (const Mesh& mesh : meshes()) {
    for (const Bvh& bvh : trees(mesh)) {
      for (const auto& [n, g] : {std::pair{6, 0}, {16, 1}, {20, 1}, {20, 3}, {31, 2}, {32, 0}}) {
        const PairNodes records(bvh, n, g);
        std::size_t nodes = 0;
        EXPECT_EQ(records.split_axis(0), 0);
        each_child(
            bvh, records,
            [&, n = n, g = g](std::uint32_t record, unsigned which, const BvhNode& node, const IntBox& box) {
              ++nodes;
              const PairChild child = records.child(record, which);
              ASSERT_EQ(box, quantise_box(node.box, n, g));
              ASSERT_EQ(child.count, node.is_leaf() ? node.count : PairChild::branch);
              ASSERT_TRUE(node.is_leaf() ? child.first == node.first
                                         : records.split_axis(child.first) == node.split_axis());
            });
        EXPECT_EQ(nodes, bvh.nodes.size());
        EXPECT_EQ(records.size(), (bvh.nodes.size() + 1) / 2);
      }
    }
  }
}

TEST(PairNodes, TakeSixPlanesSixOwnersAnAxisAndTwoReferences) {
  const Bvh bvh = build_bvh(meshes().front());
  EXPECT_EQ(PairNodes(bvh, 6, 0).bytes_per_record, 6U + 16U);  // 44 bits
  EXPECT_EQ(PairNodes(bvh, 16, 0).bytes_per_record, 13U + 16U);
  EXPECT_EQ(PairNodes(bvh, 20, 1).bytes_per_record, 16U + 16U);
  EXPECT_EQ(PairNodes(bvh, 24, 1).bytes_per_record, 19U + 16U);
  EXPECT_EQ(PairNodes(bvh, 32, 1).bytes_per_record, 25U + 16U);
}

TEST(PairNodes, RefitParentsThatAreLooserThanTheirChildren) {
  const Bvh bvh = build_bvh(meshes().front());
  Bvh loose = bvh;
  for (BvhNode& node : loose.nodes) {
    if (node.is_leaf()) continue;
    node.box.min -= glm::vec3(0.03F, 0, 0.01F);
    node.box.max += glm::vec3(0, 0.02F, 0);
  }
  const PairNodes tight(bvh, 20, 1);
  const PairNodes refitted(loose, 20, 1);
  ASSERT_EQ(tight.size(), refitted.size());
  for (std::uint32_t record = 0; record < tight.size(); ++record)
    ASSERT_EQ(tight.boxes(record), refitted.boxes(record));
}

TEST(PairNodes, RefuseBoxesOutsideTheGrid) {
  Bvh bvh = build_bvh(meshes().back());
  bvh.nodes[0].box.max.x = 1.5F;
  EXPECT_THROW(PairNodes(bvh, 16, 1), std::out_of_range);
  EXPECT_THROW(PairNodes(build_bvh(meshes().back()), 33, 0), std::invalid_argument);
}

/// Each child's interval in the pair, where the parent's is not empty, against its box's interval alone.
class Walker {
 public:
  Walker(const Ray& ray, MajorBits bits)
      : Walker(IntMajorRaySetup(ray, bits), IntMajorTest(ray, bits), ray.length, bits) {}

  /// Counts answers of 1; -1 when one differs.
  int compare(const PairBoxes& pair, const RayInterval& parent, const std::array<IntBox, 2>& boxes) {
    const PairAnswer answer = test_pair(distances_, pair, parent);
    int hits = 0;
    for (std::size_t which = 0; which < 2; ++which) {
      if (answer.hit[which] != alone_(boxes[which])) return -1;
      const RayInterval own = interval_of(boxes[which]);
      if (answer.hit[which] &&
          (answer.interval[which].near != own.near || answer.interval[which].far != own.far))
        return -1;
      hits += answer.hit[which] ? 1 : 0;
    }
    if (answer.hit[0] && answer.hit[1] &&
        answer.second_first != (answer.interval[1].near < answer.interval[0].near))
      return -1;
    return hits;
  }
  [[nodiscard]] RayInterval interval_of(const IntBox& box) const {
    RayInterval all{0, length_};
    for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
      const RayInterval slab = distances_.slab(ray_axis, box);
      all = {std::max(all.near, slab.near), std::min(all.far, slab.far)};
    }
    return all;
  }

 private:
  Walker(const IntMajorRaySetup& set_up, const IntMajorTest& alone, float length, MajorBits bits)
      : distances_(set_up.ray(), bits), alone_(alone), length_(set_up.length(length)) {}

  MajorDistances distances_;
  IntMajorTest alone_;
  std::int64_t length_;
};

/// All pairs of intervals on one axis of a 4-bit grid, with all origins of a fine lattice and directions of
/// three lengths: what a slab of the pair says depends on nothing else.
TEST(PairTest, HitsAChildExactlyWhenItsBoxAloneIsHitForAllSlabsOfASmallGrid) {
  constexpr int limit = 4;
  int hits = 0;
  int compared = 0;
  for (const MajorBits bits : {MajorBits{4, 0, 3}, MajorBits{4, 1, 3, 1}}) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      for (const float along : {-1.0F, -0.25F, 0.0F, 0.375F, 1.0F}) {
        for (const float across : {-1.0F, 0.5F}) {
          for (int at = -7; at <= 7; ++at) {
            Ray ray{glm::vec3(-0.25F), glm::vec3(across), Ray::infinite};
            ray.direction[axis] = along;
            ray.origin[axis] = static_cast<float>(at) / 7.0F;
            Walker walker(ray, bits);
            for (int a0 = -limit; a0 <= limit; ++a0)
              for (int a1 = a0; a1 <= limit; ++a1)
                for (int b0 = -limit; b0 <= limit; ++b0)
                  for (int b1 = b0; b1 <= limit; ++b1) {
                    std::array<IntBox, 2> boxes;
                    for (IntBox& box : boxes) box = {{-2, -2, -2}, {1, 1, 1}};
                    boxes[0].min[i] = a0;
                    boxes[0].max[i] = a1;
                    boxes[1].min[i] = b0;
                    boxes[1].max[i] = b1;
                    const RayInterval parent = walker.interval_of(union_of(boxes[0], boxes[1]));
                    if (parent.near > parent.far) continue;
                    const int found = walker.compare(pair_boxes(boxes[0], boxes[1]), parent, boxes);
                    ASSERT_GE(found, 0);
                    hits += found;
                    ++compared;
                  }
          }
        }
      }
    }
  }
  EXPECT_GT(compared, 500'000);
  EXPECT_GT(hits, compared / 4);
}

}  // namespace
}  // namespace hitpipe::ref::pair_test
