// Enumerators of the C interface as Python says them: HITPIPE_PLANE_LOW is "plane_low".
#pragma once

#include <array>
#include <string_view>

#include "hitpipe/ref.h"

namespace hitpipe::python {

inline constexpr std::array<std::string_view, HITPIPE_CORNER + 1> role_names{
    "origin",       "origin_high", "endpoint", "direction", "inverse",    "inverse_low",
    "inverse_high", "length",      "endless",  "plane_low", "plane_high", "exponent",
    "backward",     "entry",       "owner",    "major",     "other",      "corner"};
inline constexpr std::array<std::string_view, HITPIPE_FLAG + 1> kind_names{"integer", "natural", "real",
                                                                           "flag"};
inline constexpr std::array<std::string_view, HITPIPE_INNER + 1> meaning_names{
    "hit",           "enters",       "leaves",     "second_first", "determinant", "determinant_low",
    "volume",        "volume_low",   "edge_u",     "edge_u_low",   "edge_v",      "edge_v_low",
    "error",         "major_axis",   "back",       "ray_origin",   "slope",       "mantissa_low",
    "mantissa_high", "ray_exponent", "ray_length", "tie",          "once",        "side",
    "zero",          "inner"};
static_assert(!role_names.back().empty() && !meaning_names.back().empty(), "a name for each");

[[nodiscard]] constexpr std::string_view name_of(hitpipe_role role) {
  return role_names.at(static_cast<std::size_t>(role));
}
[[nodiscard]] constexpr std::string_view name_of(hitpipe_kind kind) {
  return kind_names.at(static_cast<std::size_t>(kind));
}
[[nodiscard]] constexpr std::string_view name_of(hitpipe_meaning meaning) {
  return meaning_names.at(static_cast<std::size_t>(meaning));
}

}  // namespace hitpipe::python
