#include "rtl_gen/verilog/module_interface.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

std::string connection(const Pin& pin, const ModuleInterface::Wire& wire) {
  return fmt::format(".{}({})", pin.name, wire(pin));
}

}  // namespace

std::string vector_range(int width) {
  return width == 1 ? "" : fmt::format("[{}:0] ", width - 1);
}

bool ModuleInterface::has_ready(std::string_view channel) const {
  return std::any_of(pins.begin(), pins.end(),
                     [&](const Pin& pin) { return pin.role == Pin::Role::ready && pin.channel == channel; });
}

std::vector<std::string> ModuleInterface::more_channels() const {
  std::vector<std::string> channels;
  for (const Pin& pin : pins)
    if (pin.role == Pin::Role::valid && pin.channel != tests_channel && pin.channel != results_channel)
      channels.push_back(pin.channel);
  return channels;
}

std::vector<Port> ModuleInterface::data(std::string_view channel) const {
  std::vector<Port> ports;
  for (const Pin& pin : pins)
    if (pin.role == Pin::Role::data && pin.channel == channel)
      ports.push_back({pin.name, pin.width, pin.is_signed});
  return ports;
}

std::string ModuleInterface::head() const {
  std::string list;
  bool has_tags = false;
  for (const Pin& pin : pins) {
    const bool is_tag = pin.width == Pin::tag_width;
    has_tags = has_tags || is_tag;
    list += fmt::format("  {} wire {}{}{}{}{}{}\n", pin.is_input ? "input " : "output",
                        pin.is_signed ? "signed " : "",
                        is_tag ? fmt::format("{} ", tag_range) : vector_range(pin.width), pin.name,
                        &pin == &pins.back() ? "" : ",", pin.comment.empty() ? "" : "  // ", pin.comment);
  }
  return fmt::format("module {} {}(\n{});\n", module, has_tags ? "#(\n  parameter TAG_BITS = 16\n) " : "",
                     list);
}

std::string ModuleInterface::control_connections(std::initializer_list<std::string_view> channels,
                                                 const Wire& wire) const {
  std::vector<std::string> list;
  for (const std::string_view channel : channels) {
    for (const Pin& pin : pins)
      if (pin.role != Pin::Role::data && pin.channel == channel) list.push_back(connection(pin, wire));
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

std::string ModuleInterface::data_connections(const Wire& wire) const {
  std::vector<std::string> list;
  for (const Pin& pin : pins)
    if (pin.role == Pin::Role::data) list.push_back("    " + connection(pin, wire));
  return fmt::format("{}", fmt::join(list, ",\n"));
}

std::string ModuleInterface::instance(const std::string& name, const std::string& tag_bits,
                                      const Wire& wire) const {
  std::string text = fmt::format("  {} #(.TAG_BITS({})) {} (\n    {},\n", module, tag_bits, name,
                                 control_connections({""}, wire));
  for (const std::string& channel : more_channels())
    text += fmt::format("    {},\n", control_connections({channel}, wire));
  if (has_ready(tests_channel)) {
    text += fmt::format("    {},\n    {},\n", control_connections({tests_channel}, wire),
                        control_connections({results_channel}, wire));
  } else {
    text += fmt::format("    {},\n", control_connections({tests_channel, results_channel}, wire));
  }
  return text + data_connections(wire) + "\n  );\n";
}

void add_data(std::vector<Pin>& pins, const std::string& channel, bool is_input,
              const std::vector<Port>& ports) {
  for (const Port& port : ports)
    pins.push_back({port.name, Pin::Role::data, channel, is_input, port.width, port.is_signed, port.comment});
}

ModuleInterface unit_interface(const std::string& module, const std::vector<Port>& operands,
                               const std::vector<Port>& results, FlowControl flow, int interval) {
  using Role = Pin::Role;
  std::vector<Pin> pins{{"clk", Role::clock, "", true},
                        {"rst", Role::reset, "", true},
                        {"in_valid", Role::valid, tests_channel, true},
                        {"in_ready", Role::ready, tests_channel, false},
                        {"in_tag", Role::tag, tests_channel, true, Pin::tag_width},
                        {"out_valid", Role::valid, results_channel, false},
                        {"out_ready", Role::ready, results_channel, true},
                        {"out_tag", Role::tag, results_channel, false, Pin::tag_width}};
  if (flow == FlowControl::none)
    std::erase_if(pins,
                  [&](const Pin& pin) { return pin.role == Role::ready && (pin.is_input || interval == 1); });
  add_data(pins, tests_channel, true, operands);
  add_data(pins, results_channel, false, results);
  return {module, std::move(pins), interval};
}

void check_names(const ModuleInterface& wrapper, const ModuleInterface& unit,
                 std::initializer_list<std::string_view> inside) {
  for (const Pin& pin : unit.pins) {
    if (pin.role != Pin::Role::data) continue;
    const auto same = [&](const Pin& own) { return own.name == pin.name; };
    if (std::count_if(wrapper.pins.begin(), wrapper.pins.end(), same) > 1 || pin.name == "TAG_BITS" ||
        std::find(inside.begin(), inside.end(), pin.name) != inside.end())
      throw std::runtime_error(
          fmt::format("{}: its port {} has the name of one of {}", unit.module, pin.name, wrapper.module));
  }
}

}  // namespace hitpipe::rtl
