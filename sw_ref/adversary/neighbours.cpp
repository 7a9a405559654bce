#include "sw_ref/adversary/neighbours.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace hitpipe::ref::adversary {

namespace {

// Runs once a test of a billion: half a draw for all choices, no library call, no branch on a random bit.

/// `steps` binary32 values up or down; from a zero into the subnormals of that side.
float stepped(float x, int steps) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto magnitude = static_cast<std::int32_t>(bits & 0x7FFFFFFFU);
  const std::int32_t order = ((bits >> 31) != 0 ? -magnitude : magnitude) + steps;
  return std::bit_cast<float>(order < 0 ? static_cast<std::uint32_t>(-order) | 0x80000000U
                                        : static_cast<std::uint32_t>(order));
}

/// +-2^exponent, a normal number.
float power_of_two(int exponent, bool positive) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23 |
                              (positive ? 0 : 0x80000000U));
}

float chosen(bool first, float a, float b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return std::bit_cast<float>(first ? bits(a) : bits(b));
}

void set_plane(Aabb& box, std::size_t face, float value) {
  std::memcpy(reinterpret_cast<std::byte*>(&box) + sizeof(float) * face, &value, sizeof value);
}

/// 32 random bits choose the face, the way and the size. `made` is the box as yet; it is written only, as
/// reading what was just copied into it would wait.
void move_a_face(const Aabb& box, std::uint32_t choice, Aabb& made) {
  const std::uint32_t axis = (choice & 0xFFFFU) * 3 >> 16;
  const bool lower = (choice >> 16 & 1U) != 0;
  const bool up = (choice >> 17 & 1U) != 0;
  const auto size = static_cast<int>(choice >> 18 & 31U);
  const std::uint32_t face = axis + (lower ? 0 : 3);
  const std::uint32_t opposite = axis + (lower ? 3 : 0);
  const float by_ulps = stepped(box.plane(face), up ? size + 1 : -size - 1);
  const float by_distance = box.plane(face) + power_of_two(1 - size, up);
  const float moved = std::clamp(chosen(size < 4, by_ulps, by_distance), -1.0F, 1.0F);
  const float other = box.plane(opposite);
  const bool passed = chosen(lower, moved, other) > chosen(lower, other, moved);
  set_plane(made, face, moved);
  set_plane(made, opposite, chosen(passed, moved, other));
}

}  // namespace

void neighbours(Random& random, const Aabb& box, std::span<Aabb> out) {
  std::fill(out.begin(), out.end(), box);
  for (std::size_t i = 1; i < out.size(); i += 2) {
    const std::uint64_t draw = random.bits();
    move_a_face(box, static_cast<std::uint32_t>(draw), out[i]);
    if (i + 1 < out.size()) move_a_face(box, static_cast<std::uint32_t>(draw >> 32), out[i + 1]);
  }
}

}  // namespace hitpipe::ref::adversary
