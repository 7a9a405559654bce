// `check` of box units: of one, or of several side by side.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/design_options.hpp"
#include "cli/text/check_report.hpp"
#include "host/piece.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::cli {

struct BoxCheck {
  std::vector<std::string> categories;  ///< empty: all
  std::uint64_t tests;                  ///< of each unit
  std::uint64_t seed;
  int threads;
  bool rtl;
  int interval;
  host::Piece piece;
  bool comparison;  ///< also the design's comparison, if it has one
};

/// The adversary's categories and those made for the design. Throws what chosen_of() throws.
[[nodiscard]] std::vector<ref::adversary::Category> box_categories(const rtl::Design& design,
                                                                   const std::vector<std::string>& names);

[[nodiscard]] CheckFindings check_box_unit(const rtl::Design& design, const Format& format,
                                           const BoxCheck& check);

/// Those of the names in their formats; without names, all that never miss. Throws std::runtime_error for
/// designs and formats that cannot be used.
[[nodiscard]] std::vector<sim::DesignFormats> compared_units(const DesignsChoice& choice);

[[nodiscard]] UnitsFindings check_box_units(const std::vector<sim::DesignFormats>& units,
                                            const BoxCheck& check);

/// The least number of batches of tests that one of these units has.
[[nodiscard]] std::uint64_t batches_of_each(const std::vector<sim::DesignFormats>& units,
                                            const BoxCheck& check);

}  // namespace hitpipe::cli
