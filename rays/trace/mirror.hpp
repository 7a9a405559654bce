// Mirrors rays and boxes so that the direction is (+, +, +). Mirroring is exact, so one body of code serves
// the eight ray classes of section 3.3. Rays of one class have the same mirror, so a bundle uses it once per
// box.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/trace/lanes.hpp"

namespace hitpipe::ref {

/// A box whose axes are mirrored so that the ray meets the near planes first. The fourth lanes are 0 and 1.
template <class T>
struct MirroredBox {
  Lanes<T> near, far;
};

class Mirror {
 public:
  explicit Mirror(const glm::vec3& direction) {
    for (int axis = 0; axis < 3; ++axis) minus_[axis] = std::signbit(direction[axis]) ? -1 : 0;
  }

  /// The planes of a box. A minus on an axis swaps min and max and changes their signs.
  template <class T>
  [[nodiscard]] MirroredBox<T> operator()(const BasicAabb<T>& box) const {
    static_assert(sizeof box == 6 * sizeof(T), "six coordinates in a row");
    const auto* const at = reinterpret_cast<const std::byte*>(&box);
    LaneMask<T> min;  // and x of max
    LaneMask<T> max;
    std::memcpy(&min, at, sizeof min);
    if constexpr (sizeof(T) == sizeof(float)) {
      // y and z of max are loaded separately: a load across the two halves of a box just decoded would wait
      // for both stores.
      using Words = std::int64_t __attribute__((vector_size(16)));
      std::int64_t rest;
      std::memcpy(&rest, at + 4 * sizeof(T), sizeof rest);
      max.packs[0] = __builtin_shufflevector(
          min.packs[0], std::bit_cast<typename LaneMask<T>::Pack>(Words{rest, 0}), 3, 4, 5, 3);
    } else {
      std::memcpy(&max, at + 2 * sizeof(T), sizeof max);
      max = rotated(max);
    }
    const LaneMask<T> minus = mask<T>();
    const LaneMask<T> change = ((min ^ max) & minus) ^ (minus & bits(Lanes<T>(-T(0), -T(0), -T(0), -T(0))));
    return {Lanes<T>((min ^ change) & axes<T>()),
            Lanes<T>(((max ^ change) & axes<T>()) | bits(Lanes<T>(0, 0, 0, 1)))};
  }

  /// A point or direction.
  [[nodiscard]] glm::vec3 operator()(const glm::vec3& v) const {
    return {minus_[0] ? -v.x : v.x, minus_[1] ? -v.y : v.y, minus_[2] ? -v.z : v.z};
  }

 private:
  using Mask = LaneMask<float>::Pack;

  template <class T>
  static LaneMask<T> bits(const Lanes<T>& lanes) {
    return std::bit_cast<LaneMask<T>>(lanes);
  }
  template <class T>
  static LaneMask<T> axes() {
    using Wide = typename LaneMask<T>::Pack;
    if constexpr (sizeof(T) == sizeof(float)) {
      return {{Wide{-1, -1, -1, 0}}};
    } else {
      return {{Wide{-1, -1}, Wide{-1, 0}}};
    }
  }
  /// minus_, as wide as T.
  template <class T>
  [[nodiscard]] LaneMask<T> mask() const {
    if constexpr (sizeof(T) == sizeof(float)) {
      return {{minus_}};
    } else {
      using Wide = typename LaneMask<T>::Pack;
      return {{reinterpret_cast<Wide>(arranged<0, 0, 1, 1>(minus_)),
               reinterpret_cast<Wide>(arranged<2, 2, 3, 3>(minus_))}};
    }
  }

  Mask minus_{};  ///< all bits of the lanes in which the direction has a minus
};

}  // namespace hitpipe::ref
