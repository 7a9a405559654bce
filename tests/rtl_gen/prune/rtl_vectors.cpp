// The same with Verilator: at least 10^6 random vectors for each design, with gaps and stalls, of the fitted
// unit's Verilog against the unfitted C++: prune_rtl_vectors [VECTORS PER DESIGN]. The demand set is "all of
// these", and integer units have 20/24 bits.
#include <cstdlib>
#include <deque>
#include <exception>

#include <fmt/format.h>

#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "sim/verilated_design.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace {

using namespace hitpipe;

/// The graph that a design without a place in the catalogue is traced to.
const rtl::Graph* fitted_graph = nullptr;

rtl::Graph fitted() {
  return *fitted_graph;
}
rtl::Graph (*traced(rtl::Format))() {
  return fitted;
}

/// As the fitted unit's ports want them.
std::vector<std::int64_t> signed_operands(const rtl::Graph& graph,
                                          const std::vector<std::uint64_t>& operands) {
  std::vector<std::int64_t> numbers;
  for (const std::uint64_t each : operands) {
    const rtl::Node& port = graph[graph.inputs()[numbers.size()]];
    const std::uint64_t bits = each & rtl::all_bits(port.width);
    numbers.push_back(port.is_signed ? rtl::number_of(bits, port.width) : static_cast<std::int64_t>(bits));
  }
  return numbers;
}

bool run(const char* name, std::size_t vectors) {
  const rtl::Design& design = rtl::find_design(name);
  const rtl::Format format = design.default_format();
  const rtl::Demands demands = rtl::demand_sets(design, format).back().demands;
  const std::vector<rtl::Port> ports = rtl::input_ports(design.trace(format));
  const rtl::Graph graph = rtl::prune(design.trace(format), demands, {.shares = false}).graph;
  fitted_graph = &graph;
  rtl::Design unit = design;
  unit.traced = traced;
  const sim::VerilatedDesign verilated(unit, format, rtl::Library::thesis());
  sim::Model model(verilated);
  const rtl::Evaluate native = design.evaluate(format);
  const rtl::Draw draw(ports, demands);
  rtl::Seeded random(2011);

  struct Asked {
    bool hit;
    std::uint16_t tag;
  };
  std::deque<Asked> asked;
  std::size_t sent = 0;
  std::size_t received = 0;
  std::size_t hits = 0;
  std::vector<std::int64_t> operands = draw(random);
  const std::size_t most_cycles = 4 * vectors + 1000;
  for (std::size_t cycle = 0; cycle < most_cycles && received < vectors; ++cycle) {
    sim::Pins pins{.in_valid = sent < vectors && random.below(8) != 0,
                   .out_ready = random.below(8) != 0,
                   .in_tag = static_cast<std::uint16_t>(sent)};
    model.cycle(signed_operands(graph, rtl::operands_left(graph, ports, operands)).data(), pins);
    if (pins.out_valid && pins.out_ready) {
      if (asked.empty() || asked.front().hit != pins.hit || asked.front().tag != pins.out_tag) {
        fmt::print("{}: result {} is wrong: hit {} tag {:#x}\n", name, received, pins.hit, pins.out_tag);
        return false;
      }
      asked.pop_front();
      ++received;
    }
    if (!pins.in_valid || !pins.in_ready) continue;
    asked.push_back({native(operands.data()), pins.in_tag});
    hits += asked.back().hit ? 1 : 0;
    ++sent;
    operands = draw(random);
  }
  fmt::print("{} {}: {} vectors through the Verilog, {} hits\n", name, to_string(format), received, hits);
  return received >= vectors;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::size_t vectors = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
    bool all = true;
    for (const char* const name : {"int_slabs", "int_plucker", "fp_slabs", "fp_plucker"})
      all = run(name, vectors) && all;
    return all ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 1;
  }
}
