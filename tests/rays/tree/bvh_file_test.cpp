// Hierarchies from files: what they become, and what is refused.
#include "rays/tree/bvh_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/scene/scene.hpp"
#include "rays/tree/load_bvh.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::ref::bvh_file_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// `count` triangles of side 1 in a row along x, from x = 100 on, one at every second x. They are slanted.
std::string row_of(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += fmt::format("v {0} 0 0\nv {1} 0 0\nv {0} 1 0.5\n", 100 + 2 * i, 101 + 2 * i);
  for (int i = 0; i < count; ++i) text += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
  return text;
}

/// The box around the triangles first to last of such a row.
std::string box(int first, int last) {
  return fmt::format("{} 0 0 {} 1 0.5", 100 + 2 * first, 101 + 2 * last);
}

class BvhFile : public testing::Test {
 protected:
  [[nodiscard]] Scene scene_of(const std::string& mesh) const {
    return load_scene(folder_.write("row.obj", mesh).string());
  }
  [[nodiscard]] LoadedBvh load(const std::string& text, const Scene& scene,
                               float padding = BuildOptions{}.padding) const {
    return load_bvh(folder_.write("a.bvh", text), scene, padding);
  }
  /// Without the name of the file.
  [[nodiscard]] std::string refusal(const std::string& text, const Scene& scene) const {
    const std::string message = message_of<std::runtime_error>([&] { (void)load(text, scene); });
    const std::string start = fmt::format("BVH file \"{}\": ", (folder_.path() / "a.bvh").string());
    return message.starts_with(start) ? message.substr(start.size()) : message;
  }

  sim::TemporaryFolder folder_;
  const Scene two_ = scene_of(row_of(2));
};

std::string two_triangles() {
  return "hitpipe-bvh 1\nspace scene\nnodes 3\nbranch " + box(0, 1) + " 1 2\nleaf " + box(0, 0) +
         " 0 1\nleaf " + box(1, 1) + " 1 1\ntriangles 2\n0 1\n";
}

/// The same file with the first `from` replaced.
std::string changed(const std::string& from, const std::string& to, std::string text = two_triangles()) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

bool same_bits(const Bvh& a, const Bvh& b) {
  if (a.nodes.size() != b.nodes.size() || a.order != b.order || a.depth != b.depth) return false;
  return std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

TEST_F(BvhFile, OfOurOwnHierarchyGivesItBackBitForBit) {
  const Scene scene = load_scene("spheres");
  for (const Builder builder : {Builder::median, Builder::sah}) {
    const Bvh built = build_bvh(scene.mesh, {.builder = builder});
    const LoadedBvh loaded = load(bvh_text(built, scene.mesh), scene);
    EXPECT_TRUE(same_bits(loaded.bvh, built));
    EXPECT_EQ(loaded.boxes_grown, 0U);
  }
}

TEST_F(BvhFile, MovesBoxesWithTheSceneRoundsThemOutwardAndPadsThem) {
  for (const float padding : {0.0F, 1e-4F}) {
    const LoadedBvh loaded = load(two_triangles(), two_, padding);
    ASSERT_EQ(loaded.bvh.nodes.size(), 3U);
    EXPECT_EQ(loaded.boxes_grown, 0U);
    EXPECT_EQ(loaded.bvh.depth, 2);
    const Aabb& root = loaded.bvh.nodes[0].box;
    const glm::dvec3 low = two_.to_cube.to_cube({100, 0, 0});
    const glm::dvec3 high = two_.to_cube.to_cube({103, 1, 0.5});
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(double{root.min[axis]}, low[axis] - 0.999 * double{padding});
      EXPECT_GE(double{root.max[axis]}, high[axis] + 0.999 * double{padding});
      EXPECT_NEAR(root.min[axis], low[axis] - double{padding}, 2e-7);
      EXPECT_NEAR(root.max[axis], high[axis] + double{padding}, 2e-7);
    }
    EXPECT_EQ(loaded.bvh.nodes[0].split_axis(), 0);
    EXPECT_THAT(loaded.bvh.order, ElementsAre(0U, 1U));
  }
}

