#include "rtl_gen/catalogue/port.hpp"

#include <algorithm>
#include <limits>

namespace hitpipe::rtl {

Port port_of(const hls::Operand& operand) {
  return {.name = operand.name,
          .width = operand.width,
          .is_signed = operand.is_signed(),
          .role = operand.role,
          .axis = operand.axis,
          .box = operand.box,
          .range = Interval{operand.low, operand.high},
          .kind = operand.kind};
}

std::vector<Port> result_ports(const std::vector<hls::Result>& results) {
  std::vector<Port> ports;
  for (const hls::Result& result : results)
    ports.push_back({.name = result.name, .width = result.width, .is_signed = result.is_signed});
  return ports;
}

Interval numbers_of(const Port& port) {
  if (port.width == 64)
    return {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()};
  const int bits = port.is_signed ? port.width - 1 : port.width;
  const auto most = static_cast<std::int64_t>((std::uint64_t{1} << bits) - 1);
  return {port.is_signed ? -most - 1 : 0, most};
}

int total_width(const std::vector<Port>& ports) {
  int width = 0;
  for (const Port& p : ports) width += p.width;
  return width;
}

std::vector<Port> input_ports(const Graph& graph) {
  std::vector<Port> ports;
  for (const NodeId id : graph.inputs())
    ports.push_back({graph[id].name, graph[id].width, graph[id].is_signed});
  return ports;
}

namespace {

template <class IsWanted>
std::optional<std::size_t> index_if(const std::vector<Port>& ports, const IsWanted& is_wanted) {
  const auto found = std::find_if(ports.begin(), ports.end(), is_wanted);
  if (found == ports.end()) return std::nullopt;
  return static_cast<std::size_t>(found - ports.begin());
}

}  // namespace

std::optional<std::size_t> index_of(const std::vector<Port>& ports, const std::string& name) {
  return index_if(ports, [&](const Port& p) { return p.name == name; });
}

std::optional<std::size_t> index_of(const std::vector<Port>& ports, hls::Role role, hls::Axis axis) {
  return index_if(ports, [&](const Port& p) { return p.role == role && p.axis == axis && p.box == 0; });
}

}  // namespace hitpipe::rtl
