// What a core did with a picture's rays, as figures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "sim/core/core_trace.hpp"

namespace hitpipe::cli {

/// What a core did with some of the rays.
struct CoreRun {
  std::size_t core = 0;  ///< of those that trace the same rays
  sim::CoreTrace trace;
};

/// As a piece keeps them in its file. `about` is what is said of all.
[[nodiscard]] Row kept_runs(const std::vector<CoreRun>& runs, Row about);

/// The same again. Throws nlohmann's exceptions for another form.
[[nodiscard]] std::vector<CoreRun> parse_runs(const Row& row);

/// With a cache also the share of its hits.
[[nodiscard]] Row trace_row(const sim::CoreTrace& trace, bool cache);

/// Of rays at edges and corners. `closed`: the mesh is, so that odd counts are wrong.
[[nodiscard]] Row edge_row(const sim::CoreTrace& trace, bool closed, OutputFormat format);

/// A line for each figure, since there are more of them than cores.
[[nodiscard]] std::vector<Row> turned(const std::vector<Row>& rows);

}  // namespace hitpipe::cli