/// Of a plane that no binary32 number of the cube is, both boxes that share it take the outer neighbour.
TEST_F(BvhFile, RoundsOutwardWhereAPlaneFallsBetweenTwoNumbers) {
  const std::string loose = changed("leaf 102 0 0 103 1 0.5", "leaf 101.7 0 0 103 1 0.5",
                                    changed("leaf 100 0 0 101", "leaf 100 0 0 101.7"));
  const LoadedBvh loaded = load(loose, two_, 0.0F);
  const double plane = two_.to_cube.to_cube(glm::dvec3(101.7F)).x;
  const float below = loaded.bvh.nodes[2].box.min.x;
  const float above = loaded.bvh.nodes[1].box.max.x;
  EXPECT_LT(double{below}, plane);
  EXPECT_GT(double{above}, plane);
  EXPECT_EQ(std::nextafter(below, 1.0F), above);
}

TEST_F(BvhFile, OrdersChildrenByTheirCentresUnlessASplitIsStated) {
  const std::string swapped = changed(" 1 2\n", " 2 1\n");
  EXPECT_THAT(load(swapped, two_).bvh.order, ElementsAre(0U, 1U));
  const LoadedBvh stated = load(changed(" 1 2\n", " 2 1 split z\n"), two_);
  EXPECT_THAT(stated.bvh.order, ElementsAre(1U, 0U));
  EXPECT_EQ(stated.bvh.nodes[0].split_axis(), 2);
}

TEST_F(BvhFile, SplitsWideBranchesInHalves) {
  const Scene scene = scene_of(row_of(5));
  std::string text = "hitpipe-bvh 1\nspace scene\nnodes 6\nbranch " + box(0, 4) + " 5 1 4 2 3\n";
  for (int i = 0; i < 5; ++i) text += fmt::format("leaf {} {} 1\n", box(i, i), i);
  const LoadedBvh loaded = load(text + "triangles 5\n0 1 2 3 4\n", scene, 0.0F);
  const std::vector<BvhNode>& nodes = loaded.bvh.nodes;
  ASSERT_EQ(nodes.size(), 9U);
  EXPECT_EQ(loaded.bvh.depth, 4);
  EXPECT_THAT(loaded.bvh.order, ElementsAre(0U, 1U, 2U, 3U, 4U));
  // 0 to 2 and 3 to 4. The box of a branch that was made is the union of its children's.
  for (const BvhNode& node : nodes) {
    if (node.is_leaf()) continue;
    EXPECT_EQ(node.split_axis(), 0);
    Aabb both = nodes[node.first].box;
    both.grow(nodes[node.first + 1].box);
    EXPECT_EQ(node.box.min, both.min);
    EXPECT_EQ(node.box.max, both.max);
  }
  EXPECT_EQ(nodes[2].box.min.x, nodes[nodes[2].first].box.min.x);
  EXPECT_TRUE(nodes[nodes[2].first].is_leaf());
}

TEST_F(BvhFile, ReplacesBranchesOfOneChildAndLeavesOutEmptyLeaves) {
  const std::string text = "hitpipe-bvh 1\nspace scene\nnodes 6\nbranch 90 -1 -1 110 2 2 1\nbranch " +
                           box(0, 1) + " 2 3\nbranch " + box(0, 0) + " 4 5\nleaf " + box(1, 1) +
                           " 1 1\nleaf " + box(0, 0) +
                           " 0 1\nleaf inf inf inf -inf -inf nan 0 0\ntriangles 2\n0 1\n";
  const LoadedBvh loaded = load(text, two_);
  const LoadedBvh plain = load(two_triangles(), two_);
  EXPECT_TRUE(same_bits(loaded.bvh, plain.bvh));
}

TEST_F(BvhFile, ReadsCommentsBlankLinesHexadecimalAndBoxesThatReachFarBeyondTheScene) {
  const std::string text =
      "# a comment\r\n\nhitpipe-bvh 1 # more\n\tspace scene\nnodes 1\nleaf -1e30 -0x1p3 -1e-60 0x1.9cp+6 "
      "+1e30 1E+2 0 2\n\ntriangles 2\n1\n\n0";
  const LoadedBvh loaded = load(text, two_);
  ASSERT_EQ(loaded.bvh.nodes.size(), 1U);
  EXPECT_THAT(loaded.bvh.order, ElementsAre(1U, 0U));
  const Aabb& root = loaded.bvh.nodes[0].box;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(root.min[axis], -1.0F);
    EXPECT_LT(root.max[axis], 1.0F);
  }
}

