#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "rtl_gen/emit/core_file.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/prune/demand_fields.hpp"
#include "rtl_gen/schematic/dot.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "sim/fit/fit.hpp"

namespace hitpipe::sim {

namespace {

constexpr int vector_count = 1000;
constexpr std::uint64_t vector_seed = 1;

/// Any operands, moved to where the demands want them.
std::vector<std::vector<std::int64_t>> demanded_vectors(const FittedUnit& unit) {
  auto vectors = rtl::operand_vectors(unit.ports, vector_count, vector_seed);
  std::mt19937_64 random(vector_seed);
  for (const rtl::PortDemand& demand : unit.demands.ports) {
    const auto port = std::find_if(unit.ports.begin(), unit.ports.end(),
                                   [&](const rtl::Port& p) { return p.name == demand.port; });
    const auto at = static_cast<std::size_t>(port - unit.ports.begin());
    for (auto& operands : vectors) {
      const rtl::Interval range =
          *rtl::multiples_in(demand.within[random() % demand.within.size()], demand.low_zeros);
      const auto numbers = static_cast<std::uint64_t>((range.high - range.low) >> demand.low_zeros) + 1;
      operands[at] = range.low + static_cast<std::int64_t>((random() % numbers) << demand.low_zeros);
    }
  }
  return vectors;
}

/// As rtl::vector_file() writes them: the ports that are left, first in the high bits, and HIT in bit 0.
std::string vector_text(const FittedUnit& unit, const std::vector<rtl::Port>& left) {
  const rtl::Evaluate evaluate = unit.design->evaluate(unit.format);
  std::string text;
  for (const std::vector<std::int64_t>& operands : demanded_vectors(unit)) {
    std::string bits;
    for (std::size_t i = 0; i < unit.ports.size(); ++i) {
      for (const rtl::Port& port : left) {
        if (port.name != unit.ports[i].name) continue;
        for (int bit = port.width - 1; bit >= 0; --bit) bits += (operands[i] >> bit & 1) != 0 ? '1' : '0';
      }
    }
    bits += evaluate(operands.data()) ? '1' : '0';
    bits.insert(0, (4 - bits.size() % 4) % 4, '0');
    for (std::size_t i = 0; i < bits.size(); i += 4)
      text += fmt::format("{:x}", std::stoi(bits.substr(i, 4), nullptr, 2));
    text += '\n';
  }
  return text;
}

}  // namespace

std::vector<rtl::File> fitted_files(const FittedUnit& unit, const rtl::Library& library) {
  const rtl::Design& design = *unit.design;
  const rtl::Pipeline& pipeline = unit.pipeline;
  if (unit.demands.empty()) return rtl::emit(design, unit.format, library, pipeline);
  const std::string name(design.name);
  const std::string bits = rtl::to_string(unit.format);
  const std::vector<rtl::Port> left = rtl::input_ports(pipeline.graph);
  const std::string verilog = rtl::to_verilog(pipeline, library, {.module_name = name, .bits = bits});
  const std::string title = fmt::format("{} {}, fitted: {} stages, {} ps", name, bits,
                                        pipeline.schedule.stages, pipeline.schedule.clock_ps);
  return {
      {name + ".v", rtl::with_check_block(verilog, rtl::check_block(name, unit.demands, unit.ports, left))},
      {name + "_check.v", rtl::check_module(name + "_check", unit.demands, unit.ports)},
      {name + ".json", rtl::with_demand_fields(rtl::manifest(design, unit.format, pipeline, library),
                                               unit.demands, unit.report)},
      {name + ".core", rtl::core_file(design, unit.format, false)},
      {name + ".dot", rtl::to_dot(pipeline, title)},
      {"tb/" + name + "_tb.v", rtl::testbench(design, left, vector_count)},
      {"tb/" + name + "_vectors.hex", vector_text(unit, left)}};
}

}  // namespace hitpipe::sim
