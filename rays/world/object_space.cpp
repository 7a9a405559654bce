#include "rays/world/object_space.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "rays/exact/major_quotient.hpp"
#include "rays/exact/quick_numbers.hpp"
#include "rays/world/int128.hpp"

namespace hitpipe::ref {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;
using Point = std::array<std::int64_t, 3>;

/// Then N is 0 but for what makes it regular.
constexpr int most_halvings = 64;
constexpr double largest_coefficient = (1 << (ObjectSpace::coefficient_bits - 1)) - 1;

/// Signed shifts, down for count < 0.
Int128 shifted(Int128 x, int count) {
  return count >= 0 ? x * (static_cast<Int128>(1) << count) : x >> -count;
}
std::int64_t floored(Int128 x, int down) {
  return static_cast<std::int64_t>(shifted(x, -down));
}

/// With its sign.
double cofactor(const Matrix& m, std::size_t row, std::size_t column) {
  const std::size_t a = (row + 1) % 3, b = (row + 2) % 3, p = (column + 1) % 3, q = (column + 2) % 3;
  return m[a][p] * m[b][q] - m[a][q] * m[b][p];
}

double largest_of(const Matrix& m) {
  double largest = 0;
  for (const auto& row : m)
    for (const double x : row) largest = std::max(largest, std::abs(x));
  return largest;
}

/// The inverse of the map's matrix, or of one beside it if that flattens, or nearly so.
Matrix near_inverse(const GridMap& map) {
  Matrix own{};
  const double unit = power_of_two(-map.fraction);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j) own[k][j] = map.matrix[k][j] * unit;
  const double size = std::max(largest_of(own), 0x1p-24);
  // The moved matrices have no line in common with most that flatten; some multiple of it has a determinant.
  constexpr Matrix beside{{{1.0, 0.11, 0.22}, {0.33, 1.0, 0.44}, {0.05, 0.17, 1.0}}};
  for (double moved = 0;; moved = moved == 0 ? 0x1p-6 : 2 * moved) {
    Matrix m = own;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) m[k][j] += moved * size * beside[k][j];
    double det = 0;
    for (std::size_t j = 0; j < 3; ++j) det += m[0][j] * cofactor(m, 0, j);
    if (std::abs(det) < 1e-8 * size * size * size) continue;
    Matrix inverse{};
    const double by = 1 / det;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) inverse[k][j] = cofactor(m, j, k) * by;
    return inverse;
  }
}

/// |N| by rows, summed: below 2^15.
std::int64_t row_sum(const ObjectSpace& space, std::size_t k) {
  const auto& row = space.to_object[k];
  return std::int64_t{std::abs(row[0])} + std::abs(row[1]) + std::abs(row[2]);
}

/// No difference of a plane or corner in the object and a ray's origin there needs more than n+g bits. Behind the
/// second anchor an origin is at most three of the object's sizes away, and what the inverse is too short.
bool fits(const ObjectSpace& space, const GridMap& map, const hls::WorldBits& bits) {
  const std::int64_t limit = std::int64_t{1} << (bits.point() - 1);
  std::array<std::int64_t, 3> far{}, wide{};
  for (std::size_t j = 0; j < 3; ++j) {
    far[j] = std::max(std::abs(std::int64_t{space.box.min[j]} - map.move[j]),
                      std::abs(std::int64_t{space.box.max[j]} - map.move[j]));
    wide[j] = std::int64_t{space.box.max[j]} - space.box.min[j] + 1;
  }
  std::int64_t widest = 0, farthest = 0, unit = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (space.slack[k] >= limit) return false;
    const auto& row = space.to_object[k];
    const std::int64_t sum = row_sum(space, k);
    widest = std::max(widest, (std::int64_t{space.most[k]} << bits.finer) + space.slack[k]);
    unit = std::max(unit, (sum >> space.fraction) + 1);
    std::int64_t reach = 0;
    for (std::size_t j = 0; j < 3; ++j) reach += std::abs(row[j]) * far[j];
    // The first anchor is at a face along m, so along the others it is off by as much as the box is wide along m.
    for (std::size_t m = 0; m < 3; ++m)
      farthest =
          std::max(farthest, ((reach + (sum - std::abs(row[m])) * wide[m]) << bits.finer) >> space.fraction);
  }
  return 4 * widest + 2 * (farthest >> (ObjectSpace::inverse_bits - 1)) + 2 * unit + 16 < limit;
}

