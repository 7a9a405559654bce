// A diagram of a sweep: occupancy against rays in flight.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cli/report/picture.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

/// A line for each of the thesis's units that were swept with several numbers of rays in flight. Units that
/// cannot be told apart share a style. None when there is none.
[[nodiscard]] std::optional<Picture> occupancy_picture(const std::string& scene,
                                                       std::span<const sim::SweepRow> units,
                                                       const PictureForm& form);

}  // namespace hitpipe::cli
