#include "rays/world/quick_crossing.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace hitpipe::ref {

namespace {

using Way = std::array<std::int64_t, 3>;

Way cross(const Way& p, const Way& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}
std::int64_t dot(const Way& p, const Way& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/// A side of the triangle is below 2^(n-1), a corner seen from the origin below 2^(n-1+g), and a direction is at most
/// 2^S. So a term of u or v is below 2^(2n-1+g+S), and the three terms of num are below 2^(3n+g). The numbers det 2^g,
/// u and v are at most 2^(2n+g+S). Three of these are added.
bool fit_64_bits(const hls::WorldBits& bits) {
  return 2 * bits.coord + bits.finer + bits.slope <= 61 && 3 * bits.coord + bits.finer <= 62;
}

}  // namespace

QuickCrossing::QuickCrossing(const hls::WorldBits& bits)
    : bits_(bits), distance_scale_(std::ldexp(1.0, bits.slope + bits.fraction)), fits_(fit_64_bits(bits)) {}

/// The test of Moeller and Trumbore, as hls/pipelines/int_triangle.hpp has it. A tie's `once` is not yet known.
std::optional<Crossing> QuickCrossing::in_64_bits(const IntRay& ray, const IntTriangle& triangle) const {
  Way first{}, second{}, from_corner{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t corner = triangle.corners[0][i];
    first[i] = triangle.corners[1][i] - corner;
    second[i] = triangle.corners[2][i] - corner;
    from_corner[i] = ray.origin[i] - (corner << bits_.finer);
  }
  const Way p = cross(ray.direction, second);
  const std::int64_t signed_det = dot(first, p);
  if (signed_det == 0) return std::nullopt;
  const std::int64_t sign = signed_det < 0 ? -1 : 1;
  const std::int64_t u = sign * dot(from_corner, p);
  if (u < 0) return std::nullopt;
  const Way q = cross(from_corner, first);
  const std::int64_t v = sign * dot(ray.direction, q);
  const std::int64_t det = sign * signed_det;
  const std::int64_t rest = (det << bits_.finer) - u - v;
  const std::int64_t num = sign * dot(second, q);
  if (v < 0 || rest < 0 || num < 0) return std::nullopt;
  // T is below 2^35, so the quotient of doubles is off by less than 1. What it leaves of 2^(S+F) num is less than two
  // det in size, and its bits are right although the number itself is longer.
  auto t = static_cast<std::int64_t>(static_cast<double>(num) / static_cast<double>(det) * distance_scale_);
  const auto left =
      static_cast<std::int64_t>((static_cast<std::uint64_t>(num) << (bits_.slope + bits_.fraction)) -
                                static_cast<std::uint64_t>(t) * static_cast<std::uint64_t>(det));
  t += left < 0 ? -1 : left >= det ? 1 : 0;
  if (t > ray.length) return std::nullopt;
  return Crossing{
      .t = t, .side = -static_cast<int>(sign), .tie = u == 0 || v == 0 || rest == 0, .once = true};
}

std::optional<std::int64_t> QuickCrossing::distance(const IntRay& ray, const IntTriangle& triangle) const {
  if (fits_) {
    const auto found = in_64_bits(ray, triangle);
    return found ? std::optional(found->t) : std::nullopt;
  }
  const auto found = int_crossing(ray, triangle, bits_);
  return found ? std::optional(found->t) : std::nullopt;
}

std::optional<Crossing> QuickCrossing::crossing(const IntRay& ray, const IntTriangle& triangle) const {
  if (!fits_) return crossing_of(ray, triangle, bits_);
  const auto found = in_64_bits(ray, triangle);
  return found && found->tie ? crossing_of(ray, triangle, bits_) : found;
}

}  // namespace hitpipe::ref
