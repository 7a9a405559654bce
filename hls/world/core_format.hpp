// The format of the machines around the units of the integer world: "n+gsSiI", for example 20+1s20i5, or
// "n+gsStFbBiI". The numbers before I are those of hls/world/world_format.hpp.
//   I  bits of a ray's number, 1..8: 2^I rays are in flight
#pragma once

#include "hls/world/world_format.hpp"

namespace hitpipe {
namespace hls {

/// A format whose widths are known at run time.
struct CoreBits : WorldBits {
  static constexpr int most_ray_bits = 8;

  int ray = 5;  ///< I

  static constexpr FormatField fields[] = {WorldBits::fields[0], WorldBits::fields[1],
                                           WorldBits::fields[2], WorldBits::fields[3],
                                           WorldBits::fields[4], {"i", "I", 1, most_ray_bits}};
  static constexpr const char* type = "CoreFormat";

  constexpr int rays() const { return power_of_two(ray); }
  constexpr bool valid() const { return WorldBits::valid() && ray >= 1 && ray <= most_ray_bits; }
  friend constexpr bool operator==(const CoreBits& a, const CoreBits& b) {
    return static_cast<const WorldBits&>(a) == b && a.ray == b.ray;
  }
};

/// The same with widths known when the code is compiled: CoreFormat<20, 1, 20, 0, 0, 5> is 20+1s20i5.
template <int N, int G, int S, int Fraction, int Weights, int Ray>
struct CoreFormat : WorldFormat<N, G, S, Fraction, Weights> {
  static constexpr CoreBits bits{{N, G, S, Fraction, Weights}, Ray};
  static_assert(Ray >= 1 && Ray <= CoreBits::most_ray_bits, "there is no such format n+gsSiI");

  Width<Ray> ray{};

  constexpr operator CoreBits() const { return bits; }
};

/// Bits of a triangle's number. All ones is no triangle.
constexpr int triangle_number_bits = 32;

}  // namespace hls
}  // namespace hitpipe
