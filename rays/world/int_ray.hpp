// A ray of the integer world (docs/integer_world.md): where a binary32 ray becomes integers, by exact
// rounding. It is the last place at which anything is lost.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_major_ray.hpp"

namespace hitpipe::ref {

/// The points origin + T / 2^F direction / 2^S, 0 <= T <= length, in units of the origin's grid.
struct IntRay {
  std::array<std::int64_t, 3> origin{};     ///< by axis; -G 2^g..G 2^g
  std::array<std::int64_t, 3> direction{};  ///< by axis; -2^S..2^S, and 2^S or -2^S along the major axis
  std::array<bool, 3> negative{};           ///< by axis: the sign of the binary32, also where it became 0
  int major = 0;                            ///< axis of the largest |component|; ties go to the lower axis
  std::int64_t length = 0;                  ///< of T, 0..largest_distance()

  friend bool operator==(const IntRay&, const IntRay&) = default;
};

/// Origins and slopes are rounded to the nearest integer, ties up; the length is rounded down. Throws
/// std::out_of_range for an origin outside [-1, 1]^3, and std::invalid_argument for a direction that is not
/// finite or zero, for a length that is negative or NaN, and for a format that does not exist.
[[nodiscard]] IntRay int_ray(const Ray& ray, const hls::WorldBits& bits);

/// A ray of which int_ray() makes this one. It has no end; S is at most 23, and n+g at most 25, else it is one beside
/// it.
[[nodiscard]] Ray binary32_ray(const IntRay& ray, const hls::WorldBits& bits);

/// The same ray as operands of a unit with a major axis in the integer world: `bits` is n+g/pfFsS with the n,
/// g and S of the ray. The origin is negated, and where a slope is 0, both mantissas are 2^(p-1) with the
/// largest exponent.
[[nodiscard]] IntMajorRay major_ray(const IntRay& ray, const hls::MajorBits& bits);

/// T as a parameter of the binary32 ray: in units of its direction.
[[nodiscard]] double t_of_distance(std::int64_t t, const Ray& ray, const hls::WorldBits& bits);

/// A distance T in the units of a box distance, rounded down. The unit of T is 2^-F of the origin's unit.
[[nodiscard]] constexpr std::int64_t in_box_units(std::int64_t t, const hls::WorldBits& world,
                                                  const hls::MajorBits& bits) {
  return t >> (world.finer + world.fraction - bits.fraction);
}

}  // namespace hitpipe::ref
