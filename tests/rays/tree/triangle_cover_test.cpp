#include "rays/tree/triangle_cover.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::ref::triangle_cover_test {
namespace {

const Mesh::Corners slanted{{0, 0, 0}, {1, 0, 0.25F}, {0, 1, 0.5F}};

Aabb part(float min_x, float min_y, float max_x, float max_y) {
  return {{min_x, min_y, 0}, {max_x, max_y, 1}};
}

TEST(TriangleCover, IsByOneBoxOrByPartsThatMeet) {
  EXPECT_TRUE(cover(std::vector{part(0, 0, 1, 1)}, slanted, -cover_error + 1e-9));
  EXPECT_TRUE(cover(std::vector{part(0, 0, 0.5F, 1), part(0.5F, 0, 1, 0.5F)}, slanted, 1e-9));
  EXPECT_FALSE(cover(std::vector{part(0, 0, 0.5F, 1), part(0.5F, 0, 1, 0.4F)}, slanted, 1e-9));
  EXPECT_FALSE(cover(std::vector{part(0, 0, 0.5F, 1), part(0.51F, 0, 1, 0.5F)}, slanted, 1e-9));
  EXPECT_TRUE(cover(std::vector{part(0, 0, 0.5F, 1), part(0.51F, 0, 1, 0.5F)}, slanted, 0.005F));
  EXPECT_FALSE(cover(std::vector{part(2, 2, 3, 3)}, slanted, 1e-9));
  EXPECT_FALSE(cover({}, slanted, 1e-9));
}

/// A chessboard of boxes covers it; without any box that it goes through, it does not.
TEST(TriangleCover, NeedsEveryBoxThatTheTriangleGoesThrough) {
  constexpr int side = 8;
  std::vector<Aabb> boxes;
  for (int i = 0; i < side; ++i)
    for (int j = 0; i + j < side; ++j) {
      const float x = static_cast<float>(i) / side;
      const float y = static_cast<float>(j) / side;
      boxes.push_back(part(x, y, x + 1.0F / side, y + 1.0F / side));
    }
  EXPECT_TRUE(cover(boxes, slanted, 1e-9));
  for (std::size_t left_out = 0; left_out < boxes.size(); ++left_out) {
    std::vector<Aabb> others = boxes;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    EXPECT_FALSE(cover(others, slanted, 1e-9)) << left_out;
  }
}

/// A floor in many leaves takes no more than its share of time.
TEST(TriangleCover, OfManyBoxesEnds) {
  constexpr int side = 200;
  std::vector<Aabb> boxes;
  for (int i = 0; i < side; ++i)
    for (int j = 0; i + j < side; ++j)
      boxes.push_back(part(static_cast<float>(i) / side, static_cast<float>(j) / side,
                           static_cast<float>(i + 1) / side, static_cast<float>(j + 1) / side));
  EXPECT_TRUE(cover(boxes, slanted, 1e-7));
}

}  // namespace
}  // namespace hitpipe::ref::triangle_cover_test
