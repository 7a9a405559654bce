// The format of the machines around the units of the integer world: "n+gsSiI", for example 20+1s20i5, or
// "n+gsStFbBcCiIuU". The numbers before I are those of hls/world/world_format.hpp.
//   I  bits of a ray's number, 1..8: 2^I rays are in flight
//   U  bits of a triangle's number; not written: those of an image
#pragma once

#include "hls/world/world_format.hpp"

namespace hitpipe {
namespace hls {

/// Bits of a triangle's number in an image. All ones is no triangle.
constexpr int triangle_number_bits = 32;

struct CoreBits : WorldBits {
  static constexpr int most_ray_bits = 8;

  int ray = 5;                        ///< I
  int number = triangle_number_bits;  ///< U

  static constexpr FormatField fields[] = {
      WorldBits::fields[0],         WorldBits::fields[1],
      WorldBits::fields[2],         WorldBits::fields[3],
      WorldBits::fields[4],         WorldBits::fields[5],
      {"i", "I", 1, most_ray_bits}, {"u", "U", 4, triangle_number_bits, nullptr, true}};
  static constexpr const char* type = nullptr;

  constexpr int rays() const { return power_of_two(ray); }
  constexpr bool valid() const { return WorldBits::valid() && ray >= 1 && ray <= most_ray_bits; }
  friend constexpr bool operator==(const CoreBits& a, const CoreBits& b) {
    return static_cast<const WorldBits&>(a) == b && a.ray == b.ray && a.number == b.number;
  }
};

}  // namespace hls
}  // namespace hitpipe
