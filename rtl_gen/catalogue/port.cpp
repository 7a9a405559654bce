#include "rtl_gen/catalogue/port.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

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
    ports.push_back({.name = result.name,
                     .width = result.width,
                     .is_signed = result.is_signed,
                     .comment = description(result)});
  return ports;
}

Interval numbers_of(const Port& port) {
  if (port.width == 64)
    return {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()};
  const int bits = port.is_signed ? port.width - 1 : port.width;
  const auto most = static_cast<std::int64_t>((std::uint64_t{1} << bits) - 1);
  return {port.is_signed ? -most - 1 : 0, most};
}

namespace {

std::string_view words_of(hls::Role role) {
  switch (role) {
    case hls::Role::origin:
      return "origin of the ray";
    case hls::Role::origin_high:
      return "upper bound of the ray's origin";
    case hls::Role::endpoint:
      return "end of the ray";
    case hls::Role::direction:
      return "direction of the ray";
    case hls::Role::inverse:
      return "reciprocal of the direction";
    case hls::Role::inverse_low:
      return "lower bound of a reciprocal";
    case hls::Role::inverse_high:
      return "upper bound of a reciprocal";
    case hls::Role::length:
      return "where the ray ends";
    case hls::Role::endless:
      return "1: the ray has no end";
    case hls::Role::plane_low:
      return "lower plane";
    case hls::Role::plane_high:
      return "upper plane";
    case hls::Role::exponent:
      return "exponent of the bounds of a reciprocal";
    case hls::Role::backward:
      return "1: the direction is negative";
    case hls::Role::entry:
      return "where the ray enters the parent";
    case hls::Role::owner:
      return "number of the box that has the plane";
    case hls::Role::major:
      return "1: the major axis";
    case hls::Role::corner:
      return "corner of the triangle";
    case hls::Role::other:
      return "of the design's own set-up";
  }
  throw std::logic_error("an operand without a role");
}

std::string_view words_of(hls::Kind kind) {
  switch (kind) {
    case hls::Kind::integer:
      return "integer";
    case hls::Kind::natural:
      return "natural";
    case hls::Kind::real:
      return "float";
    case hls::Kind::flag:
      return "flag";
  }
  throw std::logic_error("an operand without a kind");
}

}  // namespace

std::string description(const Port& operand) {
  std::string text(words_of(operand.role));
  if (operand.axis != hls::Axis::none) text += fmt::format(", {}", " xyz"[static_cast<int>(operand.axis)]);
  if (operand.role == hls::Role::corner) {
    text += fmt::format(", number {}", operand.box);
  } else if (operand.box > 0) {
    text += fmt::format(", box {}", operand.box);
  }
  if (!operand.kind) return text;
  text += fmt::format("; {}", words_of(*operand.kind));
  const bool has_numbers = *operand.kind == hls::Kind::integer || *operand.kind == hls::Kind::natural;
  if (has_numbers && operand.range) text += fmt::format(", {}..{}", operand.range->low, operand.range->high);
  return text;
}

std::string description(const hls::Result& result) {
  switch (result.meaning) {
    case hls::Meaning::hit:
      return fmt::format("1: the ray meets {} {}", result.object, result.box);
    case hls::Meaning::entry:
      return fmt::format("where the ray enters box {}", result.box);
    case hls::Meaning::exit:
      return fmt::format("where the ray leaves box {}", result.box);
    case hls::Meaning::order:
      return "1: the second box comes first";
    case hls::Meaning::determinant:
      return "determinant, high half";
    case hls::Meaning::determinant_low:
      return "determinant, low half";
    case hls::Meaning::volume:
      return "numerator of the distance, high half";
    case hls::Meaning::volume_low:
      return "numerator of the distance, low half";
    case hls::Meaning::edge_u:
      return "numerator of corner 1's weight, high half";
    case hls::Meaning::edge_u_low:
      return "numerator of corner 1's weight, low half";
    case hls::Meaning::edge_v:
      return "numerator of corner 2's weight, high half";
    case hls::Meaning::edge_v_low:
      return "numerator of corner 2's weight, low half";
    case hls::Meaning::error:
      return fmt::format("1: there is no such {}", result.object);
    case hls::Meaning::axis:
      return fmt::format("1: the major axis is {}", result.object);
    case hls::Meaning::back:
      return fmt::format("1: the direction is negative, ray axis {}", result.object);
    case hls::Meaning::origin:
      return fmt::format("origin, ray axis {}", result.object);
    case hls::Meaning::slope:
      return fmt::format("slope, ray axis {}", result.object);
    case hls::Meaning::mantissa_low:
      return fmt::format("lower bound of the slope's reciprocal, ray axis {}", result.object);
    case hls::Meaning::mantissa_high:
      return fmt::format("upper bound of the slope's reciprocal, ray axis {}", result.object);
    case hls::Meaning::exponent:
      return fmt::format("power of two for both bounds, ray axis {}", result.object);
    case hls::Meaning::length:
      return fmt::format("length of the {}", result.object);
    case hls::Meaning::tie:
      return "1: hit at an edge or a corner";
    case hls::Meaning::once:
      return "1: the hit counts as a crossing";
    case hls::Meaning::side:
      return "1: the determinant is negative";
    case hls::Meaning::zero:
      return "bits of u, v, e0; 1: it is 0";
    case hls::Meaning::inner:
      return "likewise; 1: its sign is that of the inside";
  }
  throw std::logic_error("a result without a meaning");
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
