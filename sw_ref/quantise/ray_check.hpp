// What every ray set-up asks of its input, and the one-line errors that say so. `caller` opens the message.
#pragma once

#include <string_view>

#include "hls/box/int_format.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::ref {

/// Throws std::out_of_range for an origin outside [-1, 1]^3, std::invalid_argument for a direction that is
/// not finite or all zero.
void check_ray(const Ray& ray, std::string_view caller);

/// Throws std::invalid_argument for a format that is no integer unit's; those of IntBits::min_proved, below
/// the range that the message names, pass for the exhaustive tests.
void check_format(hls::IntBits bits, std::string_view caller);

/// Throws std::invalid_argument unless length >= 0 or infinite.
void check_length(float length, std::string_view caller);

}  // namespace hitpipe::ref
