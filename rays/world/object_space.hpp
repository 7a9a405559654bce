// The space of an instance's mesh, to which a ray goes so that the boxes of the mesh can be tested as they are
// (docs/instances.md). Only culling uses it: triangles are tested in the world. So the ray's matrix N need not be the
// inverse of A: whatever N is, the slack e says how far the ray may be from a hit there.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "rays/world/grid_map.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_major_ray.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

/// What is made of an instance once.
struct ObjectSpace {
  static constexpr int coefficient_bits = 14;  ///< of N, with sign
  static constexpr int most_fraction = 40;
  static constexpr int guard_bits = 2;     ///< j, of the anchor below the unit of the origin's grid
  static constexpr int factor_bits = 8;    ///< of what turns T into a distance in the object
  static constexpr int inverse_bits = 12;  ///< of the inverse that moves the origin to the object

  std::array<std::array<std::int32_t, 3>, 3> to_object{};  ///< N; the ray's matrix is N / 2^fn
  int fraction = 0;                                        ///< fn, 0..40
  std::array<std::int32_t, 3> most{};                      ///< of the mesh: |coordinate| by axis
  std::array<std::int64_t, 3> slack{};                     ///< e by axis, in units of the origin's grid
  IntBox box;                                              ///< in the world; holds all corners
};

/// `box` holds the corners of the mesh in the world, and `most` those of the mesh, by |coordinate|. e is the least that
/// the proof gives for N. N is made so small that no difference in the object leaves n+g bits; so culling is worse
/// where a mesh fills its grid, and answers are the same. Throws std::out_of_range if there is no such N: for corners up
/// to 2^(n-5) there is one, and for nearly all maps up to 2^(n-3).
[[nodiscard]] ObjectSpace object_space(const GridMap& map, const std::array<std::int32_t, 3>& most,
                                       const IntBox& box, const hls::WorldBits& bits);

/// e of this N: what is rounded of a corner and of the ray, and what N A is beside the identity.
[[nodiscard]] std::array<std::int64_t, 3> slack_of(const ObjectSpace& space, const GridMap& map,
                                                   const hls::WorldBits& bits);

/// A ray in an object. It is there at T = start, and no hit in the instance is before.
class ObjectRay {
 public:
  /// Nothing: the ray meets nothing in the instance up to T = length.
  [[nodiscard]] static std::optional<ObjectRay> enter(const ObjectSpace& space, const GridMap& map,
                                                      const IntRay& ray, std::int64_t length,
                                                      const hls::WorldBits& bits);

  /// In units of the origin's grid; by axis, as the others.
  [[nodiscard]] const std::array<std::int64_t, 3>& origin() const { return origin_; }
  /// N D, so of any length.
  [[nodiscard]] const std::array<std::int64_t, 3>& direction() const { return direction_; }
  [[nodiscard]] int major() const { return major_; }
  [[nodiscard]] std::int64_t start() const { return start_; }
  /// Operands of int_major; near planes are to be seen from origin + e, far ones from origin - e.
  [[nodiscard]] IntMajorRay operands(const hls::MajorBits& bits) const;
  /// Not below the distance in the object along its major axis at which a hit at T can be, which lies below T + 1.
  /// In units of 2^-`fraction` of the grid; at most `largest`.
  [[nodiscard]] std::int64_t distance(std::int64_t t, int fraction, std::int64_t largest) const;

 private:
  std::array<std::int64_t, 3> origin_{};
  std::array<std::int64_t, 3> direction_{};
  int major_ = 0;
  std::int64_t start_ = 0;   ///< T0
  std::int64_t factor_ = 0;  ///< q, a unit of T in units 2^-down of the object's grid, rounded up
  int down_ = 0;
};

}  // namespace hitpipe::ref
