// What `hitpipe fit` prints for people: what the scene needs, the unit of each design, and what was left out.
#pragma once

#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "sim/fit/fit.hpp"

namespace hitpipe::cli {

/// A fitted design: its row for JSON and CSV, and what the fit left out.
struct FitReport {
  Row row;
  std::vector<sim::LeftOut> left_out;  ///< largest first
  std::string cost;                    ///< of its box and triangle tests
  std::string first_mismatch;          ///< among the vectors
};

/// Text of 80 columns. `advice`: which of the units to build, in lines without ends.
[[nodiscard]] std::string fit_text(const std::string& scene, const ref::SceneDemands& demands,
                                   const std::vector<FitReport>& reports,
                                   const std::vector<std::string>& advice);

/// One line. Empty when everything that must be 0 is 0.
[[nodiscard]] std::string wrong_text(const FitReport& report);

}  // namespace hitpipe::cli
