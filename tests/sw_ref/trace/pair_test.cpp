// Records of two boxes, and the test of two boxes at a time: every child is hit exactly when its box alone is
// hit, and the traversal finds the triangles that others find.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/hierarchy/pair_nodes.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "tests/sw_ref/trace/tracer_scenes.hpp"

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
        each_child(bvh, records,
                   [&](std::uint32_t record, unsigned which, const BvhNode& node, const IntBox& box) {
                     ++nodes;
                     const PairChild child = records.child(record, which);
                     ASSERT_EQ(box, quantise_box(node.box, n, g));
                     ASSERT_EQ(child.count, node.is_leaf() ? node.count : PairChild::branch);
                     if (!node.is_leaf()) {
                       ASSERT_EQ(records.split_axis(child.first), node.split_axis());
                     }
                     if (node.is_leaf()) {
                       ASSERT_EQ(child.first, node.first);
                     }
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

/// Each child's interval in the pair, where the parent's is not empty, against that of its box alone.
class Walker {
 public:
  Walker(const Ray& ray, MajorBits bits)
      : distances_(ray, bits), alone_(ray, bits), length_(distances_.length(ray.length)) {}

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
    for (std::size_t slot = 0; slot < 3; ++slot) {
      const RayInterval slab = distances_.slab(slot, box);
      all = {std::max(all.near, slab.near), std::min(all.far, slab.far)};
    }
    return all;
  }

 private:
  MajorDistances distances_;
  IntMajorTest alone_;
  std::int64_t length_;
};

std::vector<Ray> rays_at(const Mesh& mesh, int count) {
  Random random(seed + 1);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray ray{any_point(random), any_point(random), Ray::infinite};
    const glm::vec3 target =
        mesh.vertices[static_cast<std::size_t>(below(random, static_cast<int>(mesh.vertices.size())))];
    if (i % 2 == 0) ray.direction = target - ray.origin;
    // Components of 0, tiny ones and equal ones; ends before, at and behind the target.
    if (i % 3 == 0) ray.direction[below(random, 3)] = 0.0F;
    if (i % 5 == 0) ray.direction[below(random, 3)] *= std::ldexp(1.0F, -below(random, 40));
    if (i % 7 == 0) ray.direction.x = -ray.direction.y;
    if (i % 4 == 0) ray.length = 0.5F * static_cast<float>(below(random, 4));
    if (ray.direction == glm::vec3(0)) ray.direction.z = 1;
    rays.push_back(ray);
  }
  return rays;
}

TEST(PairTest, HitsAChildOfEveryTreeExactlyWhenItsBoxAloneIsHit) {
  int compared = 0;
  int hits = 0;
  for (const Mesh& mesh : meshes()) {
    for (const Bvh& bvh : trees(mesh)) {
      for (const MajorBits bits :
           {MajorBits{20, 1, 13}, MajorBits{6, 0, 4}, MajorBits{12, 3, 8, 2}, MajorBits{16, 2, 9, -2}}) {
        const PairNodes records(bvh, bits.coord, bits.finer);
        for (const Ray& ray : rays_at(mesh, 120)) {
          Walker walker(ray, bits);
          std::vector<std::pair<std::uint32_t, IntBox>> open{{0, records.boxes(0).planes}};
          while (!open.empty()) {
            const auto [record, box] = open.back();
            open.pop_back();
            const RayInterval parent =
                record == 0 ? RayInterval{0, walker.interval_of(box).far} : walker.interval_of(box);
            if (record != 0 && parent.near > parent.far) continue;
            const PairBoxes pair = records.boxes(record);
            const bool both = records.child(record, 1).count != PairChild::none;
            const std::array<IntBox, 2> boxes{box_of_child(pair, 0, box),
                                              both ? box_of_child(pair, 1, box) : box};
            if (record != 0) {
              const int found = walker.compare(pair, parent, boxes);
              ASSERT_GE(found, 0);
              hits += found;
              ++compared;
            }
            for (unsigned which = 0; which < (both ? 2U : 1U); ++which)
              if (const PairChild child = records.child(record, which); child.count == PairChild::branch)
                open.emplace_back(child.first, boxes[which]);
          }
        }
      }
    }
  }
  std::printf("seed %u: %d pairs, %d boxes hit\n", seed, compared, hits);
  EXPECT_GT(compared, 10'000);
  EXPECT_GT(hits, compared / 4);
  EXPECT_LT(hits, 2 * compared);
}

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

TEST(PairTraversal, FindsTheTrianglesThatTheConservativeTraversalFinds) {
  for (const Mesh& mesh : meshes()) {
    for (const Bvh& bvh : trees(mesh)) {
      const std::vector<Ray> rays = rays_at(mesh, 400);
      for (const MajorBits bits : {MajorBits{20, 1, 13}, MajorBits{8, 0, 5}}) {
        const auto pairs = major_pair_tracer(bits, mesh, bvh);
        const auto conservative = make_tracer(mesh, bvh, {});
        for (const Query query : {Query::closest, Query::any}) {
          std::vector<std::uint32_t> found(rays.size());
          std::vector<std::uint32_t> expected(rays.size());
          std::vector<TraceCounts> work(rays.size());
          TraceCounts counts;
          TraceCounts reference;
          pairs->trace({rays, query, found, work}, counts);
          conservative->trace({rays, query, expected}, reference);
          std::uint64_t box_tests = 0;
          for (std::size_t i = 0; i < rays.size(); ++i) {
            if (query == Query::closest) {
              ASSERT_EQ(found[i], expected[i]);
            } else {
              ASSERT_EQ(found[i] == Hit::none, expected[i] == Hit::none);
            }
            box_tests += work[i].box_tests;
          }
          EXPECT_EQ(counts.box_tests, box_tests);
          // One test for the root of each ray, which is for one box; all others are for two.
          EXPECT_EQ(counts.box_tests, 2 * counts.nodes_loaded - rays.size());
          EXPECT_GE(2 * counts.box_tests, reference.box_tests);
        }
      }
    }
  }
}

TEST(PairTraversal, DeepestHierarchyFitsTheStack) {
  const Mesh mesh = one_triangle_a_level();
  const Bvh bvh = build_bvh(mesh, {.max_triangles = 1, .min_split = 0.0F});
  ASSERT_EQ(bvh.depth, BuildOptions::deepest);
  const auto tracer = major_pair_tracer({}, mesh, bvh);
  const std::vector<Ray> rays{{{0.95F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}},
                              {{-0.95F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}},
                              {{0.95F, 0.9F, 0.0F}, {-1.0F, 0.0F, 0.0F}}};
  std::vector<std::uint32_t> found(rays.size());
  std::vector<TraceCounts> work(rays.size());
  TraceCounts counts;
  tracer->trace({rays, Query::closest, found, work}, counts);
  EXPECT_EQ(found[0], 0U);
  EXPECT_NE(found[1], Hit::none);
  EXPECT_EQ(found[2], Hit::none);
  EXPECT_GE(work[1].box_tests, std::uint64_t{BuildOptions::deepest});
}

}  // namespace
}  // namespace hitpipe::ref::pair_test
