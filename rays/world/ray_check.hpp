// Checks that every ray set-up makes on its input. Errors are one line, which starts with `caller`.
#pragma once

#include <string_view>

#include "hls/box/int_format.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// Throws std::out_of_range for an origin outside [-1, 1]^3, std::invalid_argument for a direction that is
/// not finite or all zero.
void check_ray(const Ray& ray, std::string_view caller);

/// Throws std::invalid_argument unless an integer unit can have the format. Formats from IntBits::min_proved
/// on pass too, for the exhaustive tests, although the message does not name them.
void check_format(hls::IntBits bits, std::string_view caller);

/// Throws std::invalid_argument unless length >= 0 or infinite.
void check_length(float length, std::string_view caller);

}  // namespace hitpipe::ref
