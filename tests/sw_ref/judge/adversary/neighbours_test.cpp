// Neighbours of a box: one face is moved, by ulps or a distance, and the referee accepts every box.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::ref::adversary::neighbours_test {
namespace {

constexpr std::uint64_t seed = 20073;
constexpr std::size_t boxes = 16;

std::string to_text(const Aabb& box) {
  return adversary::to_text(Case{{}, box});
}

/// Steps of binary32 from a to b, both zeros counted as one; -1: more than 4.
int ulps_between(float a, float b) {
  for (int steps = 0; steps <= 4; ++steps) {
    if (a == b) return steps;
    a = std::nextafter(a, b);
  }
  return -1;
}

/// Whether a moved face lies in a permitted place: up to 4 ulps or a power of two away, or at the end of the
/// cube.
bool is_a_move(float from, float to) {
  if (ulps_between(from, to) >= 0) return true;
  for (int exponent = -30; exponent <= -3; ++exponent) {
    for (const float distance : {std::ldexp(1.0F, exponent), -std::ldexp(1.0F, exponent)}) {
      if (to == std::clamp(from + distance, -1.0F, 1.0F)) return true;
    }
  }
  return false;
}

TEST(Neighbours, AreAcceptableAndDifferInOneFaceOrTheOneItTakesAlong) {
  Random random(seed);
  std::array<Aabb, boxes> made;
  for (const Category& category : categories()) {
    for (int i = 0; i < 1'000; ++i) {
      const Aabb box = category.make(random).box;
      neighbours(random, box, made);
      EXPECT_EQ(made[0].min, box.min);
      EXPECT_EQ(made[0].max, box.max);
      for (const Aabb& other : made) {
        ASSERT_TRUE(acceptable(other)) << to_text(box) << " gave " << to_text(other);
        for (int axis = 0; axis < 3; ++axis) {
          const float low = other.min[axis];
          const float high = other.max[axis];
          const bool low_moved = low != box.min[axis];
          const bool high_moved = high != box.max[axis];
          const bool right =
              low_moved && high_moved
                  ? low == high && (is_a_move(box.min[axis], low) || is_a_move(box.max[axis], high))
                  : is_a_move(box.min[axis], low) && is_a_move(box.max[axis], high);
          ASSERT_TRUE(right) << to_text(box) << " gave " << to_text(other);
        }
      }
    }
  }
}

/// Every face both ways, by 1 to 4 ulps and by every power of two from 2^-30 to 2^-3.
TEST(Neighbours, MoveEveryFaceByEverySize) {
  Random random(seed + 1);
  const Aabb box{{-0.25F, -0.25F, -0.25F}, {0.25F, 0.25F, 0.25F}};
  std::array<Aabb, boxes> made;
  std::set<std::pair<unsigned, float>> moves;
  for (int i = 0; i < 20'000; ++i) {
    neighbours(random, box, made);
    for (const Aabb& other : made) {
      for (unsigned face = 0; face < 6; ++face) {
        const float moved = other.plane(face) - box.plane(face);  // exact, the two are close
        if (moved != 0) moves.emplace(face, moved);
      }
    }
  }
  // 4 numbers of ulps and 28 powers of two, both ways. 2^-26 is one ulp of 1/4 inwards, 2^-25 one outwards:
  // these and their doubles coincide, and a move below half an ulp changes nothing.
  for (unsigned face = 0; face < 6; ++face) {
    for (const float way : {1.0F, -1.0F}) {
      for (int exponent = -25; exponent <= -3; ++exponent) {
        EXPECT_TRUE(moves.contains({face, way * std::ldexp(1.0F, exponent)})) << face << " " << exponent;
      }
      float ulps = box.plane(face);
      for (int steps = 1; steps <= 4; ++steps) {
        ulps = std::nextafter(ulps, way * 2.0F);
        EXPECT_TRUE(moves.contains({face, ulps - box.plane(face)})) << face << " " << steps;
      }
    }
  }
}

TEST(Neighbours, OfZeroAreSubnormalOnBothSides) {
  Random random(seed + 2);
  const Aabb box{{-0.0F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}};
  std::array<Aabb, boxes> made;
  std::set<float> lows;
  for (int i = 0; i < 10'000; ++i) {
    neighbours(random, box, made);
    for (const Aabb& other : made) lows.insert(other.min.x);
  }
  constexpr float least = std::numeric_limits<float>::denorm_min();
  for (int steps = 1; steps <= 4; ++steps) {
    EXPECT_TRUE(lows.contains(static_cast<float>(steps) * least)) << steps;
    EXPECT_TRUE(lows.contains(static_cast<float>(-steps) * least)) << steps;
  }
}

TEST(Neighbours, FillAnyNumberOfBoxesFromTheSameDraws) {
  const Aabb box{{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}};
  Random whole(seed);
  std::array<Aabb, boxes> all;
  neighbours(whole, box, all);
  for (std::size_t count = 0; count < boxes; ++count) {
    Random random(seed);
    std::vector<Aabb> some(count);
    neighbours(random, box, some);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(to_text(some[i]), to_text(all[i])) << count;
  }
}

}  // namespace
}  // namespace hitpipe::ref::adversary::neighbours_test