/// The file's second face has no area. It keeps its number, and a leaf may have it or not.
TEST_F(BvhFile, NumbersTrianglesAsTheMeshFileDoes) {
  const std::string mesh = changed("f 4 5 6", "f 1 1 2\nf 4 5 6", row_of(2));
  const Scene scene = scene_of(mesh);
  ASSERT_THAT(scene.mesh.dropped, ElementsAre(1U));
  const std::string with = changed("triangles 2\n0 1", "triangles 3\n0 1 2",
                                   changed("1 0.5 1 1\n", "1 0.5 2 1\n", changed("0 1\n", "0 2\n")));
  EXPECT_THAT(load(with, scene).bvh.order, ElementsAre(0U, 1U));
  const std::string without = changed("2\n0 1", "2\n0 2");
  EXPECT_THAT(load(without, scene).bvh.order, ElementsAre(0U, 1U));
  EXPECT_THAT(bvh_text(build_bvh(scene.mesh), scene.mesh), HasSubstr("triangles 2\n0 2\n"));
  EXPECT_THAT(refusal(two_triangles(), scene), HasSubstr("triangle 2 is in no leaf"));
}

/// A quad is two triangles in its place, whichever material or group comes between.
TEST_F(BvhFile, CountsAQuadAsTwoTriangles) {
  const Scene scene = scene_of(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 6 1 1\ng a\nf 1 2 3 4\n"
      "usemtl m\nf 5 6 7\ng c\nf 1 2 4\n");
  const std::string text =
      "hitpipe-bvh 1\nspace scene\nnodes 3\nbranch 0 0 0 6 1 1 1 2\nleaf 0 0 0 1 1 0 0 3\nleaf 5 0 0 6 1 1 3 "
      "1\ntriangles 4\n0 1 3 2\n";
  EXPECT_THAT(load(text, scene).bvh.order, ElementsAre(0U, 1U, 3U, 2U));
}

/// Readers of text may round a coordinate differently.
TEST_F(BvhFile, GrowsBoxesThatAreShortByARounding) {
  const std::string shorter = fmt::format("{:.9g}", std::nextafter(101.0F, 0.0F));
  const LoadedBvh loaded = load(changed("leaf 100 0 0 101", "leaf 100 0 0 " + shorter), two_);
  EXPECT_EQ(loaded.boxes_grown, 1U);
  EXPECT_TRUE(same_bits(loaded.bvh, load(two_triangles(), two_).bvh));
  EXPECT_EQ(refusal(changed("leaf 100 0 0 101", "leaf 100 0 0 100.999"), two_),
            "line 5: node 1 does not hold triangle 0: max.x of the triangle is 101, of the box 100.999");
}

/// One triangle, cut at x = 100.5 into two leaves whose boxes are bounds of its parts.
TEST_F(BvhFile, TakesSpatialSplitsIfTheLeavesTogetherHoldTheTriangle) {
  const Scene one = scene_of(row_of(1));
  const std::string text = "hitpipe-bvh 1\nspace scene\nnodes 3\nbranch " + box(0, 0) +
                           " 1 2\nleaf 100 0 0 100.5 1 0.5 0 1\nleaf 100.5 0 0 101 0.5 0.25 1 1\n"
                           "triangles 2\n0 0\n";
  const LoadedBvh loaded = load(text, one);
  EXPECT_THAT(loaded.bvh.order, ElementsAre(0U, 0U));
  EXPECT_EQ(loaded.bvh.nodes.size(), 3U);
  EXPECT_EQ(
      refusal(changed("101 0.5 0.25", "101 0.4 0.25", text), one),
      "line 5: node 1 does not hold triangle 0, and its other leaves do not hold the rest: max.x of the "
      "triangle is 101, of the box 100.5");
  EXPECT_THAT(refusal(changed("leaf 100.5", "leaf 100.6", text), one), HasSubstr("do not hold the rest"));
}

TEST_F(BvhFile, InTheCubeIsTakenAsItIs) {
  const std::string text =
      "hitpipe-bvh 1\nspace cube\nnodes 1\nleaf -1 -0.75 -1 1 1 1 0 2\ntriangles 2\n0 1\n";
  const Aabb box = load(text, two_, 1e-4F).bvh.nodes[0].box;
  EXPECT_EQ(box.min, glm::vec3(-1.0F, -0.75F, -1.0F));
  EXPECT_EQ(box.max, glm::vec3(1.0F));
  EXPECT_EQ(
      refusal(changed(" 1 1 1 0", " 1 1.25 1 0", text), two_),
      "line 4: node 0 reaches from -0.75 to 1.25 along y; boxes of space cube must lie within -1 and 1");
}

