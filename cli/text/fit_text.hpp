// What `hitpipe fit` prints for people: what the scene asks for, what each design becomes and is left
// without.
#pragma once

#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "sim/fit/fit.hpp"

namespace hitpipe::cli {

/// A fitted design: the row that JSON and CSV have, and what the fit left out of it.
struct FitReport {
  Row row;
  std::vector<sim::LeftOut> left_out;  ///< largest first
  std::string first_mismatch;          ///< of the vectors
};

/// In eighty columns.
[[nodiscard]] std::string fit_text(const std::string& scene, const ref::SceneDemands& demands,
                                   const std::vector<FitReport>& reports);

/// One line; empty when all that must be 0 is.
[[nodiscard]] std::string wrong_text(const FitReport& report);

}  // namespace hitpipe::cli
