#include "sim/implement/core_implementation.hpp"

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/verilog/names.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::sim {

CoreImplementation implement_core(const rtl::CoreOptions& core_options, const Target& target,
                                  const ImplementOptions& options) {
  if (!options.module.empty()) rtl::check_module_name(options.module);
  const rtl::Library library = options.library_for(target);
  const ChipTools tools = find_chip_tools(target);
  const rtl::Core core = rtl::make_core(core_options, library, options.module);
  const Workbench bench(options.folder / target.name);

  options.progress("writing the core");
  const host::File core_file{core.module + ".v", rtl::to_verilog(core, library)};
  const host::File axi_file{rtl::axi_module(core) + ".v", rtl::axi_verilog(core)};
  host::write_files(bench.kept(), {rtl::with_licence(core_file), rtl::with_licence(axi_file)});

  const auto implement = [&](const ChipSources& sources) {
    const StepListener progress = [&](const std::string& step) {
      options.progress(fmt::format("{}: {}", sources.top, step));
    };
    try {
      Implementation module = map_module(target, sources, tools, bench, progress);
      module.library = library.name();
      place_or_time(module, target, tools, bench, options.seeds, progress);
      return module;
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}", sources.top, error.what()));
    }
  };
  const auto bits = [&](const rtl::MachineGraph& graph) { return area::price(graph, library).memory_bits; };
  const auto bits_of = [&](const std::vector<rtl::Part>& parts) {
    std::int64_t sum = 0;
    for (const rtl::Part& part : parts)
      if (part.graph) sum += bits(*part.graph);
    return sum;
  };
  const std::int64_t core_bits = bits_of(core.parts);
  const std::int64_t axi_bits = core_bits + bits_of(rtl::behind_axi(core).parts);

  return {.core = {implement({core.module, {core_file}}), core_bits},
          .axi = {implement({rtl::axi_module(core), {core_file, axi_file}, rtl::axi_clock}), axi_bits},
          .clock_ps = core.clock_ps};
}

}  // namespace hitpipe::sim