TEST_F(BvhFile, OfNoTreeIsRejected) {
  const auto nodes = [](const std::string& lines, int count) {
    return fmt::format("hitpipe-bvh 1\nspace scene\nnodes {}\n{}triangles 2\n0 1\n", count, lines);
  };
  const std::string all = box(0, 1);
  const std::string branch = "branch " + all;
  const std::string leaf = "leaf " + all;
  EXPECT_EQ(refusal(nodes(branch + " 0 1\n" + leaf + " 0 2\n", 2), two_),
            "line 4: node 0 has the root, node 0, as a child; that is a cycle");
  EXPECT_EQ(refusal(nodes(branch + " 1 1\n" + leaf + " 0 2\n", 2), two_),
            "line 5: node 1 is a child of node 0 and of node 0; it must be the child of one node");
  EXPECT_EQ(refusal(nodes(branch + " 1 2\n" + branch + " 2\n" + leaf + " 0 2\n", 3), two_),
            "line 6: node 2 is a child of node 0 and of node 1; it must be the child of one node");
  EXPECT_EQ(refusal(nodes(leaf + " 0 2\n" + leaf + " 0 0\n", 2), two_),
            "line 5: node 1 is the child of no node; only the root, node 0, may be");
  EXPECT_EQ(refusal(nodes(leaf + " 0 2\n" + branch + " 2\n" + branch + " 1\n", 3), two_),
            "line 5: node 1 is below itself; that is a cycle");
  EXPECT_EQ(refusal(nodes(leaf + " 0 1\n", 1), two_), "no leaf takes entry 1 of the list of triangles");
  EXPECT_EQ(
      refusal(nodes(branch + " 1 2\n" + leaf + " 0 1\n" + leaf + " 0 2\n", 3), two_),
      "line 6: node 2 takes entry 0 of the list of triangles, which another leaf takes; list a triangle "
      "twice if two leaves have it");
  EXPECT_EQ(refusal(nodes(leaf + " 1 2\n", 1), two_),
            "line 4: node 0 takes the entries 1 to 2 of the list of triangles, which has 2");
  EXPECT_EQ(refusal(changed("branch 100 0 0 103", "branch 100 0 0 102.5"), two_),
            "line 6: node 2 reaches out of its parent, node 0: max.x 103, of the parent 102.5");
  EXPECT_EQ(refusal(changed("\n0 1\n", "\n0 0\n", changed("leaf 102", "leaf 100")), two_),
            "triangle 1 is in no leaf");
  EXPECT_EQ(refusal(changed("\n0 1\n", "\n0 2\n"), two_),
            "line 6: node 2 has triangle 2; the scene's are 0 to 1");
  EXPECT_EQ(refusal(changed("\n0 1\n", "\n1 0\n"), two_),
            "line 6: node 2 does not hold triangle 0: min.x of the triangle is 100, of the box 102");
}

TEST_F(BvhFile, DeeperThanSixtyLevelsIsRejected) {
  // A comb: every branch has a leaf of its own and the next branch.
  const auto comb = [](int levels) {
    std::string text = fmt::format("hitpipe-bvh 1\nspace scene\nnodes {}\n", 2 * levels - 1);
    for (int i = 0; i + 1 < levels; ++i)
      text += fmt::format("branch {} {} {}\nleaf {} {} 1\n", box(i, levels - 1), 2 * i + 1, 2 * i + 2,
                          box(i, i), i);
    text += fmt::format("leaf {} {} 1\ntriangles {}\n", box(levels - 1, levels - 1), levels - 1, levels);
    for (int i = 0; i < levels; ++i) text += fmt::format("{}\n", i);
    return text;
  };
  EXPECT_EQ(load(comb(60), scene_of(row_of(60))).bvh.depth, 60);
  EXPECT_EQ(
      refusal(comb(61), scene_of(row_of(61))),
      "line 123: node 119 is on level 61, where branches have two children; at most 60 levels are allowed");
}

struct BadText {
  std::string from, to, message;
};

