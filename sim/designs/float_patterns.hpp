// binary32 values as the ports of a float design take them: unsigned 32-bit patterns.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"

namespace hitpipe::sim {

using Patterns = std::array<std::uint32_t, 3>;

[[nodiscard]] inline std::uint32_t pattern(float x) {
  return std::bit_cast<std::uint32_t>(x);
}
[[nodiscard]] inline Patterns patterns(const glm::vec3& v) {
  return {pattern(v.x), pattern(v.y), pattern(v.z)};
}

struct PatternBox {
  Patterns min{};
  Patterns max{};

  PatternBox() = default;
  explicit PatternBox(const ref::Aabb& box) : min(patterns(box.min)), max(patterns(box.max)) {}
};

}  // namespace hitpipe::sim
