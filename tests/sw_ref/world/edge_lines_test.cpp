// Lines at edges and corners of many small polyhedra.
#include "sw_ref/world/edge_lines.hpp"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "rays/tree/bvh.hpp"
#include "tests/rays/world/tetrahedra.hpp"

namespace hitpipe::ref::edge_lines_test {
namespace {

using tetrahedra::mesh_of;
using tetrahedra::Solid;
using world_cases::Draw;

EdgeLines lines_through(const IntMesh& mesh, const hls::WorldBits& bits, std::uint64_t lines,
                        std::uint64_t seed, int threads = 1) {
  const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 2, .padding = 0.0F});
  const MeshCrossings crossings(mesh, &bvh, {.world = bits});
  return cross_edge_lines(mesh, crossings, bits, {.lines = lines, .seed = seed, .threads = threads});
}

/// HITPIPE_EDGE_SOLIDS: how many polyhedra.
int solids() {
  const char* const text = std::getenv("HITPIPE_EDGE_SOLIDS");
  return text != nullptr ? std::atoi(text) : 2'000;
}

TEST(EdgeLines, CrossClosedMeshesEvenly) {
  Draw draw(39211);
  constexpr std::uint64_t lines = 64;
  EdgeLines sum;
  for (int i = 0; i < solids(); ++i) {
    const Solid solid = tetrahedra::draw_solid(draw, 12);
    const bool oriented = i % 2 == 0;
    const IntMesh mesh =
        mesh_of(oriented ? tetrahedra::oriented_boundary(solid) : tetrahedra::boundary(solid), solid.bits);
    if (mesh.triangles.empty()) continue;
    ASSERT_TRUE(closedness(mesh).even()) << "solid " << i;
    const EdgeLines found = lines_through(mesh, solid.bits, lines, static_cast<std::uint64_t>(i));
    ASSERT_EQ(found.lines, lines);
    ASSERT_EQ(found.odd, 0U) << "solid " << i;
    if (oriented) {
      ASSERT_EQ(found.unbalanced, 0U) << "solid " << i;
    }
    sum += found;
  }
  EXPECT_GT(sum.lines, lines * static_cast<std::uint64_t>(solids()) / 2);
  EXPECT_GT(sum.tied_rays, sum.lines / 2);
  EXPECT_GT(sum.from_inside, sum.lines / 50);
}

/// Closedness says exactly which meshes have a line with an odd count: triangles are taken away, and edges are cut on
/// one side only.
TEST(EdgeLines, AreOddJustWhereAMeshIsOpen) {
  Draw draw(39212);
  int open = 0, even_with_junctions = 0;
  for (int i = 0; i < 400; ++i) {
    Solid solid = tetrahedra::draw_solid(draw, 4);
    auto faces = tetrahedra::boundary(solid);
    if (faces.empty()) continue;
    for (std::int64_t cuts = draw.integer(0, 4); cuts > 0; --cuts) {
      IntTriangle& cut =
          faces[static_cast<std::size_t>(draw.integer(0, static_cast<std::int64_t>(faces.size()) - 1))];
      IntTriangle::Corner middle{};
      bool exact = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int32_t twice = cut.corners[0][axis] + cut.corners[1][axis];
        exact = exact && twice % 2 == 0;
        middle[axis] = twice / 2;
      }
      if (!exact && draw.one_in(2)) continue;
      const IntTriangle other{{middle, cut.corners[1], cut.corners[2]}};
      cut.corners[1] = middle;
      faces.push_back(other);
    }
    if (draw.one_in(4)) faces.pop_back();
    const IntMesh mesh = mesh_of(faces, solid.bits);
    if (mesh.triangles.empty()) continue;
    const Closedness closed = closedness(mesh);
    const EdgeLines found = lines_through(mesh, solid.bits, 4096, static_cast<std::uint64_t>(i));
    ASSERT_EQ(found.odd == 0, closed.even()) << "mesh " << i << " of " << mesh.triangles.size();
    open += closed.even() ? 0 : 1;
    even_with_junctions += closed.even() && !closed.closed() ? 1 : 0;
  }
  EXPECT_GT(open, 40);
  EXPECT_GT(even_with_junctions, 40);
}

TEST(EdgeLines, DoNotDependOnThreads) {
  Draw draw(39213);
  const Solid solid = tetrahedra::draw_solid(draw, 12);
  const IntMesh mesh = mesh_of(tetrahedra::boundary(solid), solid.bits);
  ASSERT_FALSE(mesh.triangles.empty());
  const EdgeLines one = lines_through(mesh, solid.bits, 5000, 7, 1);
  const EdgeLines four = lines_through(mesh, solid.bits, 5000, 7, 4);
  EXPECT_EQ(one.lines, 5000U);
  EXPECT_EQ(one.crossings, four.crossings);
  EXPECT_EQ(one.ties, four.ties);
  EXPECT_EQ(one.from_inside, four.from_inside);
  EXPECT_NE(one.ties, lines_through(mesh, solid.bits, 5000, 8).ties);
}

TEST(EdgeRays, AreTheSameInAnyRangeAndAreRaysOfBinary32) {
  Draw draw(39214);
  int meshes = 0;
  while (meshes < 40) {
    const Solid solid = tetrahedra::draw_solid(draw, 12);
    const IntMesh mesh = mesh_of(tetrahedra::boundary(solid), solid.bits);
    if (mesh.triangles.empty()) continue;
    ++meshes;
    const std::vector<IntRay> rays = edge_rays(mesh, solid.bits, 5, 0, 3000);
    ASSERT_EQ(rays.size(), 3000U);
    EXPECT_EQ(edge_rays(mesh, solid.bits, 5, 2047, 2050),
              std::vector<IntRay>(rays.begin() + 2047, rays.begin() + 2050));
    // A slope of more bits is rounded.
    if (solid.bits.slope > 23) continue;
    for (const IntRay& ray : rays) ASSERT_EQ(int_ray(binary32_ray(ray, solid.bits), solid.bits), ray);
  }
}

}  // namespace
}  // namespace hitpipe::ref::edge_lines_test
