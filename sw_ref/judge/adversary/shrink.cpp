#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "rays/exact/binary32.hpp"
#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::ref::adversary {

namespace {

std::array<float*, 13> numbers_of(Case& c) {
  std::array<float*, 13> numbers{&c.ray.length};
  std::size_t at = 1;
  for (glm::vec3* v : {&c.ray.origin, &c.ray.direction, &c.box.min, &c.box.max}) {
    for (int axis = 0; axis < 3; ++axis) numbers[at++] = &(*v)[axis];
  }
  return numbers;
}

/// How complicated a number is: its significant mantissa bits plus the distance of its exponent from the
/// exponent of 1.
int complexity(float x) {
  if (x == 0 || std::isinf(x)) return std::signbit(x) ? 1 : 0;
  const Binary32 parts = decode(x);
  const int low = std::countr_zero(parts.mantissa);
  const int high = 31 - std::countl_zero(parts.mantissa);
  return 4 * (high - low) + std::abs(parts.exponent + high) + 2 + (parts.negative ? 1 : 0);
}

/// Simpler values to try, the simplest first.
std::vector<float> simpler_than(float x, bool may_be_infinite) {
  std::vector<float> values;
  if (may_be_infinite) values.push_back(Ray::infinite);
  for (const float v : {0.0F, 1.0F, -1.0F, 0.5F, -0.5F}) values.push_back(v);
  const auto bits = std::bit_cast<std::uint32_t>(x);
  for (int kept = 0; kept < 23; ++kept) {
    const std::uint32_t step = std::uint32_t{1} << (23 - kept);
    values.push_back(std::bit_cast<float>(bits & ~(step - 1)));
    values.push_back(std::bit_cast<float>((bits & ~(step - 1)) + step));
  }
  std::erase_if(values, [&](float v) { return std::isnan(v) || complexity(v) >= complexity(x); });
  return values;
}

}  // namespace

Case shrink(Case c, const std::function<bool(const Case&)>& fails) {
  for (bool simpler = true; simpler;) {
    simpler = false;
    for (std::size_t i = 0; i < numbers_of(c).size(); ++i) {
      for (const float value : simpler_than(*numbers_of(c)[i], i == 0)) {
        Case tried = c;
        *numbers_of(tried)[i] = value;
        if (!acceptable(tried.ray) || !acceptable(tried.box) || !fails(tried)) continue;
        c = tried;
        simpler = true;
        break;
      }
    }
  }
  return c;
}

}  // namespace hitpipe::ref::adversary
