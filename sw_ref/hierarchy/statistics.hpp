// What a hierarchy is like, and hierarchies of one mesh with larger and larger leaves (appendix B).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "rays/mesh/mesh.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

struct BvhStatistics {
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t triangles = 0;
  int depth = 0;                       ///< levels; the root is level 1
  std::vector<std::size_t> leaves_of;  ///< leaves_of[n]: leaves with n triangles; the last is not 0
  double sah_cost = 0;  ///< cost for a random line that meets the root (appendix B), with the padded boxes
  /// The share of branches, among those that random lines meet, in which the line meets the overlap of the
  /// children's boxes.
  double child_overlap = 0;
  std::size_t node_bytes = 0;   ///< 32 a node
  std::size_t order_bytes = 0;  ///< 4 a triangle

  [[nodiscard]] int most_in_leaf() const { return static_cast<int>(leaves_of.size()) - 1; }
  [[nodiscard]] double mean_in_leaf() const {
    return static_cast<double>(triangles) / static_cast<double>(leaves);
  }
};

[[nodiscard]] BvhStatistics statistics(const Bvh& bvh);

/// Most triangles per leaf, as the rows of Tables B.1 to B.8.
constexpr std::array<int, 23> appendix_b_sizes{1,  2,  3,  4,  5,  6,  7,  8,  9,   10,  11, 12,
                                               13, 14, 15, 16, 20, 24, 32, 64, 128, 256, 512};

struct SweepStep {
  int max_triangles;
  double build_seconds;
  const Bvh& bvh;  ///< valid until the visit ends
};

/// Builds a hierarchy for each size, in order, with the other `options`, and calls `visit` with it. Only one
/// hierarchy exists at a time. Throws as build_bvh does.
void sweep_max_triangles(const Mesh& mesh, BuildOptions options,
                         const std::function<void(const SweepStep&)>& visit);

}  // namespace hitpipe::ref
