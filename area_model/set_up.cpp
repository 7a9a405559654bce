#include "area_model/set_up.hpp"

#include "area_model/price.hpp"

namespace hitpipe::area {

namespace {

/// One step doubles the remainder and subtracts the divisor where it can. `start` loads both.
rtl::MachineGraph step_of(const Divisions& divisions) {
  const int wide = divisions.divisor_bits + 1;
  const int quotient_bits = divisions.quotient_bits;
  rtl::Graph graph("set_up_divider");
  const rtl::NodeId remainder = graph.input("remainder", divisions.divisor_bits, false);
  const rtl::NodeId divisor = graph.input("divisor", divisions.divisor_bits, false);
  const rtl::NodeId quotient = graph.input("quotient", quotient_bits, false);
  const rtl::NodeId start = graph.input("start", 1, false);
  const rtl::NodeId above = graph.input("above", divisions.divisor_bits, false);
  const rtl::NodeId below = graph.input("below", divisions.divisor_bits, false);
  const rtl::NodeId twice = graph.concat(remainder, graph.constant(1, 0));
  const rtl::NodeId difference = graph.binary(rtl::Op::sub, twice, graph.extend(divisor, wide, false));
  const rtl::NodeId smaller = graph.slice(difference, wide - 1, wide - 1);
  const rtl::NodeId left = graph.mux(smaller, graph.slice(twice, divisions.divisor_bits - 1, 0),
                                     graph.slice(difference, divisions.divisor_bits - 1, 0));
  const rtl::NodeId longer =
      graph.resize(graph.concat(quotient, graph.invert(smaller)), quotient_bits, false);
  graph.output("next_remainder", graph.mux(start, above, left));
  graph.output("next_divisor", graph.mux(start, below, divisor));
  graph.output("next_quotient", longer);
  return {.name = "set_up_divider",
          .state = {{"remainder", divisions.divisor_bits},
                    {"divisor", divisions.divisor_bits},
                    {"quotient", quotient_bits}},
          .inputs = {{"start", 1}, {"above", divisions.divisor_bits}, {"below", divisions.divisor_bits}},
          .outputs = {},
          .memories = {},
          .graph = std::move(graph)};
}

}  // namespace

DividerPrice divider_price(const Divisions& divisions, const rtl::Library& library) {
  const MachinePrice price = area::price(step_of(divisions), library);
  return {.clock_ps = price.clock_ps, .area_um2 = price.area_um2, .luts = price.taken.luts};
}

}  // namespace hitpipe::area
