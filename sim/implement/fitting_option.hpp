// What makes a unit fit a chip that it does not fit: a longer clock, a test every few cycles, or fewer bits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/implement/unit_implementation.hpp"

namespace hitpipe::sim {

/// A unit that differs in one option.
struct FittingCandidate {
  std::string option;  ///< as the user gives it: "--ii 3"
  Format format;
  std::optional<int> clock_ps;
  int interval = 1;
};

/// In the order in which they are tried: longer clocks with fewer stages, intervals of 2, 3, 4 and 6 cycles,
/// and the widest format of each group of Software::smaller_formats, from the widest group down.
[[nodiscard]] std::vector<FittingCandidate> fitting_candidates(const rtl::Design& design,
                                                               const Format& format, const Target& target,
                                                               const ImplementOptions& options);

/// Which option makes a unit fit that was implemented with `options` and has an excess, and what it takes
/// then: "with --ii 3 it takes 4 of 8 dsps". The area model estimates each candidate. Those that fit by the
/// estimate are synthesised, and placed with one seed if the unit is, until one fits. Of a large one the
/// estimate alone decides, and the text says so. If no candidate fits, the text says that.
[[nodiscard]] std::string fitting_option(const rtl::Design& design, const Format& format,
                                         const Target& target, const ImplementOptions& options,
                                         const Implementation& unit);

}  // namespace hitpipe::sim
