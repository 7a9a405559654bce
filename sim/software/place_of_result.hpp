// Where a result of a unit is found, by what it means.
#pragma once

#include <cstddef>
#include <span>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

/// The place of a result in a design's list. Throws std::runtime_error, one line, if it is not there.
[[nodiscard]] std::size_t place_of_result(std::span<const hls::Result> results, hls::Meaning meaning,
                                          int box);

}  // namespace hitpipe::sim
