// The marks of a diagram's units. Units of a design that would cover one another share a mark that names them
// all; marks of different designs that would cover one another stand side by side.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/report/label_places.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

struct UnitMark {
  std::string design;
  std::string name;  ///< formats of the design, such as "24/24,28,32"; the design where it has one format
  Mark place;
};

/// `places` are those of the units. In the order of the units' first ones.
[[nodiscard]] std::vector<UnitMark> unit_marks(std::span<const sim::SweepRow> units,
                                               std::span<const Mark> places);

}  // namespace hitpipe::cli
