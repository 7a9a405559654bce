// Statistics of a hierarchy that need no rays.
#pragma once

#include <cstddef>
#include <vector>

#include "sw_ref/hierarchy/bvh.hpp"

namespace hitpipe::ref {

struct BvhStatistics {
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t triangles = 0;
  int depth = 0;                       ///< levels; the root is level 1
  std::vector<std::size_t> leaves_of;  ///< leaves_of[n]: leaves with n triangles; the last is not 0
  double sah_cost = 0;  ///< cost for a random line that meets the root (cost.hpp), with the padded boxes
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

}  // namespace hitpipe::ref
