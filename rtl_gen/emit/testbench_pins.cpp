#include "rtl_gen/emit/testbench_pins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/result_fifo.hpp"

namespace hitpipe::rtl {

namespace {

/// The bits of a word, or its only bit.
std::string part_of(const std::string& word, int high, int low) {
  return high == low ? fmt::format("{}[{}]", word, low) : fmt::format("{}[{}:{}]", word, high, low);
}

/// A beat of a stream: each port on a byte boundary, the first one lowest. Padding is 1, because nothing may
/// read it.
std::string beat(const std::vector<Port>& ports, const Wires& wires) {
  std::vector<std::string> parts;  // highest first
  for (const Port& port : ports) {
    parts.insert(parts.begin(), wires.at(port.name));
    const int padding = (8 - port.width % 8) % 8;
    if (padding > 0) parts.insert(parts.begin(), fmt::format("{{{}{{1'b1}}}}", padding));
  }
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<std::string> bits_of_ports(const std::string& word, const std::vector<Port>& ports, int width) {
  std::vector<std::string> all;
  for (const Port& port : ports) {
    all.push_back(part_of(word, width - 1, width - port.width));
    width -= port.width;
  }
  return all;
}

Wires wires_of(const std::vector<Port>& ports, int width) {
  Wires wires;
  const std::vector<std::string> operands = bits_of_ports("operands", ports, width);
  for (std::size_t i = 0; i < ports.size(); ++i) wires[ports[i].name] = operands[i];
  return wires;
}

Tested tested(const ModuleInterface& unit, const Wrappers& around, const Wires& wires) {
  const ModuleInterface inner = around.fifo ? fifo_interface(unit) : unit;
  const auto wire = [&](const Pin& pin) {
    if (pin.channel == tests_channel && pin.role == Pin::Role::tag) return std::string("sent[15:0]");
    const auto found = wires.find(pin.name);
    return found == wires.end() ? pin.name : found->second;
  };
  if (!around.axi_stream) {
    return {inner.module, inner.control_connections({"", tests_channel}, wire),
            inner.control_connections({results_channel}, wire), inner.data_connections(wire), ""};
  }
  const ModuleInterface stream = stream_interface(unit);
  std::vector<std::string> unused;
  std::string results = fmt::format("  wire [{}:0] result_beat;\n", stream_bits(unit.results()) - 1);
  for (const StreamField& field : stream_fields(unit.results())) {
    const int high = field.offset + field.width - 1;
    results += fmt::format("  assign {} = {};\n", field.name, part_of("result_beat", high, field.offset));
    if ((high + 1) % 8 != 0) unused.push_back(part_of("result_beat", (high / 8 + 1) * 8 - 1, high + 1));
  }
  if (!unused.empty())
    results += fmt::format("  wire unused = &{{1'b0, {}}};  // padding\n", fmt::join(unused, ", "));
  const auto stream_wire = [&](const Pin& pin) -> std::string {
    if (pin.role == Pin::Role::clock) return "clk";
    if (pin.role == Pin::Role::reset) return "~rst";
    if (pin.channel == "m_axis")
      return pin.role == Pin::Role::data  ? "result_beat"
             : pin.role == Pin::Role::tag ? "out_tag"
                                          : "out_" + pin.name.substr(sizeof("m_axis_t") - 1);
    if (pin.role == Pin::Role::data) return beat(inner.operands(), wires);
    if (pin.role == Pin::Role::tag) return "sent[15:0]";
    return "in_" + pin.name.substr(pin.channel.size() + 2);
  };
  return {stream.module, stream.control_connections({"", "s_axis"}, stream_wire),
          stream.control_connections({"m_axis"}, stream_wire), stream.data_connections(stream_wire), results};
}

}  // namespace hitpipe::rtl
