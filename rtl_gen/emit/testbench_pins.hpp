// What a testbench joins to the pins of a unit or of its outermost wrapper.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/verilog/module_interface.hpp"

namespace hitpipe::rtl {

/// The bits of each port in a word of `width` bits that holds them all, the last port lowest.
[[nodiscard]] std::vector<std::string> bits_of_ports(const std::string& word, const std::vector<Port>& ports,
                                                     int width);

/// Port names with what they are connected to.
using Wires = std::map<std::string, std::string>;

/// What stands behind ".": the pins of the outermost module, each with its wire.
struct Tested {
  std::string module;
  std::string test_pins, result_pins, data_pins;
  std::string wires;  ///< declarations beyond those of a unit
};

/// The wires of the operands. `width` is that of a vector.
[[nodiscard]] Wires wires_of(const std::vector<Port>& operands, int width);
/// `wires` are those of wires_of().
[[nodiscard]] Tested tested(const ModuleInterface& unit, const Wrappers& around, const Wires& wires);

}  // namespace hitpipe::rtl
