// How far and how often the rays of a picture are followed.
#pragma once

#include <cstdint>

namespace hitpipe::ref {

struct WhittedOptions {
  static constexpr int most_bounces = 64;
  static constexpr int most_samples = 256;

  /// The most secondary rays in a row, 0..most_bounces. Further rays would bring no light.
  int bounces = 5;
  /// A secondary ray is not sent if each component of its weight is below the cutoff. Its light counts as
  /// dark. The parts of a material add up to 1 at most, so a pixel has at most 3 / cutoff rays of equal
  /// depth. With `diffuse` N the cutoff is divided by N, because N rays share the light of one.
  float cutoff = 1.0F / 256.0F;
  /// Secondary rays in random directions, 0..most_samples, from a surface that scatters light: so many where
  /// the eye's ray ends, and one where any later ray ends, so that their number grows with `bounces` and not
  /// with its power. They bring what other surfaces send. What comes from the sky is the ambient light, so a
  /// ray that leaves the scene brings nothing.
  int diffuse = 0;
  /// Shadow rays in random directions, 0..most_samples, from the same surfaces in the same numbers. Each that
  /// is blocked within `occlusion_reach` takes its share of the ambient light.
  int occlusion = 0;
  /// Of the random directions. They depend on it, the pixel's number and the rays before, and on nothing
  /// else.
  std::uint64_t seed = 1;
};

/// How far a surface takes ambient light from another, as a part of the longest side of the mesh.
inline constexpr double occlusion_reach = 0.125;

}  // namespace hitpipe::ref
