// What tests give to the machines that feed the units: rays and blocks of random contents.
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hls/machines/pair_feed.hpp"
#include "hls/world/core_format.hpp"
#include "hls/world/ray_format.hpp"
#include "host/format.hpp"
#include "rays/image/core_image.hpp"
#include "rays/world/int_ray.hpp"
#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::sim::feeds {

using ref::CoreBlock;
using ref::PairChild;
using rtl::NamedPorts;
using rtl::Seeded;
using rtl::Word;

struct Kind {
  hls::RayBits bits;
  int address, ray;

  [[nodiscard]] int rays() const { return 1 << ray; }
  [[nodiscard]] hls::PairFeedBits pairs() const {
    return {bits.coord, bits.finer, bits.mantissa, bits.box_fraction, address, ray};
  }
  [[nodiscard]] hls::CoreBits triangles() const { return {bits.world(), ray}; }
};

inline std::int64_t signed_value(Seeded& random, int width) {
  return static_cast<std::int64_t>(rtl::number_of(random.value(width), width));
}

inline ref::IntRay any_ray(Seeded& random, const hls::WorldBits& bits) {
  ref::IntRay ray;
  ray.major = random.below(3);
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    ray.origin[axis] =
        std::clamp(signed_value(random, bits.point()), -bits.largest_point(), bits.largest_point());
    const auto size = std::min(static_cast<std::int64_t>(random.value(bits.slope + 1)), bits.one());
    ray.negative[axis] = random.flip();
    ray.direction[axis] = i == ray.major ? bits.one() : size >> random.below(bits.slope);
    if (ray.negative[axis]) ray.direction[axis] *= -1;
  }
  return ray;
}
inline CoreBlock any_record(Seeded& random, int coord, int address) {
  ref::CoreRecord record;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    record.boxes.planes.min[axis] = static_cast<std::int32_t>(signed_value(random, coord));
    record.boxes.planes.max[axis] = static_cast<std::int32_t>(signed_value(random, coord));
  }
  record.boxes.owners = static_cast<std::uint8_t>(random.below(64));
  record.pointer = static_cast<std::uint32_t>(random.value(address));
  for (std::int32_t& count : record.counts)
    count = random.between(PairChild::none, ref::CoreRecord::most_in_leaf);
  return to_block(record, coord);
}
inline CoreBlock any_triangle(Seeded& random, int coord) {
  ref::CoreTriangle triangle;
  for (ref::IntTriangle::Corner& corner : triangle.triangle.corners)
    for (std::int32_t& x : corner) x = static_cast<std::int32_t>(signed_value(random, coord));
  triangle.number = static_cast<std::uint32_t>(random.value(32));
  return to_block(triangle, coord);
}

/// A new ray on the ports that both machines have.
inline void show(const ref::IntRay& ray, const std::array<int, 3>& axes, NamedPorts& in) {
  in.put("ray_major_y", axes[0] == 1);
  in.put("ray_major_z", axes[0] == 2);
  constexpr const char* names[] = {"m", "a", "b"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(axes[i]);
    in.put(std::string("ray_back_") + names[i], ray.negative[axis]);
    in.put(std::string("ray_origin_") + names[i], ray.origin[axis]);
  }
}
inline void give(const CoreBlock& block, std::size_t ray, bool triangle, int ray_bits, NamedPorts& in) {
  in["read_id"] = ray | (triangle ? Word{1} << ray_bits : 0);
  for (std::size_t i = 0; i < block.size(); ++i) in["read_word_" + std::to_string(i)] = block[i];
}

/// Outputs that must be seen.
struct Expected {
  struct Port {
    std::string name;
    std::int64_t number;
  };
  std::vector<Port> ports;

  void equal(const NamedPorts& out) const {
    for (const Port& port : ports)
      ASSERT_EQ(static_cast<std::uint64_t>(out[port.name]),
                static_cast<std::uint64_t>(out.bits_of(port.name, port.number)))
          << port.name;
  }
};

inline constexpr const char* letters[] = {"x", "y", "z"};

/// Formats in which both feeds are tested.
inline const auto kinds =
    testing::Values(Kind{{}, 24, 5}, Kind{{16, 2, 9, -1, 14, 3}, 20, 3}, Kind{{24, 3, 14, 1, 24, 1}, 32, 8},
                    Kind{{8, 0, 4, 0, 8, 0}, 4, 1}, Kind{{24, 0, 32, 0, 32, 0}, 31, 4});
inline std::string name_of(const testing::TestParamInfo<Kind>& each) {
  return Format(each.param.bits).identifier();
}

}  // namespace hitpipe::sim::feeds
