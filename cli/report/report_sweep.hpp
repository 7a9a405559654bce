// The rows of a report: measured for it, or taken from a file of hitpipe sweep.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sim/sweep/rows_file.hpp"
#include "sim/sweep/sweep.hpp"

namespace hitpipe::cli {

/// Every design in each of `formats` (without any: sim::sweep_formats()) with 32 rays in flight, and the
/// thesis's six units with 1, 2, 4 .. 256.
[[nodiscard]] std::vector<sim::SweepPoint> report_points(std::vector<hls::IntBits> formats);

/// Measures what `file` does not hold yet, each row written as soon as it is known, and returns all that it
/// holds. Throws as sim::run_sweep() and sim::read_rows() do, and when the file is about something else.
[[nodiscard]] sim::RowsFile sweep_into(const std::filesystem::path& file, const std::string& program,
                                       const ref::Scene& scene, const ref::Bvh& bvh,
                                       std::vector<sim::SweepPoint> points, const sim::SweepOptions& options);

/// The rows of `file`. Throws as sim::read_rows() does, when they are not `about` this, and when there are
/// none.
[[nodiscard]] sim::RowsFile take_rows(const std::filesystem::path& file, const std::string& about);

/// The commands of hitpipe sweep that measure these rows into rows.csv.
[[nodiscard]] std::vector<std::string> sweep_commands(std::span<const sim::SweepRow> rows,
                                                      const std::string& scene_options);

}  // namespace hitpipe::cli
