// What a ray of a list is answered, and where it meets the triangle that the answer names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "rays/scene/scene.hpp"
#include "rays/world/int_scene.hpp"
#include "sim/operands/ray_list.hpp"

namespace hitpipe::sim {

/// Where a ray meets a triangle, by exact arithmetic. All but the number is missing where it does not meet it.
struct Meeting {
  std::uint32_t number = 0;          ///< the triangle's place in the scene's file
  std::uint32_t face = 0;            ///< of the file, that the triangle is part of
  std::optional<std::int64_t> t{};   ///< T of the integer world
  std::optional<double> distance{};  ///< as a length of the file: the point is origin + distance * direction
  std::optional<std::array<double, 3>> weights{};  ///< of the corners
};

/// Nothing where `triangle`, a place in the scene's mesh, is ref::Hit::none.
[[nodiscard]] std::optional<Meeting> meeting(const ref::Scene& scene, const AskedRay& asked,
                                             std::uint32_t triangle);
[[nodiscard]] std::optional<Meeting> meeting(const ref::IntScene& scene, const AskedRay& asked,
                                             std::uint32_t triangle);
/// The same for a triangle by its number in the file; nothing if the scene does not have it.
[[nodiscard]] std::optional<Meeting> meeting_of_number(const ref::IntScene& scene, const AskedRay& asked,
                                                       std::uint32_t number);
/// What hardware gave: any number, and a T.
[[nodiscard]] Meeting meeting_at(const ref::IntScene& scene, const AskedRay& asked, std::uint32_t number,
                                 std::int64_t t);

struct Answer {
  bool given = true;               ///< false: a core gave the ray up
  std::optional<Meeting> found{};  ///< nothing: no triangle
  std::optional<Meeting> exact{};  ///< what exact arithmetic finds in this world
};

/// The answer that names triangle `found`, where exact arithmetic finds triangle `exact`.
template <class Scene>
[[nodiscard]] Answer answer_of(const Scene& scene, const AskedRay& asked, std::uint32_t found,
                               std::uint32_t exact) {
  return {.found = meeting(scene, asked, found), .exact = meeting(scene, asked, exact)};
}

}  // namespace hitpipe::sim
