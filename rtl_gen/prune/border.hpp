// Operands on both sides of a border: they differ by one unit of one port, and an answer of one bit differs.
// Such a pair shows a comparison of the wrong kind, a constant that is off by one, a low bit that is lost.
// The search halves the way between a hit and a miss, for one port after another: the border is then close
// for each of these ports. From either side, operands with one bit changed that answer as the other side does
// show what depends on that bit alone.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "rtl_gen/prune/draw.hpp"

namespace hitpipe::rtl {

class Border {
 public:
  /// `draw` and `evaluate` must be those of one unit. Answers are the results of one bit.
  Border(const Draw& draw, const Evaluate& evaluate, const std::vector<hls::Result>& results);

  /// From operands that meet the demands: a pair, then those with one bit changed. Empty when chance finds no
  /// way to another answer.
  [[nodiscard]] std::vector<Vector> near(const std::vector<std::int64_t>& operands,
                                         std::mt19937_64& random) const;

 private:
  /// Operands of another answer that differ from these in one port, and that port.
  struct Way {
    Vector here, there;
    std::size_t port;
    std::size_t answer;
  };
  [[nodiscard]] std::optional<Way> way_across(const Vector& here, std::mt19937_64& random) const;
  /// Shortens it to one unit; false when what lies between is not as demanded.
  [[nodiscard]] bool shorten(Way& way) const;
  /// `from` with one bit of the way's port changed, which answers as `as` does.
  [[nodiscard]] std::optional<Vector> bit_across(const Vector& from, const Vector& as, const Way& way,
                                                 std::mt19937_64& random) const;

  const Draw& draw_;
  const Evaluate& evaluate_;
  std::vector<std::size_t> answers_;  ///< places of the results of one bit
};

}  // namespace hitpipe::rtl
