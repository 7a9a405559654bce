// Conservative slabs of one ray and all children of a node at once. Their planes of a kind lie side by side,
// so the near ones are chosen by the signs of the direction once per ray, without mirroring a box.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include <glm/vec3.hpp>

#include "rays/mesh/ray.hpp"
#include "rays/trace/lanes.hpp"
#include "rays/trace/slabs.hpp"

namespace hitpipe::ref {

/// Four boxes or triangles in a vector. Another width is another such type.
struct FourLanes {
  using Floats = PackOf<float>::Type;
  using Mask = PackOf<float>::Mask;
  static constexpr std::size_t count = 4;

  /// Bit i: the comparison holds in lane i.
  static unsigned bits(const Mask& holds) {
#ifdef __SSE2__
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(holds)));
#else
    return static_cast<unsigned>((holds[0] & 1) | (holds[1] & 2) | (holds[2] & 4) | (holds[3] & 8));
#endif
  }
};

/// A ray in a space where it is known but for a slack. Coordinates are below 2^25 in size.
struct SlackRay {
  glm::vec3 ahead{0};      ///< the origin and the slack, rounded up
  glm::vec3 behind{0};     ///< the origin less the slack, rounded down
  glm::vec3 direction{0};  ///< rounded by 2^-24 at most
  float length = 0;
};

/// How distances are widened so that no box is missed.
enum class Widening : std::uint8_t {
  of_distances,  ///< each by a product and a difference: answers and distances of ConservativeSlabs
  of_inverses,   ///< once per ray: two operations a plane instead of four
};

/// Conservative as ConservativeSlabs is, for boxes and origins of coordinates up to 2^25. A component with a minus
/// has a negative inverse instead of a mirrored slab, which changes no rounding. Of two numbers the first is
/// taken only if the comparison holds, so a NaN is no constraint here either.
///
/// Widening::of_inverses multiplies by the inverse (1 - c) for near planes, c = 16 u, u = 2^-24, and by the
/// inverse for far ones. Let the exact ray be in the box at t*, 0 <= t* <= length. The factors of such a
/// product, a difference and an inverse, have three roundings at most, and neither underflows for 2^-100 <=
/// |d| <= 2^100. So with the exact distance t >= 0 of a plane the exact product is
///     at most t (1 + u)^3 (1 - c) <= t (1 - u)^3 for a near plane,   at least t (1 - u)^3 for a far one,
/// and if t < 0 it is not above 0. As near t <= t* <= far t, no product of a near plane is above one of a far
/// plane, or above t* and so the length, and none of a far plane is below 0. Rounding is monotone, also where
/// it underflows, so this order stays. A zero d, or one out of range, is as in ConservativeSlabs. Directions that are
/// themselves rounded by u have a rounding more: (1 + u)^4 (1 - c) <= (1 - u)^4, so the order stays too.
///
/// SlackRay: the exact ray is within its slack of the one that is given, by axis. Near planes are seen from so far ahead and
/// far ones from so far behind, both rounded outward, and the exact ray meets the box that lies between.
template <class Lanes, std::size_t width, Widening widening, class ItsRay = Ray>
class ChildSlabs {
 public:
  explicit ChildSlabs(const ItsRay& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool minus = std::signbit(ray.direction[axis]);
      const float size = slab_inverse<float>(ray.direction[axis]);
      const float inverse = minus ? -size : size;
      const auto low = static_cast<std::size_t>(axis);
      Slab& slab = slabs_[axis];
      slab.near = width * (minus ? low + 3 : low);
      slab.far = width * (minus ? low : low + 3);
      if constexpr (has_slack) {
        slab.near_origin = Floats{} + (minus ? ray.behind[axis] : ray.ahead[axis]);
        slab.origin = Floats{} + (minus ? ray.ahead[axis] : ray.behind[axis]);
      } else {
        slab.origin = Floats{} + ray.origin[axis];
      }
      slab.near_inverse = Floats{} + inverse * (at_once ? 1 - c : 1);
      slab.far_inverse = Floats{} + inverse;
    }
    cut(ray.length);
  }

  void cut(float length) {
    constexpr float longest = std::numeric_limits<float>::max();
    length_ = Floats{} + (length < longest ? length : longest);
  }

  /// Bit i: the ray may meet child i, and enters it no sooner than distances[i]. Children that the node lacks
  /// count as well.
  [[nodiscard]] unsigned enters(const std::array<std::array<float, width>, 6>& planes,
                                float* distances) const {
    static_assert(width % Lanes::count == 0);
    const float* const first = planes[0].data();
    unsigned entered = 0;
    for (std::size_t part = 0; part < width; part += Lanes::count) {
      Floats entry{};
      Floats exit = length_;
      for (const Slab& slab : slabs_) {
        Floats near = (load(first + slab.near + part) - near_origin(slab)) * slab.near_inverse;
        Floats far = (load(first + slab.far + part) - slab.origin) * slab.far_inverse;
        if constexpr (!at_once) {
          near = near * (1 - c) - least;
          far = far * (1 + c) + least;
        }
        entry = near > entry ? near : entry;
        exit = far < exit ? far : exit;
      }
      std::memcpy(distances + part, &entry, sizeof entry);
      entered |= Lanes::bits(entry <= exit) << part;
    }
    return entered;
  }

 private:
  using Floats = typename Lanes::Floats;
  static constexpr bool at_once = widening == Widening::of_inverses;
  static constexpr float c = 0x1p-20F;
  static constexpr float least = std::numeric_limits<float>::min();

  static constexpr bool has_slack = std::is_same_v<ItsRay, SlackRay>;

  struct OneOrigin {
    Floats origin;
  };
  struct TwoOrigins : OneOrigin {
    Floats near_origin;
  };
  struct Slab : std::conditional_t<has_slack, TwoOrigins, OneOrigin> {
    Floats near_inverse, far_inverse;
    std::size_t near, far;  ///< where its planes begin
  };
  static const Floats& near_origin(const Slab& slab) {
    if constexpr (has_slack) return slab.near_origin;
    return slab.origin;
  }

  static Floats load(const float* planes) {
    Floats loaded;
    std::memcpy(&loaded, planes, sizeof loaded);
    return loaded;
  }

  Slab slabs_[3];
  Floats length_;
};

}  // namespace hitpipe::ref
