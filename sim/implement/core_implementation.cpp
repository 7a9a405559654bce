#include "sim/implement/core_implementation.hpp"

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
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
  const host::File verilog{core.module + ".v", rtl::to_verilog(core, library)};
  host::write_files(bench.kept(), {rtl::with_licence(verilog)});
  CoreImplementation result{
      .chip = map_module(target, {core.module, {verilog}}, tools, bench, options.progress),
      .clock_ps = core.clock_ps};
  result.chip.library = library.name();
  for (const rtl::Part& part : core.parts)
    if (part.graph) result.memory_bits += area::price(*part.graph, library).memory_bits;
  place_or_time(result.chip, target, tools, bench, options.seeds, options.progress);
  return result;
}

}  // namespace hitpipe::sim
