// What `hitpipe core fit` says of a core.
#pragma once

#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "sim/fit/core_fit.hpp"

namespace hitpipe::cli {

/// Its options, what it takes, and its rate in the slowest scene.
[[nodiscard]] Row core_row(const rtl::CoreOptions& core, const area::CorePartPrice& price,
                           const sim::CoreRate& rate, const rtl::Library& library);

/// A cut of the fitted core of this price.
[[nodiscard]] Row cut_row(const sim::CoreCut& cut, const area::CorePartPrice& fitted,
                          const rtl::Library& library);

/// Rays that find another triangle than in floats, of those that were compared, with the ends of the interval.
void add_other_triangles(Row& row, const ref::Share& rays);
/// A table of such rows as text: each share is one column with its interval.
[[nodiscard]] std::string shares_table(const std::vector<Row>& rows);

}  // namespace hitpipe::cli
