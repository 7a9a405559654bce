#include "rays/scene/triangle_numbers.hpp"

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
  drop(mesh, flat_triangles(mesh));
  EXPECT_THAT(mesh.dropped, ElementsAre(1U, 4U, 5U));
  EXPECT_THAT(mesh.materials, ElementsAre(0, 2, 3));
  mesh.vertices[3] = mesh.vertices[0];  // triangle 2 loses its area, 3 does not
  drop(mesh, flat_triangles(mesh));
  EXPECT_THAT(mesh.dropped, ElementsAre(1U, 2U, 4U, 5U));
  EXPECT_THAT(mesh.materials, ElementsAre(0, 3));
  const TriangleNumbers numbers(mesh);
  EXPECT_EQ(numbers.in_source(), 6U);
  EXPECT_EQ(numbers.in_mesh(0), 0U);
  EXPECT_EQ(numbers.in_mesh(3), 1U);
  for (const std::uint32_t gone : {1U, 2U, 4U, 5U}) EXPECT_EQ(numbers.in_mesh(gone), TriangleNumbers::none);
  for (const std::uint32_t beyond : {6U, 7U, ~0U}) EXPECT_EQ(numbers.in_mesh(beyond), TriangleNumbers::none);
  EXPECT_EQ(numbers.of_source(0), 0U);
  EXPECT_EQ(numbers.of_source(1), 3U);
}

TEST(TriangleNumbers, AreKeptWhereNothingIsDropped) {
  Mesh mesh = six_triangles();
  mesh.triangles.resize(1);
  mesh.materials.clear();
  drop(mesh, flat_triangles(mesh));
  EXPECT_TRUE(mesh.dropped.empty());
  EXPECT_EQ(TriangleNumbers(mesh).of_source(0), 0U);
  EXPECT_EQ(TriangleNumbers(mesh).in_source(), 1U);
}

TEST(TriangleNumbers, OfAFaceFollowEachOther) {
  Mesh mesh = six_triangles();
  // Face 0 has two triangles, face 1 has one, face 2 is a line, face 3 has three.
  mesh.faces = {0, 2, 3, 3};
  drop(mesh, flat_triangles(mesh));
  const TriangleNumbers numbers(mesh);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t number = 0; number < numbers.in_source(); ++number)
    faces.push_back(numbers.face_of(number));
  EXPECT_THAT(faces, ElementsAre(0U, 0U, 1U, 3U, 3U, 3U));
  std::vector<std::uint32_t> first;
  for (std::size_t face = 0; face <= 4; ++face) first.push_back(numbers.first_of(face));
  EXPECT_THAT(first, ElementsAre(0U, 2U, 3U, 3U, 6U));
  std::vector<std::uint32_t> below;
  for (std::uint32_t number = 0; number <= 6; ++number) below.push_back(numbers.kept_below(number));
  EXPECT_THAT(below, ElementsAre(0U, 1U, 1U, 2U, 3U, 3U, 3U));
}

}  // namespace
}  // namespace hitpipe::ref::triangle_numbers_test