bool is_singular(const ObjectSpace& space) {
  const auto& n = space.to_object;
  std::int64_t det = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t p = (j + 1) % 3, q = (j + 2) % 3;
    det += n[0][j] * (std::int64_t{n[1][p]} * n[2][q] - std::int64_t{n[1][q]} * n[2][p]);
  }
  return det == 0;
}

}  // namespace

std::array<std::int64_t, 3> slack_of(const ObjectSpace& space, const GridMap& map,
                                     const hls::WorldBits& bits) {
  constexpr int j = ObjectSpace::guard_bits;
  const int down = space.fraction + map.fraction;
  std::array<std::int64_t, 3> slack{};
  for (std::size_t k = 0; k < 3; ++k) {
    Int128 beside = 0;  // |1 - N A|, by the largest corner
    for (std::size_t q = 0; q < 3; ++q) {
      std::int64_t product = 0;
      for (std::size_t i = 0; i < 3; ++i) product += std::int64_t{space.to_object[k][i]} * map.matrix[i][q];
      const Int128 r = (k == q ? static_cast<Int128>(1) << down : 0) - product;
      beside += (r < 0 ? -r : r) * space.most[q];
    }
    const Int128 row = row_sum(space, k);
    const Int128 of_corners = map.fraction == 0 ? 0 : shifted(row, map.fraction + bits.finer + j);
    const Int128 of_anchor = shifted(row, map.fraction + 1);
    const int by = down + 1 + j;
    const Int128 sum = shifted(beside, bits.finer + 1 + j) + of_corners + of_anchor;
    // The origin is cut off at its unit, and so is the way to the second anchor.
    const Int128 all = ((sum + (static_cast<Int128>(1) << by) - 1) >> by) + 2;
    slack[k] = static_cast<std::int64_t>(std::min<Int128>(all, std::int64_t{1} << 60));
  }
  return slack;
}

ObjectSpace object_space(const GridMap& map, const std::array<std::int32_t, 3>& most, const IntBox& box,
                         const hls::WorldBits& bits) {
  ObjectSpace space{.to_object = {}, .fraction = 0, .most = most, .slack = {}, .box = box};
  const Matrix inverse = near_inverse(map);
  const double largest = largest_of(inverse);
  std::int32_t moved = 0;
  for (int halvings = 0; halvings < most_halvings; ++halvings) {
    const double scale = std::min(1.0, largest_coefficient / largest) * power_of_two(-halvings);
    const int exponent = exponent_of(largest_coefficient / (largest * scale));
    space.fraction = std::clamp(exponent, 0, ObjectSpace::most_fraction);
    const double unit = scale * power_of_two(space.fraction);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j) {
        auto& x = space.to_object[k][j] = static_cast<std::int32_t>(nearest(inverse[k][j] * unit));
        if (k == j) x += x + moved > largest_coefficient ? -moved : moved;
      }
    if (is_singular(space)) {
      moved = 2 * moved + 1;
      continue;
    }
    space.slack = slack_of(space, map, bits);
    if (fits(space, map, bits)) return space;
  }
  throw std::out_of_range(fmt::format(
      "a mesh with corners up to {}, {}, {} on a grid of {} bits; up to {} there is always a ray's matrix",
      most[0], most[1], most[2], bits.coord, std::int64_t{1} << std::max(bits.coord - 5, 0)));
}

