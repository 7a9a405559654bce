// A port of a unit: what an operand is, as the design says it (hls/box/operand.hpp), or what is left of it in
// a graph.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hls/box/operand.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// From low to high, both included.
struct Interval {
  std::int64_t low;
  std::int64_t high;
  friend bool operator==(const Interval&, const Interval&) = default;
};

struct Port {
  std::string name;
  int width;  ///< 1..64
  bool is_signed;
  hls::Role role = hls::Role::other;
  hls::Axis axis = hls::Axis::none;
  int box = 0;                      ///< plane_low, plane_high: of which box
  std::optional<Interval> range{};  ///< the numbers that the set-up gives; nothing: not known
  std::optional<hls::Kind> kind{};  ///< how its bits are read; nothing: not known
  std::string comment{};            ///< for the reader of the Verilog; may be empty
};

[[nodiscard]] Port port_of(const hls::Operand& operand);
[[nodiscard]] std::vector<Port> result_ports(const std::vector<hls::Result>& results);
/// The numbers that its bits can stand for; any of std::int64_t for a port of 64 bits.
[[nodiscard]] Interval numbers_of(const Port& port);
/// What an operand tells the unit, in words: "lower plane, x; integer, -32767..32767".
[[nodiscard]] std::string description(const Port& operand);
[[nodiscard]] std::string description(const hls::Result& result);
/// 0 for x, 1 for y, 2 for z. The port must have an axis.
[[nodiscard]] constexpr int axis_of(const Port& port) {
  return static_cast<int>(port.axis) - static_cast<int>(hls::Axis::x);
}
/// The bits of all ports together.
[[nodiscard]] int total_width(const std::vector<Port>& ports);
/// A graph's inputs, in order, without their roles.
[[nodiscard]] std::vector<Port> input_ports(const Graph& graph);
/// Index of the named port, or nullopt.
[[nodiscard]] std::optional<std::size_t> index_of(const std::vector<Port>& ports, const std::string& name);
/// Index of the port with that role and axis (for planes: of box 0), or nullopt.
[[nodiscard]] std::optional<std::size_t> index_of(const std::vector<Port>& ports, hls::Role role,
                                                  hls::Axis axis = hls::Axis::none);

}  // namespace hitpipe::rtl
