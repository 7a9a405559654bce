// Vectors that know nothing of rays and boxes: what can be drawn at the ports of a unit and judged by its
// C++. Few of any operands hit, and most hits stay hits when a part of the unit fails. So vectors are drawn
// beside hits, at corners, and in pairs across the border of a hit; and those are sought whose result depends
// on bits on which no other vector's result depends.
#pragma once

#include "rtl_gen/emit/vector_set.hpp"
#include "rtl_gen/prune/border.hpp"

namespace hitpipe::rtl {

/// What the vectors of a unit are drawn for.
struct VectorUnit {
  const Graph& graph;              ///< its inputs are some or all of the ports
  const std::vector<Port>& ports;  ///< those of the whole design
  const Demands& demands;          ///< which all vectors meet
  const Evaluate& evaluate;
  const std::vector<hls::Result>& results;
};

class PortVectors {
 public:
  PortVectors(const VectorUnit& unit, std::uint64_t seed);

  /// Corners, operands beside hits and at the border. This and the others give the same in the same order of
  /// calls.
  [[nodiscard]] std::vector<VectorGroup> groups(std::size_t count);
  /// First those that show bits of the graph which the groups do not show, as far as many draws find such;
  /// then others at the border.
  [[nodiscard]] VectorGroup rare(const std::vector<VectorGroup>& groups, std::size_t count);
  /// At the border beside the operands; empty when none is found.
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
  /// Of a hit at corners, so that most ports stay at corners: differences of two have few bits.
  [[nodiscard]] Vector beside_corners();
  /// Exactly so many, where anything hits at all.
  [[nodiscard]] std::vector<Vector> borders(std::size_t count);
  /// Beside the last ones found, and at the border there.
  [[nodiscard]] std::vector<Vector> beside_found(const std::vector<Vector>& found, std::size_t count);

  VectorUnit unit_;
  Draw draw_;
  Border border_;
  std::mt19937_64 random_;
  LastHit any_hit_, corner_hit_;
};

}  // namespace hitpipe::rtl
