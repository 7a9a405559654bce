#include "rtl_gen/prune/promises.hpp"

#include <algorithm>
#include <optional>

namespace hitpipe::rtl {

namespace {

bool one_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* each) { return name == each; });
}

Interval up_to(std::int64_t magnitude) {
  return {-magnitude, magnitude};
}

std::optional<Interval> promise(const std::string& port, hls::IntBits bits) {
  const std::int64_t grid = std::int64_t{1} << (bits.coord - 2);
  if (one_of(port, {"irx", "iry", "irz", "irex", "irey", "irez"})) return up_to(grid - 1);
  if (one_of(port, {"ixmin", "ixmax", "iymin", "iymax", "izmin", "izmax"})) return up_to(grid);
  if (one_of(port, {"iri", "irj", "irk"}) || port.ends_with("_floor") || port.ends_with("_ceil"))
    return up_to(2 * grid - 1);
  if (port == "irlen")
    return Interval{0, static_cast<std::int64_t>((std::uint64_t{1} << (bits.interval - 1)) - 1)};
  return std::nullopt;
}

}  // namespace

Demands promises(const Design& design, Format format) {
  Demands all;
  if (design.is_float()) return all;  // any pattern may come: infinities, NaN, a zero of either sign
  for (const Port& port : input_ports(design.trace(format))) {
    if (const auto range = promise(port.name, format.bits())) all.ports.push_back({port.name, {*range}});
  }
  return all;
}

}  // namespace hitpipe::rtl
