// Work-precision diagrams of a sweep (SVG, by gnuplot): extra box tests against run time, area, and their
// product, with the Pareto front; and occupancy against rays in flight. The thesis's six units are labelled.
// Run time is divided by the reference's box tests and all axes are fixed, so that diagrams of any two scenes
// can be laid side by side. Colours of Okabe and Ito, a mark of its own for each design.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// The units that none betters in one figure without being worse in the other, by rising cost.
struct CostAndError {
  double cost;
  double error;
};
[[nodiscard]] std::vector<CostAndError> pareto_front(std::vector<CostAndError> units);

enum class Cost { run_time, area, area_run_time };
inline constexpr Cost costs[] = {Cost::run_time, Cost::area, Cost::area_run_time};

/// The least error that an axis shows; smaller ones are drawn on it.
inline constexpr double error_floor_pct = 1e-4;

/// Words under the axis, and its fixed range; units beyond it are drawn on its ends.
struct CostAxis {
  const char* name;   ///< "run_time", for files
  const char* label;  ///< with its unit
  double least;
  double most;
};
[[nodiscard]] const CostAxis& axis_of(Cost cost);

/// The gnuplot programs; the same text for the same numbers. `units` are of one number of rays in flight.
[[nodiscard]] std::string work_precision_script(const std::string& scene,
                                                std::span<const sim::SweepRow> units, Cost cost);
/// A line for each of the thesis's units that was swept with several numbers of rays in flight.
[[nodiscard]] std::string occupancy_script(const std::string& scene, std::span<const sim::SweepRow> units);

}  // namespace hitpipe::cli
