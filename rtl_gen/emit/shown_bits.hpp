// Which bits of a graph's values some vector has shown: if the bit were the other way, a result would change.
// A fault in a part of the graph that no vector shows goes unseen.
#pragma once

#include <cstdint>
#include <vector>

#include "rtl_gen/graph/graph_lanes.hpp"
#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::rtl {

class ShownBits {
 public:
  /// The vectors' operands are those of `ports`, of which the graph has some or all. Both must outlive it.
  ShownBits(const Graph& graph, const std::vector<Port>& ports);

  /// Of at most 64 vectors those that show a bit, as 0 or as 1, that none before them has shown.
  [[nodiscard]] std::vector<Vector> new_ones(std::span<const Vector> vectors);
  /// Bits, each as 0 and as 1, that no vector has shown so far.
  [[nodiscard]] std::size_t hidden() const { return hidden_.size(); }

 private:
  struct Bit {
    NodeId node;
    int bit;
    bool value;
  };

  GraphLanes lanes_;
  std::vector<std::size_t> places_;  ///< of the graph's inputs among the ports
  std::vector<Bit> hidden_;
};

}  // namespace hitpipe::rtl
