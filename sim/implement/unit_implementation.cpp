#include "sim/implement/unit_implementation.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/implement/shift_harness.hpp"
#include "sim/implement/synthesis.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::sim {

namespace {

constexpr const char* unit_clock = "clk";

/// The unit as the counted netlist has it, between shift registers. Returns the netlist's name.
std::string synthesise_harness(const Target& target, const Synthesis& unit, const Tool& yosys,
                               const Workbench& bench) {
  const std::string top = harness_module(unit.top);
  const std::string netlist = top + ".json";
  bench.put_and_keep(
      {top + ".v", shift_harness(unit.top, unit_clock, ports_of_netlist(bench.read(unit.json()), unit.top))});
  // While it is a black box, its cells stay as they are.
  const std::string script = fmt::format(
      "read_json {}\nsetattr -mod -set blackbox 1 {}\nread_verilog {}.v\n{}"
      "setattr -mod -unset blackbox ={}\nflatten\nopt_clean -purge\nwrite_json {}\n",
      unit.json(), unit.top, top, synthesis_lines(target, top), unit.top, netlist);
  bench.put_and_keep({top + ".ys", script});
  bench.run(yosys, {"-s", top + ".ys"}, top + ".log");
  return netlist;
}

void place(Implementation& result, const Target& target, const ImplementOptions& options,
           const ChipTools& tools, const Workbench& bench) {
  options.progress("packing");
  for (const ResourceCount& count : pack(target, result.synthesis, *tools.nextpnr, bench))
    result.counts.push_back(count);
  if (!result.excess().empty() || options.seeds == 0) return;
  result.placed = place_and_route(
      target,
      {.top = harness_module(result.module),
       .netlist = synthesise_harness(target, result.synthesis, tools.yosys, bench),
       .clock = unit_clock,
       .seeds = options.seeds,
       .progress =
           [&](int seed) { options.progress(fmt::format("placing, seed {} of {}", seed, options.seeds)); }},
      *tools.nextpnr, bench);
  if (!result.placed->seeds.empty()) result.critical_path_ns = 1000 / result.placed->median().fmax_mhz;
}

}  // namespace

const ResourceCount* Implementation::count_of(std::string_view resource) const {
  const auto found = std::find_if(counts.begin(), counts.end(),
                                  [&](const ResourceCount& count) { return count.name == resource; });
  return found == counts.end() ? nullptr : &*found;
}

std::string Implementation::excess() const {
  std::vector<std::string> beyond;
  for (const ResourceCount& count : counts)
    if (!count.fits()) beyond.push_back(count.text());
  return fmt::format("{}", fmt::join(beyond, ", "));
}

std::optional<double> Implementation::fmax_mhz() const {
  if (!critical_path_ns) return std::nullopt;
  return 1000 / *critical_path_ns;
}

Implementation implement_unit(const rtl::Design& design, const rtl::Format& format, const Target& target,
                              const ImplementOptions& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const rtl::Library library =
      rtl::library_called(options.library.empty() ? target.library : options.library);
  const ChipTools tools = find_chip_tools(target);
  std::optional<SimulatorTools> simulator;
  if (options.simulate) {
    check_models(target);
    simulator = find_simulator(options.simulator);
  }
  // Made before the long run, so that a folder that cannot be written is reported at once.
  const Workbench bench(options.folder / target.name);

  options.progress("writing the unit");
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(design.trace(format), library, options.clock_ps, options.interval);
  const rtl::VectorSet vectors = design_vectors(
      design, format, static_cast<std::size_t>(options.simulate.value_or(usual_vectors)), options.seed);
  const rtl::EmittedDesign emitted =
      rtl::emit(design, format, library, pipeline,
                {.module = options.module, .flow_control = options.flow_control, .vectors = &vectors});
  const bool drawn = rtl::write_unit(bench.kept(), emitted).drawn;

  options.progress("synthesising");
  Implementation result{
      .module = emitted.module,
      .library = library.name(),
      .latency = pipeline.latency(),
      .synthesis = synthesise(target, {emitted.module, {emitted.verilog}}, tools.yosys, bench),
      .counts = {},
      .tools = {tools.yosys.release()},
      .drawn = drawn};
  result.counts = result.synthesis.counts;
  if (simulator) {
    options.progress("simulating the netlist");
    const bool dumps = tools.sta && simulator->simulator == Simulator::icarus;
    result.simulated = simulate_netlist(target, result.synthesis, {emitted.testbench, emitted.vectors, dumps},
                                        *simulator, tools.yosys, bench);
    if (dumps && result.simulated->agrees) {
      options.progress("counting toggles");
      result.energy = energy_of(target, result.synthesis,
                                read_activity(bench.read(waves_file(result.synthesis)), unit_clock),
                                *options.simulate, unit_clock, *tools.sta, bench);
    }
  }
  if (tools.nextpnr) {
    result.tools.push_back(tools.nextpnr->release());
    place(result, target, options, tools, bench);
  }
  if (tools.sta) {
    options.progress("timing the cells");
    result.tools.push_back("OpenSTA " + tools.sta->release());
    result.critical_path_ns = critical_path_ns(target, result.synthesis, unit_clock, *tools.sta, bench);
  }
  return result;
}

}  // namespace hitpipe::sim
