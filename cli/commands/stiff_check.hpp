// `hitpipe check --stiff`: false hits as the components of a ray's direction grow apart.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/text/stiffness_report.hpp"
#include "cli/text/table.hpp"
#include "host/piece.hpp"

namespace hitpipe::cli {

struct StiffCheck {
  DesignsChoice units;  ///< without names: the designs that never miss
  SceneChoice scene;    ///< without a name: only drawn boxes
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  std::uint64_t tests = 60'000;
  std::uint64_t rays = 2'000;
  std::uint64_t seed = 1;
  int threads = 1;
};

struct StiffFindings {
  std::string scene;      ///< its name; empty: none was traversed
  std::string hierarchy;  ///< as a reader expects it
  Row mesh;               ///< as scene_row() says it; empty: no scene
  std::vector<MeasuredDesign> designs;

  /// Of the same check, with the formats that follow.
  StiffFindings& operator+=(StiffFindings later);
};

/// The conservative designs, unless the user names designs, with their formats; nothing is measured. A line
/// on standard error names what is left out. Throws std::runtime_error for designs and formats that cannot be
/// used.
[[nodiscard]] std::vector<MeasuredDesign> stiff_designs(const StiffCheck& command);

/// How many formats these designs have.
[[nodiscard]] std::uint64_t stiff_formats(const std::vector<MeasuredDesign>& designs);

/// Measures the formats of the piece. Throws std::runtime_error for scenes that cannot be used.
[[nodiscard]] StiffFindings check_stiff_rays(const StiffCheck& command, std::vector<MeasuredDesign> designs,
                                             host::Piece piece);

void to_json(Row& row, const StiffFindings& findings);
/// Throws nlohmann's exceptions for another form, and what rtl::find_design() and parse_format() throw.
void from_json(const Row& row, StiffFindings& findings);

struct StiffReport {
  std::string out;                  ///< a folder; empty: nothing is written
  std::optional<double> width_mm;   ///< of pictures
  std::vector<std::string> drawer;  ///< the program that draws; needed if there is a folder
  OutputFormat format = OutputFormat::text;
  Row notes;  ///< they go into the folder, beside the rows
};

/// Prints the table, writes what is to be written, and returns the exit code.
int report_findings(const StiffFindings& findings, const StiffReport& report);

}  // namespace hitpipe::cli
