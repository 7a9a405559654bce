// Vectors that know nothing of rays and boxes: operands drawn at the ports of a unit, and the answers of its
// C++. Few random operands hit, and most hits stay hits when a part of the unit fails. So vectors are drawn
// beside hits, at corners, and in pairs across the border of a hit. A search adds vectors whose result
// depends on a bit that decides no other vector's result.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/graph/graph_lanes.hpp"
#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::rtl {

class Border {
 public:
  /// `draw` and `evaluate` must belong to one unit. Answers are the results of one bit.
  Border(const Draw& draw, const Evaluate& evaluate, const std::vector<hls::Result>& results);

  /// From operands that meet the demands: a pair with different answers, then its vectors with one bit
  /// changed. Empty if chance finds no pair.
  [[nodiscard]] std::vector<Vector> near(const std::vector<std::int64_t>& operands,
                                         std::mt19937_64& random) const;

 private:
  /// Two vectors that differ in one port and in one answer.
  struct Way {
    Vector here, there;
    std::size_t port;
    std::size_t answer;
  };
  [[nodiscard]] std::optional<Way> way_across(const Vector& here, std::mt19937_64& random) const;
  /// Moves the two together until they are one unit apart; false if numbers between them break a demand.
  [[nodiscard]] bool shorten(Way& way) const;
  /// `from` with one bit of the way's port changed, if its answer is then the answer of `as`.
  [[nodiscard]] std::optional<Vector> bit_across(const Vector& from, const Vector& as, const Way& way,
                                                 std::mt19937_64& random) const;

  const Draw& draw_;
  const Evaluate& evaluate_;
  std::vector<std::size_t> answers_;  ///< places of the results of one bit
};

class ShownBits {
 public:
  /// Vectors have an operand for each of `ports`; the graph has some or all of these ports. Both must outlive
  /// the ShownBits.
  ShownBits(const Graph& graph, const std::vector<Port>& ports);

  /// The vectors, among at most 64, that show a bit as 0 or as 1 which no earlier vector has shown.
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

/// What the vectors of a unit are drawn for.
struct VectorUnit {
  const Graph& graph;              ///< its inputs are some or all of the ports
  const std::vector<Port>& ports;  ///< of the whole design
  const Demands& demands;          ///< which all vectors meet
  const Evaluate& evaluate;
  const std::vector<hls::Result>& results;
};

class PortVectors {
 public:
  PortVectors(const VectorUnit& unit, std::uint64_t seed);

  /// Corners, operands beside hits and at the border. The same calls in the same order give the same vectors.
  [[nodiscard]] std::vector<VectorGroup> groups(std::size_t count);
  /// First vectors that show bits of the graph which the groups do not show, as many as a long search finds;
  /// then other vectors at the border.
  [[nodiscard]] VectorGroup rare(const std::vector<VectorGroup>& groups, std::size_t count);
  /// Vectors at the border beside the operands; empty if the search finds none.
  [[nodiscard]] std::vector<Vector> border(const std::vector<std::int64_t>& operands) {
    return border_.near(operands, random_);
  }

 private:
  /// The last hit of a walk; empty: none yet.
  using LastHit = std::vector<std::int64_t>;

  [[nodiscard]] Vector noted(LastHit& last, std::vector<std::int64_t> operands) const;
  [[nodiscard]] Vector any() { return noted(any_hit_, draw_(random_)); }
  [[nodiscard]] Vector corners() { return noted(corner_hit_, draw_.corners(random_)); }
  [[nodiscard]] Vector beside_any();
  /// A neighbour of a hit at corners. Most ports stay at corners, so differences of two ports have few bits.
  [[nodiscard]] Vector beside_corners();
  /// Exactly `count`, if any operands hit.
  [[nodiscard]] std::vector<Vector> borders(std::size_t count);
  /// Neighbours of the last vectors found, and vectors at the border there.
  [[nodiscard]] std::vector<Vector> beside_found(const std::vector<Vector>& found, std::size_t count);

  VectorUnit unit_;
  Draw draw_;
  Border border_;
  std::mt19937_64 random_;
  LastHit any_hit_, corner_hit_;
};

}  // namespace hitpipe::rtl
