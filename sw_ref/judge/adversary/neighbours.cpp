#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::ref::adversary {

namespace {

// This runs for each of a billion tests. So half a random draw serves all choices, there is no library call
// and no branch on a random bit, and the compiler can treat many boxes at a time.

constexpr std::size_t at_a_time = 16;
template <class T>
using Each = std::array<T, at_a_time>;

/// All ones if the condition holds, otherwise 0.
std::uint32_t mask(bool condition) {
  return condition ? ~std::uint32_t{0} : 0;
}
std::uint32_t chosen(std::uint32_t first, std::uint32_t a, std::uint32_t b) {
  return (a & first) | (b & ~first);
}
float chosen(std::uint32_t first, float a, float b) {
  return std::bit_cast<float>(
      chosen(first, std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b)));
}

/// The value `steps` binary32 values up or down; from a zero into the subnormals of that side.
float stepped(float x, std::uint32_t steps) {
  constexpr std::uint32_t sign = 0x80000000U;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t magnitude = bits & ~sign;
  const std::uint32_t order = chosen(mask(bits >= sign), 0U - magnitude, magnitude) + steps;
  return std::bit_cast<float>(chosen(mask(order >= sign), (0U - order) | sign, order));
}

/// What 32 random bits choose: a face and its move.
struct Moves {
  Each<std::uint32_t> face{};
  Each<std::uint32_t> opposite{};
  Each<float> moved{};
  Each<float> opposite_moved{};
};

void choose(const Each<std::uint32_t>& choices, const Aabb& box, Moves& moves) {
  for (std::size_t i = 0; i < at_a_time; ++i) {
    const std::uint32_t choice = choices[i];
    const std::uint32_t axis = (choice & 0xFFFFU) * 3 >> 16;
    const std::uint32_t lower = 0U - (choice >> 16 & 1U);
    const std::uint32_t up = 0U - (choice >> 17 & 1U);
    const std::uint32_t size = choice >> 18 & 31U;
    const std::uint32_t is_x = mask(axis == 0);
    const std::uint32_t is_y = mask(axis == 1);
    const float low = chosen(is_x, box.min.x, chosen(is_y, box.min.y, box.min.z));
    const float high = chosen(is_x, box.max.x, chosen(is_y, box.max.y, box.max.z));
    const float from = chosen(lower, low, high);
    const float other = chosen(lower, high, low);
    const float by_ulps = stepped(from, chosen(up, size + 1, 0U - size - 1));
    const auto distance = std::bit_cast<float>((128 - size) << 23 | (~up & 0x80000000U));  // +-2^(1 - size)
    float moved = chosen(mask(size < 4), by_ulps, from + distance);
    moved = moved < -1.0F ? -1.0F : moved;
    moved = moved > 1.0F ? 1.0F : moved;
    const std::uint32_t passed = mask(chosen(lower, moved, other) > chosen(lower, other, moved));
    moves.face[i] = axis + (~lower & 3U);
    moves.opposite[i] = axis + (lower & 3U);
    moves.moved[i] = moved;
    moves.opposite_moved[i] = chosen(passed, moved, other);
  }
}

void set_plane(Aabb& box, std::size_t face, float value) {
  std::memcpy(reinterpret_cast<std::byte*>(&box) + sizeof(float) * face, &value, sizeof value);
}

}  // namespace

void neighbours(Random& random, const Aabb& box, std::span<Aabb> out) {
  std::fill(out.begin(), out.end(), box);
  for (std::size_t first = 1; first < out.size(); first += at_a_time) {
    Each<std::uint32_t> choices;
    for (std::size_t i = 0; i < at_a_time; i += 2) {
      const std::uint64_t draw = random.bits();
      choices[i] = static_cast<std::uint32_t>(draw);
      choices[i + 1] = static_cast<std::uint32_t>(draw >> 32);
    }
    Moves moves;
    choose(choices, box, moves);
    const std::size_t made = std::min(at_a_time, out.size() - first);
    for (std::size_t i = 0; i < made; ++i) {
      set_plane(out[first + i], moves.face[i], moves.moved[i]);
      set_plane(out[first + i], moves.opposite[i], moves.opposite_moved[i]);
    }
  }
}

}  // namespace hitpipe::ref::adversary
