#include "rtl_gen/catalogue/design.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

[[noreturn]] void no_such_format(const Design& design, Format format) {
  if (design.is_float()) {
    throw std::runtime_error(fmt::format("bits {}: {} computes in floats; its only format is {}",
                                         to_string(format), design.name, to_string(Format::fp32())));
  }
  throw std::runtime_error(fmt::format(
      "bits {}: no such format of {}; allowed is n/t with n in {}..{} and t in {}..2n-1", to_string(format),
      design.name, hls::IntBits::min_coord, hls::IntBits::max_coord, hls::IntBits::min_interval));
}

}  // namespace

Format Design::default_format() const {
  return is_float() ? Format::fp32() : Format(hls::IntBits{});
}

Format Design::parse_format(std::string_view text) const {
  if (text == to_string(Format::fp32())) {
    if (!is_float()) no_such_format(*this, Format::fp32());
    return Format::fp32();
  }
  const Format format = parse_bits(text);
  if (is_float()) no_such_format(*this, format);
  return format;
}

Graph Design::trace(Format format) const {
  const MakeGraph found = traced(format);
  if (found == nullptr) no_such_format(*this, format);
  return found();
}

Evaluate Design::evaluate(Format format) const {
  Evaluate found = native(format);
  if (found == nullptr) no_such_format(*this, format);
  return found;
}

std::vector<Port> input_ports(const Graph& graph) {
  std::vector<Port> ports;
  for (const NodeId id : graph.inputs())
    ports.push_back({graph[id].name, graph[id].width, graph[id].is_signed});
  return ports;
}

const Design& find_design(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Design& d : designs()) {
    if (d.name == name) return d;
    names.push_back(d.name);
  }
  throw std::runtime_error(fmt::format("design {}: unknown; there are: {}", name, fmt::join(names, ", ")));
}

std::size_t index_of(const std::vector<Port>& ports, const std::string& name) {
  const auto found = std::find_if(ports.begin(), ports.end(), [&](const Port& p) { return p.name == name; });
  return static_cast<std::size_t>(found - ports.begin());
}

}  // namespace hitpipe::rtl