std::optional<ObjectRay> ObjectRay::enter(const ObjectSpace& space, const GridMap& map, const IntRay& ray,
                                          std::int64_t length, const hls::WorldBits& bits) {
  constexpr int j = ObjectSpace::guard_bits;
  const int g = bits.finer;
  const IntBox& box = space.box;
  const auto m = static_cast<std::size_t>(ray.major);
  const bool backward = ray.direction[m] < 0;
  // The first anchor: the near face of the instance's box along the major axis, or the ray's own origin.
  const std::int64_t near = std::int64_t{backward ? box.max[m] : box.min[m]} << g;
  const std::int64_t far = std::int64_t{backward ? box.min[m] : box.max[m]} << g;
  const std::int64_t ahead =
      std::max<std::int64_t>(backward ? ray.origin[m] - near : near - ray.origin[m], 0);
  if ((backward ? ray.origin[m] < far : far < ray.origin[m]) || ahead << bits.fraction > length)
    return std::nullopt;
  ObjectRay made;
  made.start_ = ahead << bits.fraction;
  const std::int64_t width = std::int64_t{box.max[m]} - box.min[m] + 1;
  Point from_move{};  // where the ray is, seen from tau, in units 2^-(g+j)
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t way = k == m ? (backward ? -ahead : ahead) << j
                                    : floored(static_cast<Int128>(ahead) * ray.direction[k], bits.slope - j);
    const std::int64_t place = (ray.origin[k] << j) + way;
    // Along no axis a ray moves more than along its major one.
    if (k != m && (place > (box.max[k] + width) << (g + j) || place < (box.min[k] - width) << (g + j)))
      return std::nullopt;
    from_move[k] = place - (std::int64_t{map.move[k]} << (g + j));
  }
  std::array<Int128, 3> fine{};  // in units 2^-(g+j+fn)
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      fine[k] += static_cast<Int128>(space.to_object[k][i]) * from_move[i];
      made.direction_[k] += space.to_object[k][i] * ray.direction[i];
    }
  for (int k = 1; k < 3; ++k)
    if (std::abs(made.direction_[static_cast<std::size_t>(k)]) >
        std::abs(made.direction_[static_cast<std::size_t>(made.major_)]))
      made.major_ = k;
  const auto major = static_cast<std::size_t>(made.major_);
  const auto size = static_cast<std::uint64_t>(std::abs(made.direction_[major]));
  // The second anchor: nearly where the ray comes to the object along the axis that is major there, never behind.
  const std::int64_t own = (std::int64_t{space.most[major]} << g) + space.slack[major];
  const auto forward = [&](std::int64_t x) { return made.direction_[major] < 0 ? -x : x; };
  const std::int64_t to_go = -own - forward(floored(fine[major], space.fraction + j)) - 1;
  if (to_go > 0) {
    const int up = static_cast<int>(std::bit_width(size)) + ObjectSpace::inverse_bits - 1;
    const Int128 inverse = (static_cast<Int128>(1) << up) / static_cast<Int128>(size);
    const Int128 steps = shifted(inverse * to_go, bits.slope + space.fraction + bits.fraction - up);
    if (steps > length - made.start_) return std::nullopt;
    made.start_ += static_cast<std::int64_t>(steps);
    for (std::size_t k = 0; k < 3; ++k)
      fine[k] += shifted(made.direction_[k] * steps, j - bits.slope - bits.fraction);
  }
  for (std::size_t k = 0; k < 3; ++k) made.origin_[k] = floored(fine[k], space.fraction + j);
  const std::int64_t at = forward(made.origin_[major]);
  if (at > own + 2) return std::nullopt;
  const std::int64_t way = 2 * own + std::max<std::int64_t>(0, -own - at) + 2;
  for (std::size_t k = 0; k < 3; ++k)
    if (k != major && std::abs(made.origin_[k]) > (std::int64_t{space.most[k]} << g) + space.slack[k] + way)
      return std::nullopt;
  made.factor_ = static_cast<std::int64_t>(size);
  made.down_ = bits.slope + space.fraction + bits.fraction + g;
  for (; made.factor_ >> ObjectSpace::factor_bits != 0; --made.down_) made.factor_ = (made.factor_ + 1) >> 1;
  return made;
}

IntMajorRay ObjectRay::operands(const hls::MajorBits& bits) const {
  IntMajorRay made;
  made.axes = {0, 1, 2};
  std::swap(made.axes[0], made.axes[static_cast<std::size_t>(major_)]);
  for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
    const auto axis = static_cast<std::size_t>(made.axes[ray_axis]);
    made.backward[ray_axis] = direction_[axis] < 0;
    made.origin[ray_axis] = direction_[axis] < 0 ? origin_[axis] + 1 : -origin_[axis];
    if (ray_axis > 0)
      made.quotient[ray_axis - 1] =
          quotient_of(static_cast<std::uint64_t>(std::abs(direction_[static_cast<std::size_t>(major_)])),
                      static_cast<std::uint64_t>(std::abs(direction_[axis])), bits);
  }
  return made;
}

std::int64_t ObjectRay::distance(std::int64_t t, int fraction, std::int64_t largest) const {
  const Int128 steps = static_cast<Int128>(t + 1 - start_) * factor_;
  return static_cast<std::int64_t>(std::min<Int128>(shifted(steps, fraction - down_), largest));
}

}  // namespace hitpipe::ref
