// Work-precision diagrams of a sweep (SVG, by gnuplot): extra box tests against run time, area, and their
// product, with the Pareto front; and occupancy against rays in flight. The thesis's six units are labelled.
// Run time is divided by the reference's box tests and all axes are fixed, so diagrams of any two scenes can
// be compared side by side. Colours are those of Okabe and Ito; each design has a mark of its own.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// The units that no other unit beats in both figures, in order of rising cost.
struct CostAndError {
  double cost;
  double error;
};
[[nodiscard]] std::vector<CostAndError> pareto_front(std::vector<CostAndError> units);

enum class Cost { run_time, area, area_run_time };
inline constexpr Cost costs[] = {Cost::run_time, Cost::area, Cost::area_run_time};

/// The lowest error on the axis. Units with less error are drawn there.
inline constexpr double error_floor_pct = 1e-4;

/// The text under the axis and its fixed range. Units outside the range are drawn at its ends.
struct CostAxis {
  const char* name;   ///< for file names, such as "run_time"
  const char* label;  ///< with its unit
  double least;
  double most;
};
[[nodiscard]] const CostAxis& axis_of(Cost cost);

/// The gnuplot programs; the same text for the same numbers. All `units` have the same number of rays in
/// flight.
[[nodiscard]] std::string work_precision_script(const std::string& scene,
                                                std::span<const sim::SweepRow> units, Cost cost);
/// A line for each of the thesis's units that was swept with several numbers of rays in flight.
[[nodiscard]] std::string occupancy_script(const std::string& scene, std::span<const sim::SweepRow> units);

}  // namespace hitpipe::cli
