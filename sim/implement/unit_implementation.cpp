#include "sim/implement/unit_implementation.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "area_model/energy.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/implement/synthesis.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::sim {

rtl::Library ImplementOptions::library_for(const Target& for_target) const {
  return rtl::library_called(library.empty() ? for_target.library : library, block_luts);
}

Implementation implement_unit(const rtl::Design& design, const Format& format, const Target& target,
                              const ImplementOptions& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const rtl::Library library = options.library_for(target);
  const ChipTools tools = find_chip_tools(target);
  std::optional<SimulatorTools> simulator;
  if (options.simulate) {
    check_models(target);
    simulator = find_simulator(options.simulator);
  }
  // Made before the long run, so that a folder that cannot be written is reported at once.
  const Workbench bench(options.folder / target.name);

  options.progress("writing the unit");
  const rtl::Unit unit = rtl::make_unit(design, format, library,
                                        {.module = options.module,
                                         .flow_control = options.flow_control,
                                         .interval = options.interval,
                                         .clock_ps = options.clock_ps});
  const rtl::VectorSet vectors = design_vectors(
      design, format, static_cast<std::size_t>(options.simulate.value_or(usual_vectors)), options.seed);
  const rtl::EmittedDesign emitted = rtl::emit(unit, {.vectors = &vectors});
  const bool drawn = rtl::write_unit(bench.kept(), emitted).drawn;

  Implementation result =
      map_module(target, {emitted.module, {emitted.verilog}}, tools, bench, options.progress);
  result.library = library.name();
  result.latency = unit.pipeline->latency();
  result.drawn = drawn;
  if (simulator) {
    options.progress("simulating the netlist");
    const bool dumps = tools.sta && simulator->simulator == Simulator::icarus;
    result.simulated = simulate_netlist(target, result.synthesis, {emitted.testbench, emitted.vectors, dumps},
                                        *simulator, tools.yosys, bench);
    if (dumps && result.simulated->agrees) {
      options.progress("counting toggles");
      result.energy = energy_of(target, result.synthesis,
                                read_activity(bench.read(waves_file(result.synthesis)), module_clock),
                                *options.simulate, module_clock, *tools.sta, bench);
      std::vector<std::vector<std::int64_t>> tests;
      for (rtl::Vector& vector : vectors.all()) tests.push_back(std::move(vector.operands));
      if (tests.size() >= 2)
        result.estimated_pj_per_test =
            area::energy_pj(area::toggles_of(*unit.pipeline, library, tests), result.energy->cycles_per_test);
    }
  }
  place_or_time(result, target, tools, bench, options.seeds, options.progress);
  return result;
}

}  // namespace hitpipe::sim
