#include "area_model/part.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

namespace hitpipe::area {

namespace {

using rtl::Component;

constexpr std::array<Component, rtl::component_count> table_7_1{
    Component::int_subtract, Component::int_multiply, Component::int_compare,    Component::fp_subtract,
    Component::fp_multiply,  Component::fp_compare,   Component::fp_subtract_rz, Component::fp_multiply_rz,
    Component::latch,        Component::latch_enable, Component::mux2,           Component::gate};

auto rank(const Part& part) {
  const auto row = std::find(table_7_1.begin(), table_7_1.end(), part.component) - table_7_1.begin();
  return std::tuple(part.purpose, row, part.bits, part.by);
}

}  // namespace

std::strong_ordering operator<=>(const Part& a, const Part& b) {
  return rank(a) <=> rank(b);
}

std::string part_name(const Part& part) {
  switch (part.purpose) {
    case Purpose::valid:
      return fmt::format("valid_{}", part.bits);
    case Purpose::tag:
      return fmt::format("tag_{}", part.bits);
    case Purpose::block:
      return fmt::format("block_latch_{}", part.bits);
    case Purpose::datapath:
      break;
  }
  if (part.by != 0) return fmt::format("{}_{}x{}", component_name(part.component), part.bits, part.by);
  return fmt::format("{}_{}", component_name(part.component), part.bits);
}

}  // namespace hitpipe::area
