// What the rows of a sweep recommend, in words.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// What a unit costs, with and without triangle tests: "0.97 mm² ms, of box tests alone 0.55; ...".
[[nodiscard]] std::string cost_text(const sim::SweepRow& row);

/// The cheapest unit; and, if another is cheaper by box tests alone, what that costs as a whole. Lines
/// without their ends.
[[nodiscard]] std::vector<std::string> recommendation(std::span<const sim::SweepRow> rows);

/// What the whole cost counts, at which cost of a triangle test, and what it leaves out.
[[nodiscard]] std::string cost_caveat(const sim::SweepRow& row);

}  // namespace hitpipe::cli
