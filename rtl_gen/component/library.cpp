#include "rtl_gen/component/library.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

constexpr std::array<std::string_view, component_count> component_names{
    "latch",       "mux2",       "int_subtract",   "int_multiply",   "int_compare", "fp_subtract",
    "fp_multiply", "fp_compare", "fp_subtract_rz", "fp_multiply_rz", "gate",        "latch_enable"};

int tree_depth(int bits) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(bits - 1)));
}

/// The area is proportional to this.
std::int64_t area_measure(AreaLaw law, std::int64_t bits) {
  return law == AreaLaw::linear ? bits : bits * bits;
}

/// Dividend and divisor are not negative.
std::int64_t rounded_quotient(std::int64_t dividend, std::int64_t divisor) {
  return (dividend + divisor / 2) / divisor;
}

}  // namespace

bool Block::multiplies(int a, bool a_signed, int b, bool b_signed) const {
  const bool as_signed = a_signed || b_signed || !reads_unsigned;
  const int need_a = a + (as_signed && !a_signed ? 1 : 0);
  const int need_b = b + (as_signed && !b_signed ? 1 : 0);
  return std::max(need_a, need_b) <= width_a && std::min(need_a, need_b) <= width_b;
}

std::string_view component_name(Component component) {
  return component_names[static_cast<std::size_t>(component)];
}

Component component_called(std::string_view name) {
  const auto found = std::find(component_names.begin(), component_names.end(), name);
  if (found == component_names.end())
    throw std::invalid_argument(fmt::format("component {}: no library has it", name));
  return static_cast<Component>(found - component_names.begin());
}

const Library::Family& Library::found(Component component) const {
  if (!has(component)) {
    throw std::runtime_error(fmt::format("library {}: it has no {}", name_, component_name(component)));
  }
  return family(component);
}

bool Library::has(Component component) const {
  if (!chip_) return !family(component).cells.empty();
  switch (component) {
    case Component::int_multiply:
      return chip_->block.has_value();
    case Component::fp_subtract:
    case Component::fp_multiply:
    case Component::fp_compare:
    case Component::fp_subtract_rz:
    case Component::fp_multiply_rz:
    case Component::latch_enable:
      return false;  // floats are made of the chip's other parts, and each of its registers has an enable
    default:
      return true;
  }
}

Cell Library::on_chip(Component component, int bits) const {
  Cell cell{.bits = bits, .estimated = chip_->estimated};
  switch (component) {
    case Component::latch:
      cell.delay_ps = chip_->register_delay_ps;
      cell.taken.registers = bits;
      break;
    case Component::mux2:
      cell.delay_ps = chip_->mux_delay_ps;
      cell.taken.luts = chip_->mux_luts(bits);
      break;
    case Component::gate:
      cell.delay_ps = chip_->gate_delay_ps;
      cell.taken.luts = chip_->gate_luts(bits);
      break;
    case Component::int_multiply:
      cell.delay_ps = chip_->block->delay_ps;
      cell.stages = chip_->block->stages;
      cell.taken.blocks = 1;
      break;
    default:
      cell.delay_ps =
          component == Component::int_compare ? chip_->compare_delay(bits) : chip_->carry_delay(bits);
      cell.ripple_ps = chip_->carry_delay_ps_per_bit * bits;
      cell.taken.luts = chip_->carry_luts(bits);
      break;
  }
  return cell;
}

Cell Library::timing(Component component, int bits) const {
  const Family& rows = found(component);
  if (chip_) return on_chip(component, bits);
  for (const Cell& cell : rows.cells)
    if (cell.bits >= bits) return cell;
  Cell cell = rows.cells.back();
  switch (rows.above) {
    case Above::same:
      break;
    case Above::tree:
      // Rounded up: a longer tree is never faster.
      cell.delay_ps = (cell.delay_ps * tree_depth(bits) + tree_depth(cell.bits) - 1) / tree_depth(cell.bits);
      break;
    case Above::stages:
      cell.stages = (bits * cell.stages + cell.bits - 1) / cell.bits;
      break;
  }
  cell.estimated = true;
  return cell;
}

Cell Library::cell(Component component, int bits) const {
  const Family& rows = found(component);
  Cell cell = timing(component, bits);
  if (chip_ || cell.bits == bits) return cell;
  const auto above =
      std::find_if(rows.cells.begin(), rows.cells.end(), [bits](const Cell& row) { return row.bits > bits; });
  const auto measure = [&](int width) { return area_measure(rows.area, width); };
  std::int64_t area_um2 = 0;
  if (above == rows.cells.begin() || above == rows.cells.end()) {
    const Cell& end = above == rows.cells.begin() ? rows.cells.front() : rows.cells.back();
    area_um2 = rounded_quotient(end.area_um2 * measure(bits), measure(end.bits));
  } else {
    const Cell& below = *std::prev(above);
    const std::int64_t past = measure(bits) - measure(below.bits);
    const std::int64_t short_of = measure(above->bits) - measure(bits);
    area_um2 = rounded_quotient(below.area_um2 * short_of + above->area_um2 * past, past + short_of);
  }
  if (area_um2 > most_area_um2) {
    throw std::runtime_error(fmt::format("library {}: {}_{} would have {} um2, allowed are {}", name_,
                                         component_name(component), bits, area_um2, most_area_um2));
  }
  cell.bits = bits;
  cell.area_um2 = static_cast<int>(area_um2);
  cell.estimated = true;
  return cell;
}

bool is_component(Op op) {
  return op == Op::add || op == Op::sub || op == Op::mul || op == Op::less || op == Op::equal ||
         op == Op::mux || op == Op::call;
}

ComponentUse component_of(const Graph& graph, NodeId node) {
  const Node& n = graph[node];
  const auto operand = [&](std::size_t i) { return graph[n.args[i]].width; };
  switch (n.op) {
    case Op::add:  // the thesis lists only subtractors; an adder is the same carry tree
    case Op::sub:
      return {Component::int_subtract, n.width};
    case Op::mul:
      return {Component::int_multiply, std::max(operand(0), operand(1))};
    case Op::less:
    case Op::equal:
      return {Component::int_compare, operand(0)};
    case Op::mux:
      return {Component::mux2, n.width};
    case Op::call: {
      const Submodule& unit = *graph.submodule_of(node);
      return {component_called(unit.component), unit.bits};
    }
    default:
      throw std::logic_error(fmt::format("{} is not a component", op_name(n.op)));
  }
}

Cell timing_of(const Graph& graph, NodeId node, const Library& library) {
  const Node& n = graph[node];
  if (n.op == Op::mul) {
    // A square multiplier with a product of this width has a sum of the same length and at least as many
    // rows.
    const int bits = (graph[n.args[0]].width + graph[n.args[1]].width + 1) / 2;
    return library.timing(Component::int_multiply, bits);
  }
  if (is_component(n.op)) {
    const ComponentUse use = component_of(graph, node);
    Cell cell = library.timing(use.component, use.bits);
    const bool inverts = (n.op == Op::sub || n.op == Op::less) && graph[n.args[1]].op != Op::constant;
    if (library.chip() != nullptr && inverts) cell.subtrahend_ps = library.chip()->subtrahend_delay_ps;
    return cell;
  }
  return {.bits = graph[node].width, .delay_ps = library.gate_delay_ps()};
}

}  // namespace hitpipe::rtl