TEST_F(BvhFile, OfWrongWordsIsRejectedWithItsLine) {
  const std::string coordinate = "node 1: expected a coordinate, found ";
  const std::vector<BadText> all{
      {"hitpipe-bvh 1", "hitpipe-bvh 2",
       "line 1: the first line must be \"hitpipe-bvh 1\"; no other version is known"},
      {"hitpipe-bvh 1", "v 1 2 3", "line 1: the first line must be \"hitpipe-bvh 1\""},
      {two_triangles(), "", "line 1: the first line must be \"hitpipe-bvh 1\""},
      {"space scene", "space world", "line 2: expected \"space scene\" or \"space cube\""},
      {"space scene", "space scene 1", "line 2: expected the end of the line, found \"1\""},
      {"nodes 3", "nodes 0", "line 3: nodes 0; at least 1 is needed"},
      {"nodes 3", "nodes",
       "line 3: nodes: expected a whole number from 0 to 2147483647, found the end of the line"},
      {"nodes 3", "nodes -3", "line 3: nodes: expected a whole number from 0 to 2147483647, found \"-3\""},
      {"nodes 3", "nodes 4", "line 7: node 3: \"triangles\" is neither branch nor leaf"},
      {"nodes 3", "nodes 2", "line 4: node 0: there is no node 2; the nodes are 0 to 1"},
      {"leaf", "loaf", "line 5: node 1: \"loaf\" is neither branch nor leaf"},
      {"leaf 100 0", "leaf 100 x", "line 5: " + coordinate + "\"x\""},
      {"leaf 100 0", "leaf 100 0x", "line 5: " + coordinate + "\"0x\""},
      {"leaf 100 0", "leaf 100 --1", "line 5: " + coordinate + "\"--1\""},
      {"leaf 100 0 0 101 1 0.5 0 1", "leaf 100 0 0", "line 5: " + coordinate + "the end of the line"},
      {"leaf 100", "leaf nan", "line 5: node 1: nan to 101 along x; coordinates must be finite"},
      {"101", "1e39", "line 5: node 1: 100 to inf along x; coordinates must be finite"},
      {"leaf 100", "leaf 102", "line 5: node 1: the box is inverted: min.x 102 is above max.x 101"},
      {"0.5 0 1\n", "0.5 0 -1\n",
       "line 5: number of triangles: expected a whole number from 0 to 2147483647, found \"-1\""},
      {"0.5 0 1\n", "0.5 0 1 1\n", "line 5: expected the end of the line, found \"1\""},
      {" 1 2\n", "\n", "line 4: node 0: a branch needs a child"},
      {" 1 2\n", " 1 3\n", "line 4: node 0: there is no node 3; the nodes are 0 to 2"},
      {" 1 2\n", " 1 2 split w\n", "line 4: node 0: split \"w\" is none of x, y, z"},
      {" 1 2\n", " 1 split x\n", "line 4: node 0: split is for a branch of two children; this one has 1"},
      {"triangles 2\n0 1\n", "triangles 3\n0 1\n", "line 8: the file ends after 2 of 3 triangles"},
      {"triangles 2\n0 1\n", "triangles 1\n0 1\n", "line 8: more than the 1 triangles that were announced"},
      {"triangles 2\n0 1\n", "", "line 6: expected \"triangles\" and their number"},
      {"triangles 2\n", "", "line 7: expected \"triangles\" and their number"},
      {"leaf 102 0 0 103 1 0.5 1 1\ntriangles 2\n0 1\n", "", "line 5: the file ends after 2 of 3 nodes"},
      {"hitpipe-bvh", std::string(300, 'h'), "line 1: a word of more than 256 characters"},
      {"leaf", std::string(150, '\x01'),
       "line 5: node 1: \"" + std::string(50, '?') + "... (150 bytes)\" is neither branch nor leaf"}};
  for (const BadText& bad : all) EXPECT_EQ(refusal(changed(bad.from, bad.to), two_), bad.message) << bad.to;
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)load_bvh("none.bvh", two_); }),
            "BVH file \"none.bvh\": no such file");
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)load_bvh("/", two_); }),
            "BVH file \"/\": cannot be read: Is a directory");
}

/// The reader keeps a piece of the file at a time; words and lines go over its ends.
TEST_F(BvhFile, MayBeLongerThanThePiecesInWhichItIsRead) {
  std::string text = changed("\n0 1\n", "\n" + std::string(300'001, ' ') + "0 # " +
                                            std::string(200'003, 'x') + "\n1" + std::string(150'000, '\n'));
  text = changed("triangles 2\n", std::string(65'530 - text.find("triangles"), ' ') + "triangles 2\n", text);
  EXPECT_TRUE(same_bits(load(text, two_).bvh, load(two_triangles(), two_).bvh));
}

}  // namespace
}  // namespace hitpipe::ref::bvh_file_test
