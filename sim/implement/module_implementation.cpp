#include "sim/implement/module_implementation.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/emit/licence.hpp"
#include "sim/implement/shift_harness.hpp"

namespace hitpipe::sim {

namespace {

/// The module as the counted netlist has it, between shift registers. Returns the netlist's name.
std::string synthesise_harness(const Target& target, const Synthesis& module, const std::string& clock,
                               const Tool& yosys, const Workbench& bench) {
  const std::string top = harness_module(module.top);
  const std::string netlist = top + ".json";
  const std::vector<ChipPort> ports = ports_of_netlist(bench.read(module.json()), module.top);
  bench.put_and_keep(rtl::with_licence({top + ".v", shift_harness(module.top, clock, ports)}));
  // The netlist has modules of cells without the timing that a newer Yosys wants of them; it has its own.
  // While the module is a black box, its cells stay as they are.
  const std::string script = fmt::format(
      "read_json {}\ndelete =A:abc9_box\nsetattr -mod -set blackbox 1 {}\nread_verilog {}.v\n{}"
      "setattr -mod -unset blackbox ={}\nflatten\nopt_clean -purge\nwrite_json {}\n",
      module.json(), module.top, top, synthesis_lines(target, top), module.top, netlist);
  bench.put_and_keep(rtl::with_licence({top + ".ys", script}));
  bench.run(yosys, {"-s", top + ".ys"}, top + ".log");
  return netlist;
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

Implementation map_module(const Target& target, const ChipSources& sources, const ChipTools& tools,
                          const Workbench& bench, const StepListener& progress) {
  progress("synthesising");
  Implementation result{.module = sources.top,
                        .clock = sources.clock,
                        .synthesis = synthesise(target, sources, tools.yosys, bench),
                        .counts = {},
                        .tools = {tools.yosys.release()}};
  result.counts = result.synthesis.counts;
  if (tools.placer) {
    result.tools.push_back(tools.placer->release());
    progress("packing");
    for (const ResourceCount& count : pack(target, result.synthesis, *tools.placer, bench))
      result.counts.push_back(count);
  } else {
    result.not_placed = target.not_placed;
  }
  return result;
}

void place_or_time(Implementation& module, const Target& target, const ChipTools& tools,
                   const Workbench& bench, int seeds, const StepListener& progress) {
  if (tools.placer && module.excess().empty() && seeds > 0) {
    module.placed = place_and_route(
        target,
        {.top = harness_module(module.module),
         .netlist = synthesise_harness(target, module.synthesis, module.clock, tools.yosys, bench),
         .clock = module.clock,
         .seeds = seeds,
         .progress = [&](int seed) { progress(fmt::format("placing, seed {} of {}", seed, seeds)); }},
        *tools.placer, bench);
    if (!module.placed->seeds.empty()) module.critical_path_ns = 1000 / module.placed->median().fmax_mhz;
  }
  if (tools.sta) {
    progress("timing the cells");
    module.tools.push_back("OpenSTA " + tools.sta->release());
    module.critical_path_ns = critical_path_ns(target, module.synthesis, module.clock, *tools.sta, bench);
  }
}

}  // namespace hitpipe::sim
