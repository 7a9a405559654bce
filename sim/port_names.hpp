// Ports of one axis by name, without the i that integer designs put before each.
#pragma once

#include <string>

namespace hitpipe::sim {

struct PortNames {
  std::string origin, direction, low, high;
};

[[nodiscard]] inline PortNames names_of(int axis) {
  const std::string x(1, "xyz"[axis]);
  return {"r" + x, std::string("r") + "ijk"[axis], x + "min", x + "max"};
}

}  // namespace hitpipe::sim
