// Diagrams of a sweep (SVG, by gnuplot): error against cost, with the Pareto front, and occupancy against
// rays in flight. Each mark has its units' names beside it, axes end where the data does, and what is plotted
// are columns of the rows' file. Each design has a mark of its own, up to twelve in shape as in
// colour, so that the pictures can be read in grey. Colours are Okabe and Ito's.
#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// The units that no other unit beats in both figures, in order of rising cost.
struct CostAndError {
  double cost;
  double error;
};
[[nodiscard]] std::vector<CostAndError> pareto_front(std::vector<CostAndError> units);

struct DesignStyle {
  std::string_view colour;
  int shape;  ///< gnuplot's number
  double size;

  friend auto operator<=>(const DesignStyle&, const DesignStyle&) = default;
};
/// The marks of the design at this place of the catalogue. No shape comes twice among the first twelve; the
/// next take other pairs of colour and shape, and when these are used up too, larger marks.
[[nodiscard]] DesignStyle design_style(std::size_t place);

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

/// The gnuplot programs; the same text for the same numbers. All `units` have the same number of rays in
/// flight.
[[nodiscard]] std::string diagram_script(const std::string& scene, std::span<const sim::SweepRow> units,
                                         const Diagram& diagram);
/// A line for each design that was swept at several intervals, in its default format or else its last one:
/// the unit's area against the boxes a second of a full unit. A mark names its interval. Empty when there is
/// none.
[[nodiscard]] std::string rate_script(const std::string& scene, std::span<const sim::SweepRow> units);
/// A line for the thesis's units that were swept with several numbers of rays in flight. Units that cannot be
/// told apart share one. Empty when there is none.
[[nodiscard]] std::string occupancy_script(const std::string& scene, std::span<const sim::SweepRow> units);

}  // namespace hitpipe::cli
