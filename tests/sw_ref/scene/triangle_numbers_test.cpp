#include "sw_ref/scene/triangle_numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::ref::triangle_numbers_test {
namespace {

using testing::ElementsAre;

/// Triangles 1, 4 and 5 have no area.
Mesh six_triangles() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}, {1, 2, 3}, {2, 2, 2}, {3, 1, 3}};
  mesh.materials = {0, 1, 2, 3, 4, 5};
  return mesh;
}

TEST(TriangleNumbers, AreThoseOfTheSourceAfterTrianglesAreDroppedTwice) {
  Mesh mesh = six_triangles();
  drop_degenerate(mesh);
  EXPECT_THAT(mesh.dropped, ElementsAre(1U, 4U, 5U));
  EXPECT_THAT(mesh.materials, ElementsAre(0, 2, 3));
  mesh.vertices[3] = mesh.vertices[0];  // triangle 2 loses its area, 3 does not
  drop_degenerate(mesh);
  EXPECT_THAT(mesh.dropped, ElementsAre(1U, 2U, 4U, 5U));
  EXPECT_THAT(mesh.materials, ElementsAre(0, 3));
  const TriangleNumbers numbers(mesh);
  EXPECT_EQ(numbers.in_source(), 6U);
  EXPECT_EQ(numbers.in_mesh(0), 0U);
  EXPECT_EQ(numbers.in_mesh(3), 1U);
  for (const std::uint32_t gone : {1U, 2U, 4U, 5U}) EXPECT_EQ(numbers.in_mesh(gone), TriangleNumbers::none);
  EXPECT_EQ(numbers.of_source(0), 0U);
  EXPECT_EQ(numbers.of_source(1), 3U);
}

TEST(TriangleNumbers, AreKeptWhereNothingIsDropped) {
  Mesh mesh = six_triangles();
  mesh.triangles.resize(1);
  mesh.materials.clear();
  drop_degenerate(mesh);
  EXPECT_TRUE(mesh.dropped.empty());
  EXPECT_EQ(TriangleNumbers(mesh).of_source(0), 0U);
  EXPECT_EQ(TriangleNumbers(mesh).in_source(), 1U);
}

}  // namespace
}  // namespace hitpipe::ref::triangle_numbers_test
