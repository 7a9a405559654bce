// The light of a pixel, summed in fixed point. The sum does not depend on the order of the terms, so tracers
// that finish rays in different orders give the same image, bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Linear red, green and blue in units of 2^-32. A sum that reaches 2^32 - 2^-32 stays there.
class LightSum {
 public:
  /// Each component is cut to [0, 2^31] (NaN: 0) and rounded down to a unit.
  void add(const glm::vec3& light) {
    for (int k = 0; k < 3; ++k) {
      const auto units = static_cast<std::uint64_t>(unit * double{cut(light[k])});
      std::uint64_t& sum = sums_[static_cast<std::size_t>(k)];
      constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
      sum = units > most - sum ? most : sum + units;
    }
  }

  /// The sum, with each component rounded to binary32 once.
  [[nodiscard]] glm::vec3 value() const {
    const auto linear = [](std::uint64_t sum) { return static_cast<float>(sum) / static_cast<float>(unit); };
    return {linear(sums_[0]), linear(sums_[1]), linear(sums_[2])};
  }

 private:
  static constexpr double unit = 0x1p32;

  static float cut(float x) {
    constexpr float most = 0x1p31F;
    return x > 0.0F ? (x < most ? x : most) : 0.0F;
  }

  std::array<std::uint64_t, 3> sums_{};
};

}  // namespace hitpipe::ref
