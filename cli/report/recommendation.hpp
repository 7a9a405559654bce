// Which unit of a sweep to build, by its whole cost: the area of the box unit and of a triangle unit, each
// for the time that it works. A unit with few bits saves area and makes triangle tests in vain, so the area
// and the time of its box tests alone do not tell.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The place of the row with the least whole cost, among those with this number of rays in flight and at most
/// so many extra box tests. Nothing when there is none.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const sim::SweepRow> rows, int rays_in_flight,
                                                  double most_extra_box_tests_pct = no_limit);
/// The same by box tests alone, as the thesis compares.
[[nodiscard]] std::optional<std::size_t> cheapest_boxes(std::span<const sim::SweepRow> rows,
                                                        int rays_in_flight);

/// "mm²", or "LUT" on a chip.
[[nodiscard]] std::string area_unit(const sim::SweepRow& row);

/// What a unit costs, with and without triangle tests: "0.97 mm² ms, of box tests alone 0.55; ...".
[[nodiscard]] std::string cost_text(const sim::SweepRow& row);

/// The cheapest unit; and, if another is cheaper by box tests alone, what that costs as a whole. Lines
/// without their ends.
[[nodiscard]] std::vector<std::string> recommendation(std::span<const sim::SweepRow> rows);

/// What the whole cost counts, at which cost of a triangle test, and what it leaves out.
[[nodiscard]] std::string cost_caveat(const sim::SweepRow& row);

}  // namespace hitpipe::cli
