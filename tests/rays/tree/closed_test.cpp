// Closed meshes and open ones, by positions.
#include "rays/tree/closed.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "rays/files/mesh_file.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/world/int_mesh.hpp"
#include "tests/rays/world/tetrahedra.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::ref::closed_test {
namespace {

using Triangle = std::array<glm::vec3, 3>;

/// As an STL file has it: no index is shared.
Mesh soup(const std::vector<Triangle>& triangles) {
  Mesh mesh;
  for (const Triangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

constexpr glm::vec3 a{0, 0, 0}, b{0.5F, 0.5F, 0}, c{0, 0.5F, 0}, d{0, 0, 0.5F};
/// On the edge from a to b.
constexpr glm::vec3 e{0.125F, 0.125F, 0};

const std::vector<Triangle> tetrahedron{{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
/// Two of its triangles are one, which e lies on.
const std::vector<Triangle> with_t_junction{{a, c, b}, {a, e, d}, {e, b, d}, {b, c, d}, {c, a, d}};

TEST(Closed, ATetrahedronIsAndIsOriented) {
  const Closedness found = closedness(soup(tetrahedron));
  EXPECT_TRUE(found.closed());
  EXPECT_TRUE(found.oriented());
  EXPECT_TRUE(found.even());
  EXPECT_TRUE(found.balanced());
  EXPECT_EQ(found.edges, 6U);
  EXPECT_EQ(found.crowded, 0U);
  EXPECT_TRUE(found.first_odd.empty());
}

TEST(Closed, MinusZeroIsZero) {
  auto mesh = tetrahedron;
  mesh[1][0] = {-0.0F, 0.0F, -0.0F};
  EXPECT_TRUE(closedness(soup(mesh)).closed());
  mesh[1][0] = {1e-45F, 0.0F, 0.0F};
  EXPECT_FALSE(closedness(soup(mesh)).closed());
}

TEST(Closed, AMissingTriangleLeavesItsEdges) {
  const Closedness found = closedness(soup({tetrahedron[0], tetrahedron[1], tetrahedron[2]}));
  EXPECT_EQ(found.odd, 3U);
  EXPECT_EQ(found.open, 3U);
  EXPECT_EQ(found.turned, 3U);
  EXPECT_EQ(found.t_junctions, 0U);
  ASSERT_EQ(found.first_odd.size(), 3U);
  EXPECT_EQ(found.first_odd[0].triangle, 0U);
  EXPECT_EQ(found.first_odd[0].from, a);
  EXPECT_EQ(found.first_odd[0].to, c);
  EXPECT_EQ(found.first_odd[1].triangle, 1U);
  EXPECT_EQ(found.first_odd[2].triangle, 2U);
}

TEST(Closed, ATurnedTriangleIsClosedButNotOriented) {
  auto mesh = tetrahedron;
  std::swap(mesh[2][0], mesh[2][1]);
  const Closedness found = closedness(soup(mesh));
  EXPECT_TRUE(found.closed());
  EXPECT_FALSE(found.oriented());
  EXPECT_EQ(found.turned, 3U);
  EXPECT_EQ(found.open_turned, 3U);
}

TEST(Closed, EqualAndOppositeTrianglesAreCounted) {
  auto mesh = tetrahedron;
  mesh.push_back({a, b, d});
  EXPECT_EQ(closedness(soup(mesh)).odd, 3U);
  EXPECT_EQ(closedness(soup(mesh)).crowded, 3U);
  mesh.push_back({a, d, b});
  const Closedness opposite = closedness(soup(mesh));
  EXPECT_TRUE(opposite.closed());
  EXPECT_TRUE(opposite.oriented());
  EXPECT_EQ(opposite.crowded, 3U);
}

/// It is even where the corner lies, but not closed.
TEST(Closed, ATJunctionIsFound) {
  const Closedness found = closedness(soup(with_t_junction));
  EXPECT_FALSE(found.closed());
  EXPECT_EQ(found.odd, 3U);
  EXPECT_EQ(found.t_junctions, 1U);
  ASSERT_EQ(found.first_junctions.size(), 1U);
  EXPECT_EQ(found.first_junctions[0].corner, e);
  EXPECT_EQ(found.first_junctions[0].triangle, 0U);
  EXPECT_TRUE(found.even());
  EXPECT_TRUE(found.balanced());
  auto beside = with_t_junction;
  beside[1][1] = beside[2][0] = {0.125F, 0.125F + 0x1p-26F, 0};
  EXPECT_EQ(closedness(soup(beside)).t_junctions, 0U);
  EXPECT_FALSE(closedness(soup(beside)).even());
}

/// A triangle of three corners on a line closes a T-junction, though no ray hits it. One with two equal corners
/// changes nothing.
TEST(Closed, TrianglesWithoutAreaTakePart) {
  Mesh mesh = soup({{a, a, d},
                    {a, b, e},
                    with_t_junction[0],
                    with_t_junction[1],
                    with_t_junction[2],
                    with_t_junction[3],
                    with_t_junction[4],
                    {d, d, d}});
  const auto closed = [&] { return closedness(mesh).closed() && closedness(mesh).oriented(); };
  EXPECT_TRUE(closed());
  drop(mesh, flat_triangles(mesh));
  EXPECT_EQ(mesh.dropped, (std::vector<std::uint32_t>{0, 1, 7}));
  EXPECT_TRUE(closed());
  drop(mesh, std::vector<std::uint32_t>{0});
  EXPECT_EQ(mesh.dropped, (std::vector<std::uint32_t>{0, 1, 2, 7}));
  EXPECT_TRUE(closed());
  mesh.dropped_corners.erase(mesh.dropped_corners.begin() + 1);
  mesh.dropped.erase(mesh.dropped.begin() + 1);
  EXPECT_FALSE(closed());
}

/// Numbers are those of the file.
TEST(Closed, AFileKeepsCornersThatItsTrianglesWithoutAreaHave) {
  const sim::TemporaryFolder folder;
  const auto file = folder.write("t.obj",
                                 "v 0 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 4\nv 1 1 0\n"
                                 "f 1 1 2\nf 1 2 5\nf 1 3 2\nf 1 5 4\nf 5 2 4\nf 2 3 4\nf 3 1 4\n");
  SourceMesh source = load_mesh(file);
  EXPECT_EQ(source.dropped_corners.size(), 2U);
  Losses lost;
  Mesh mesh = normalise(source, {{2, 2, 2}, 0.25}, lost);
  EXPECT_TRUE(closedness(mesh).oriented());
  mesh.triangles.pop_back();
  ASSERT_FALSE(closedness(mesh).first_odd.empty());
  EXPECT_EQ(closedness(mesh).first_odd[0].triangle, 2U);
}

/// Rounding makes corners equal and moves them. What loses its area there leaves no gap behind.
TEST(Closed, StaysSoOnEveryGrid) {
  world_cases::Draw draw(39201);
  std::uint32_t lost = 0;
  for (int i = 0; i < 2'000; ++i) {
    const tetrahedra::Solid solid = tetrahedra::draw_solid(draw, 8);
    const bool oriented = i % 2 == 0;
    const IntMesh fine = tetrahedra::mesh_of(
        oriented ? tetrahedra::oriented_boundary(solid) : tetrahedra::boundary(solid), solid.bits);
    // Flat triangles of the fine grid may have an area on a coarse one: they must not be left out.
    if (fine.lost.triangles > 0) continue;
    for (const int bits : {4, 5, 6, 8, 24}) {
      const IntMesh coarse = int_mesh(fine.mesh, bits);
      lost += coarse.lost.triangles;
      ASSERT_TRUE(closedness(coarse.mesh).closed()) << i << " at " << bits;
      ASSERT_TRUE(closedness(coarse).even()) << i << " at " << bits;
      if (oriented) {
        ASSERT_TRUE(closedness(coarse.mesh).oriented()) << i << " at " << bits;
        ASSERT_TRUE(closedness(coarse).balanced()) << i << " at " << bits;
      }
    }
  }
  EXPECT_GT(lost, 1'000U);
}

/// Not so where a triangle that has no area is left out before corners are rounded, and would have one then.
TEST(Closed, ATriangleThatIsDroppedTooEarlyLeavesASlit) {
  Mesh mesh = soup(with_t_junction);
  mesh.vertices.insert(mesh.vertices.end(), {a, b, e});
  mesh.triangles.emplace_back(15, 16, 17);
  for (glm::vec3& corner : mesh.vertices) corner += glm::vec3(0.25F, 0.0F, 0.0F);
  EXPECT_TRUE(closedness(mesh).closed());
  EXPECT_TRUE(closedness(int_mesh(mesh, 6)).even());
  drop(mesh, flat_triangles(mesh));
  EXPECT_TRUE(closedness(mesh).closed());
  EXPECT_FALSE(closedness(int_mesh(mesh, 6)).even());
}

TEST(Closed, AnEmptyMeshIs) {
  EXPECT_TRUE(closedness(Mesh{}).oriented());
  EXPECT_TRUE(closedness(int_mesh(Mesh{}, 20)).balanced());
}

}  // namespace
}  // namespace hitpipe::ref::closed_test
