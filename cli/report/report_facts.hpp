// What a report tells. It is measured before the page is written; short measurements are made here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "area_model/price.hpp"
#include "cli/report/core_facts.hpp"
#include "cli/report/picture.hpp"
#include "cli/report/report_pictures.hpp"
#include "cli/report/report_sweep.hpp"
#include "cli/report/sweep_rows.hpp"
#include "cli/text/stiffness_report.hpp"
#include "sim/check/check.hpp"

namespace hitpipe::cli {

/// Prices of the units that the library can price, and of the best rows, each once.
[[nodiscard]] std::vector<area::Price> report_prices(std::span<const ReportUnit> units,
                                                     std::span<const sim::SweepRow> rows,
                                                     const rtl::Library& library);
/// The commands that print them; `library_option` is " --library xc7", or nothing for the default.
[[nodiscard]] std::vector<std::string> price_commands(std::span<const area::Price> prices,
                                                      const std::string& library_option);

/// A unit against the exact referee on the adversary's cases, as hitpipe check judges it.
struct Stability {
  std::string design;
  std::string bits;
  std::string command;
  std::vector<sim::CategoryResult> categories;
  sim::CategoryResult all;  ///< their sum
};
struct StabilityOptions {
  std::uint64_t tests = 20'000;  ///< of each unit, or of each ratio of a direction
  std::uint64_t seed = 1;
  int threads = 1;
};
[[nodiscard]] std::vector<Stability> measure_stability(std::span<const ReportUnit> units,
                                                       const StabilityOptions& options);

/// False hits on stiff rays, of those of these designs that never miss, in their formats of a stiffness
/// report.
[[nodiscard]] std::vector<MeasuredDesign> measure_stiffness(std::span<const rtl::Design* const> designs,
                                                            const StabilityOptions& options);

struct Diagrammed {
  DrawnPicture picture;
  std::string caption;
};
/// The diagrams of error against cost. A diagram of occupancy too, when several numbers of rays in flight
/// were measured.
[[nodiscard]] std::vector<Diagrammed> draw_diagrams(std::span<const sim::SweepRow> rows,
                                                    const PictureForm& form);

/// Rays that find another triangle and pixels that differ, by the bits of the integer world.
[[nodiscard]] Diagrammed draw_world(std::span<const Row> rows, const PictureForm& form);

struct Drawing {
  std::string svg;
  std::string alternative;
  std::string caption;
};
/// The stages of a design, in groups.
struct Schematic {
  std::string title;
  std::vector<Drawing> drawings;
};
/// One for each design, at its default format. None when Graphviz is not installed.
[[nodiscard]] std::vector<Schematic> draw_schematics(std::span<const rtl::Design* const> designs);

/// Versions of the compiler that built this program and of the programs that it calls.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> versions();

struct ReportFacts {
  std::string version;                    ///< of this program
  std::string command;                    ///< the user's command
  std::vector<std::string> row_commands;  ///< commands that make the rows
  std::string scene;
  bool named = false;  ///< the user named designs; else all are swept, and the thesis's are looked at
  std::vector<std::pair<std::string, std::string>> asked;
  std::vector<sim::SweepRow> rows;
  std::vector<Diagrammed> diagrams;
  ReportPictures pictures;
  std::vector<area::Price> prices;
  std::vector<Stability> stability;
  std::vector<MeasuredDesign> stiffness;
  std::string stiffness_command;
  std::vector<std::string> area_commands;
  std::optional<Diagrammed> stiffness_diagram;  ///< of designs that never miss, if there is one
  std::vector<Row> world;                       ///< of the integer world, by format
  std::string world_command;
  Diagrammed world_diagram;
  CoreFacts core;
  std::vector<Diagrammed> core_diagrams;
  std::uint64_t seed = 1;
  std::vector<Schematic> schematics;
};

}  // namespace hitpipe::cli
