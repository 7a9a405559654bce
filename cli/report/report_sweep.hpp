// The rows of a report: measured for it, or read from a file of hitpipe sweep.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/sweep/resume.hpp"

namespace hitpipe::cli {

/// A unit that a report looks at closely.
struct ReportUnit {
  const rtl::Design* design;
  rtl::Format format;
};
/// Of designs that the user named: each in its usual format, or else in the last one that is swept. If none
/// is named, the thesis's six units (Table 7.2).
[[nodiscard]] std::vector<ReportUnit> report_units(const std::vector<sim::DesignFormats>& formats,
                                                   bool named);

/// Every design in its formats at each interval with 32 rays in flight, and the units that the library can
/// price with 1, 2, 4 .. 256.
[[nodiscard]] std::vector<sim::SweepPoint> report_points(const std::vector<sim::DesignFormats>& formats,
                                                         const std::vector<ReportUnit>& units,
                                                         const std::vector<int>& intervals,
                                                         const rtl::Library& library);

/// The rows of `file`. Throws what sim::read_rows_of() throws, and throws when there are no rows.
[[nodiscard]] std::vector<sim::SweepRow> take_rows(const std::filesystem::path& file,
                                                   const sim::SweepSubject& subject);

/// The commands of hitpipe sweep that measure these rows into rows.csv.
[[nodiscard]] std::vector<std::string> sweep_commands(std::span<const sim::SweepRow> rows,
                                                      const std::string& scene_options);

}  // namespace hitpipe::cli
