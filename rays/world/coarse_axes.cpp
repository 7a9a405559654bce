#include "rays/world/coarse_axes.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "rays/exact/grid.hpp"

namespace hitpipe::ref {

// Why nothing is missed. On an axis let u = 2^k, io the rounded origin, [a, b] the outward rounded box, and
//   io' = u floor(io / u),  a' = u floor((a - (u - 1)) / u),  b' = u ceil(b / u).
// Then io' = io - r with 0 <= r <= u - 1, a' <= a - (u - 1) and b' >= b, so
//   a' - io' <= a - (u - 1) - io + r <= a - io   and   b' - io' >= b - io + r >= b - io:
// seen from the cut origin, the grown box contains the box as seen from the rounded origin. The proofs in
// int_slabs_ray.cpp and int_plucker_ray.cpp use only these facts about origin and box:
//   both differences bound x, d0 <= x <= d1            they still do: d0 sinks, d1 rises
//   no difference is beyond M                         we require |a'|, |b'| <= G + 1 and |io'| <= G
//   below Pluecker: ixmin lies below, ixmax above the box    a' <= a, b' >= b
// The rest of the proofs does not change.

namespace {

std::int64_t cut(std::int64_t coordinate, int dropped) {
  return coordinate >> dropped << dropped;
}
std::int64_t coarse_lower(std::int64_t min, int dropped) {
  return cut(min - ((std::int64_t{1} << dropped) - 1), dropped);
}
std::int64_t coarse_upper(std::int64_t max, int dropped) {
  return -cut(-max, dropped);
}

[[noreturn]] void leaves(const char* what, std::size_t axis, std::int64_t coordinate, int dropped,
                         int coord_bits) {
  throw std::out_of_range(
      fmt::format("coarse axes: {}.{} = {} leaves the {}-bit grid; drop fewer than {} low bits of {}", what,
                  "xyz"[axis], coordinate, coord_bits, dropped, "xyz"[axis]));
}

}  // namespace

void check_coarse(const CoarseAxes& coarse, int coord_bits, std::string_view who) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (coarse.dropped[i] >= 0 && coarse.dropped[i] <= coord_bits - 2) continue;
    throw std::invalid_argument(fmt::format("{}: {} dropped bits of {}; of {} bits 0 to {} can be dropped",
                                            who, coarse.dropped[i], "xyz"[i], coord_bits, coord_bits - 2));
  }
}

IntOrigin coarse_origin(const IntOrigin& origin, const CoarseAxes& coarse, int coord_bits) {
  IntOrigin out;
  for (std::size_t i = 0; i < 3; ++i) {
    const int dropped = coarse.dropped[i];
    const std::int64_t moved = cut(origin[i], dropped);
    if (moved < -grid_scale(coord_bits)) leaves("origin", i, moved, dropped, coord_bits);
    out[i] = static_cast<std::int32_t>(moved);
  }
  return out;
}

IntBox coarse_box(const IntBox& box, const CoarseAxes& coarse, int coord_bits) {
  IntBox out;
  for (std::size_t i = 0; i < 3; ++i) {
    const int dropped = coarse.dropped[i];
    const std::int64_t min = coarse_lower(box.min[i], dropped);
    const std::int64_t max = coarse_upper(box.max[i], dropped);
    if (min < -grid_limit(coord_bits)) leaves("min", i, min, dropped, coord_bits);
    if (max > grid_limit(coord_bits)) leaves("max", i, max, dropped, coord_bits);
    out.min[i] = static_cast<std::int32_t>(min);
    out.max[i] = static_cast<std::int32_t>(max);
  }
  return out;
}

bool fits_grid(const IntOrigin& lowest_origin, const IntBox& bounds, const CoarseAxes& coarse,
               int coord_bits) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int dropped = coarse.dropped[i];
    if (cut(lowest_origin[i], dropped) < -grid_scale(coord_bits) ||
        coarse_lower(bounds.min[i], dropped) < -grid_limit(coord_bits) ||
        coarse_upper(bounds.max[i], dropped) > grid_limit(coord_bits))
      return false;
  }
  return true;
}

std::string to_text(const CoarseAxes& coarse) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    if (coarse.dropped[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", "xyz"[i], coarse.dropped[i]);
  }
  return text.empty() ? "none" : text;
}

}  // namespace hitpipe::ref
