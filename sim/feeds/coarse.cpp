#include "sim/feeds/coarse.hpp"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/port_names.hpp"

namespace hitpipe::sim {

namespace {

std::size_t place_of(const std::vector<rtl::Port>& ports, const std::string& name) {
  const std::size_t place = rtl::index_of(ports, name);
  if (place < ports.size()) return place;
  throw std::invalid_argument(fmt::format("coarse axes: there is no port {}; take an integer design", name));
}

struct Places {
  std::array<std::size_t, 3> origin{}, min{}, max{};

  explicit Places(const std::vector<rtl::Port>& ports) {
    for (int axis = 0; axis < 3; ++axis) {
      const PortNames names = names_of(axis);
      const auto i = static_cast<std::size_t>(axis);
      origin[i] = place_of(ports, "i" + names.origin);
      min[i] = place_of(ports, "i" + names.low);
      max[i] = place_of(ports, "i" + names.high);
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
