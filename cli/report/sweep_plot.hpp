// Diagrams of a sweep, by gnuplot: error against cost, with the Pareto front, and area against rate. Each
// mark stands where its values are, with its unit's name beside it. Axes end where the data does, and what is
// plotted are columns of the rows' file. Each design has a mark of its own, up to twelve in shape as in
// colour, so that the pictures can be read in grey. Colours are Okabe and Ito's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report/picture.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// The units that no other unit beats in both figures, in order of rising cost.
struct CostAndError {
  double cost;
  double error;
};
[[nodiscard]] std::vector<CostAndError> pareto_front(std::vector<CostAndError> units);

/// Two columns of sim::sweep_columns.
struct Diagram {
  const char* name;   ///< for file names: "error_run_time"
  const char* title;  ///< after the scene's name
  std::string_view cost;
  const char* cost_label;  ///< with its unit
  std::string_view error;
  const char* error_label;
};
/// Of box tests alone, as the thesis compares; then with triangle tests; then of memory.
/// With areas in lookup tables on a chip, in mm² elsewhere.
[[nodiscard]] std::span<const Diagram> diagrams(bool on_chip);

/// All `units` have the same number of rays in flight.
[[nodiscard]] Picture diagram_picture(const std::string& scene, std::span<const sim::SweepRow> units,
                                      const Diagram& diagram, const PictureForm& form);
/// A line for each design that was swept at several intervals, in its default format or else its last one:
/// the unit's area against the boxes a second of a full unit. A mark names its interval. None when there is
/// no such design.
[[nodiscard]] std::optional<Picture> rate_picture(const std::string& scene,
                                                  std::span<const sim::SweepRow> units,
                                                  const PictureForm& form);

}  // namespace hitpipe::cli
