// EBND of section 6.3.2 by brute force: the least side relation that a ray can have with an edge when it
// passes on the inner side. It covers all planes and rounded directions of a small n, for every number of
// dropped bits. Two axes are enough. A third axis, along which the direction is largest, only says that a
// box's point is reached at s <= 1.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "hls/pipelines/int_plucker.hpp"

namespace hitpipe::hls::edge_bound_test {
namespace {

/// An edge of the silhouette: the direction's integers and the two planes that meet in it, from the origin.
struct Edge {
  int di, dj, plane_i, plane_j;

  [[nodiscard]] int side(int dropped) const { return (dj * plane_i >> dropped) - (di * plane_j >> dropped); }
};

/// Values of s that satisfy all s * slope <= limit, within [0, 1]; as fractions, everything an integer.
class Parameters {
 public:
  Parameters& cut(int slope, int limit) {
    if (slope == 0) {
      empty_ = empty_ || limit < 0;
    } else if (slope > 0) {
      if (limit * to_down_ < to_up_ * slope) {
        to_up_ = limit;
        to_down_ = slope;
      }
    } else if (-limit * from_down_ > from_up_ * -slope) {
      from_up_ = -limit;
      from_down_ = -slope;
    }
    return *this;
  }
  [[nodiscard]] bool any() const { return !empty_ && from_up_ * to_down_ <= to_up_ * from_down_; }

 private:
  int from_up_ = 0, from_down_ = 1;
  int to_up_ = 1, to_down_ = 1;
  bool empty_ = false;
};

/// True if some direction e, within 1/2 of the rounded one and M of zero, takes a ray from the origin to the
/// inner side of both planes. That is x_i = s e_i below plane_i if dj >= 0, above it if not; x_j the other
/// way round.
bool passes_inside(const Edge& edge, int limit) {
  const auto least = [&](int d) { return std::max(2 * d - 1, -2 * limit); };  // twice e
  const auto most = [&](int d) { return std::min(2 * d + 1, 2 * limit); };
  Parameters s;
  if (edge.dj >= 0) {
    s.cut(least(edge.di), 2 * edge.plane_i);
  } else {
    s.cut(-most(edge.di), -2 * edge.plane_i);
  }
  if (edge.di >= 0) {
    s.cut(-most(edge.dj), -2 * edge.plane_j);
  } else {
    s.cut(least(edge.dj), 2 * edge.plane_j);
  }
  return s.any();
}

struct Least {
  int side = 0;
  Edge edge{};
};

struct Search {
  std::vector<Least> least;  // by dropped bits
  long long edges = 0;       ///< edges with a ray that passes inside
};

Search search(int n) {
  const int limit = (1 << (n - 1)) - 1;
  Search found;
  found.least.resize(static_cast<std::size_t>(2 * n - 1));
  for (int di = -limit; di <= limit; ++di) {
    for (int dj = -limit; dj <= limit; ++dj) {
      for (int i = -limit; i <= limit; ++i) {
        for (int j = -limit; j <= limit; ++j) {
          const Edge edge{di, dj, i, j};
          if (!passes_inside(edge, limit)) continue;
          ++found.edges;
          for (int dropped = 0; Least & least : found.least) {
            const int side = edge.side(dropped++);
            if (side < least.side) least = {side, edge};
          }
        }
      }
    }
  }
  return found;
}

/// -ceil((M - 1) / 2^k), M = 2^(n-1) - 1.
int proven_bound(int n, int dropped) {
  const int most = (1 << (n - 1)) - 2;
  const int unit = 1 << dropped;
  return -((most + unit - 1) / unit);
}

class EdgeBound : public testing::TestWithParam<int> {};

TEST_P(EdgeBound, IsTheAttainedMinimumForEveryNumberOfDroppedBits) {
  const int n = GetParam();
  const Search found = search(n);
  std::printf("n = %d: %lld edges passed inside\n", n, found.edges);
  EXPECT_GT(found.edges, 10'000);
  // One bit is not a format: t = 1 keeps only the sign.
  for (int dropped = 0; dropped <= 2 * n - 3; ++dropped) {
    const int attained = found.least[static_cast<std::size_t>(dropped)].side;
    EXPECT_EQ(attained, proven_bound(n, dropped)) << "k = " << dropped;
    EXPECT_EQ(int_plucker::edge_bound({n, 2 * n - 1 - dropped}), attained) << "k = " << dropped;
  }
}

INSTANTIATE_TEST_SUITE_P(Coordinates, EdgeBound, testing::Values(4, 5, 6),
                         [](const auto& n) { return fmt::format("n{}", n.param); });

TEST(EdgeBoundOfTheThesis, IsThePrintedOne) {
  EXPECT_EQ(int_plucker::edge_bound({24, 24}), -1);
  EXPECT_EQ(int_plucker::edge_bound({20, 24}), -16);
  EXPECT_EQ(int_plucker::edge_bound({16, 15}), -1);
  EXPECT_EQ(proven_bound(16, 0), -32766);
}

/// The unit itself, on a box whose edge shows the least side relation, and on one that shows the next lower.
template <int T>
void expect_bound_in_the_unit(const Search& found) {
  using F = IntFormat<6, T>;
  const Edge& worst = found.least[static_cast<std::size_t>(F::bits.trimmed())].edge;
  const auto hit = [](const Edge& edge) {
    // A part of the silhouette: the planes that the edge's side relation reads. The others lie far outside.
    IntPluckerOperands<Native, F> in;
    in.irx = in.iry = in.irz = 0;
    in.irex = in.irey = in.irez = 0;
    in.rinf = true;
    in.iri = edge.di;
    in.irj = edge.dj;
    in.irk = 31;
    in.ixmin = edge.dj >= 0 ? -31 : edge.plane_i;
    in.ixmax = edge.dj >= 0 ? edge.plane_i : 31;
    in.iymin = edge.di >= 0 ? edge.plane_j : -31;
    in.iymax = edge.di >= 0 ? 31 : edge.plane_j;
    in.izmin = -31;
    in.izmax = 31;
    return IntPlucker::test(F(), in).hit.to_bool();
  };
  EXPECT_TRUE(hit(worst)) << "t = " << T;
  // Moves the edge over the ray until the relation drops below the bound. The rest of the box stays.
  Edge moved = worst;
  while (moved.side(F::bits.trimmed()) >= int_plucker::edge_bound(F::bits) &&
         std::max(std::abs(moved.plane_i), std::abs(moved.plane_j)) < 31) {
    moved.plane_i -= moved.dj > 0 ? 1 : moved.dj < 0 ? -1 : 0;
    moved.plane_j += moved.di > 0 ? 1 : moved.di < 0 ? -1 : 0;
  }
  ASSERT_LT(moved.side(F::bits.trimmed()), int_plucker::edge_bound(F::bits)) << "t = " << T;
  EXPECT_FALSE(hit(moved)) << "t = " << T;
}

TEST(EdgeBoundInTheUnit, SeparatesHitFromMiss) {
  const Search found = search(6);
  expect_bound_in_the_unit<6>(found);
  expect_bound_in_the_unit<7>(found);
  expect_bound_in_the_unit<8>(found);
  expect_bound_in_the_unit<9>(found);
  expect_bound_in_the_unit<10>(found);
  expect_bound_in_the_unit<11>(found);
}

}  // namespace
}  // namespace hitpipe::hls::edge_bound_test
