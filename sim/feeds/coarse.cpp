#include "sim/feeds/coarse.hpp"

#include <array>
#include <stdexcept>

namespace hitpipe::sim {

namespace {

std::size_t place_of(const std::vector<rtl::Port>& ports, hls::Role role, hls::Axis axis) {
  const auto place = rtl::index_of(ports, role, axis);
  if (place && ports[*place].is_signed) return *place;
  throw std::invalid_argument("coarse axes: origin or box is not an integer; take an integer design");
}

struct Places {
  std::array<std::size_t, 3> origin{}, min{}, max{};

  explicit Places(const std::vector<rtl::Port>& ports) {
    std::size_t i = 0;
    for (const hls::Axis axis : {hls::Axis::x, hls::Axis::y, hls::Axis::z}) {
      origin[i] = place_of(ports, hls::Role::origin, axis);
      min[i] = place_of(ports, hls::Role::plane_low, axis);
      max[i] = place_of(ports, hls::Role::plane_high, axis);
      ++i;
    }
  }
};

}  // namespace

OperandStep coarse_step(const std::vector<rtl::Port>& ports, const ref::CoarseAxes& coarse) {
  const Places at(ports);
  const int coord_bits = ports[at.origin[0]].width;
  ref::check_coarse(coarse, coord_bits, "coarse axes");
  return [at, coarse, coord_bits](std::int64_t* operands) {
    ref::IntOrigin origin{};
    ref::IntBox box;
    for (std::size_t i = 0; i < 3; ++i) {
      origin[i] = static_cast<std::int32_t>(operands[at.origin[i]]);
      box.min[i] = static_cast<std::int32_t>(operands[at.min[i]]);
      box.max[i] = static_cast<std::int32_t>(operands[at.max[i]]);
    }
    origin = ref::coarse_origin(origin, coarse, coord_bits);
    box = ref::coarse_box(box, coarse, coord_bits);
    for (std::size_t i = 0; i < 3; ++i) {
      operands[at.origin[i]] = origin[i];
      operands[at.min[i]] = box.min[i];
      operands[at.max[i]] = box.max[i];
    }
  };
}

}  // namespace hitpipe::sim
