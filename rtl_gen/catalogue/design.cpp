#include "rtl_gen/catalogue/design.hpp"

#include <charconv>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

std::string allowed_bits() {
  return fmt::format("n/t with n in {}..{} and t in {}..2n-1", hls::IntBits::min_coord,
                     hls::IntBits::max_coord, hls::IntBits::min_interval);
}

[[noreturn]] void no_such_format(std::string_view design, hls::IntBits bits) {
  throw std::runtime_error(
      fmt::format("bits {}: no such format of {}; allowed is {}", to_string(bits), design, allowed_bits()));
}

}  // namespace

Graph Design::trace(hls::IntBits bits) const {
  Graph (*const found)() = traced(bits);
  if (found == nullptr) no_such_format(name, bits);
  return found();
}

Evaluate Design::evaluate(hls::IntBits bits) const {
  const Evaluate found = native(bits);
  if (found == nullptr) no_such_format(name, bits);
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

hls::IntBits parse_bits(std::string_view text) {
  hls::IntBits bits{.coord = 0, .interval = 0};
  const char* const end = text.data() + text.size();
  const auto [slash, bad_coord] = std::from_chars(text.data(), end, bits.coord);
  bool good = bad_coord == std::errc{} && slash != end && *slash == '/';
  if (good) {
    const auto [rest, bad_interval] = std::from_chars(slash + 1, end, bits.interval);
    good = bad_interval == std::errc{} && rest == end;
  }
  if (!good || !bits.valid()) {
    throw std::runtime_error(fmt::format("bits {}: allowed is {}, for example 20/24", text, allowed_bits()));
  }
  return bits;
}

std::string to_string(hls::IntBits bits) {
  return fmt::format("{}/{}", bits.coord, bits.interval);
}

}  // namespace hitpipe::rtl
