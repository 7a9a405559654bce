#include "sim/implement/synthesis.hpp"

#include <cstdlib>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fnmatch.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/licence.hpp"

namespace hitpipe::sim {

namespace {

constexpr std::string_view slack_label = "hitpipe slack ";
constexpr double period_ns = 10;

std::string script(const Target& target, const Synthesis& netlist, const std::string& clock) {
  return fmt::format(R"(read_liberty {}
read_verilog {}
link_design {}
create_clock -name clock -period {} {}
set paths [find_timing_paths -from [all_registers -clock_pins] -to [all_registers -data_pins] -path_delay max]
foreach path $paths {{
  puts "{}[get_property $path slack]"
}}
report_checks -from [all_registers -clock_pins] -to [all_registers -data_pins] -path_delay max -digits 3
)",
                     target.liberty, netlist.verilog(), netlist.top, period_ns, clock, slack_label);
}

}  // namespace

std::string ResourceCount::text() const {
  return fmt::format("{} of {} {}", used, available.value(), name);
}

int Synthesis::cell_count() const {
  return std::accumulate(cells.begin(), cells.end(), 0,
                         [](int sum, const auto& cell) { return sum + cell.second; });
}

std::map<std::string, int> mapped_cells(const std::string& stat) {
  const auto refuse = [] { throw std::runtime_error("Yosys's counts of cells cannot be read"); };
  const nlohmann::json json = nlohmann::json::parse(stat, nullptr, false);
  if (!json.is_object() || !json.contains("design")) refuse();
  const auto& design = json["design"];
  if (!design.is_object() || !design.contains("num_cells_by_type")) refuse();
  std::map<std::string, int> cells;
  for (const auto& [kind, count] : design["num_cells_by_type"].items()) {
    if (!count.is_number_unsigned()) refuse();
    if (kind.starts_with('$'))
      throw std::runtime_error(
          fmt::format("Yosys left {} cells {} without a cell of the target", count.get<int>(), kind));
    cells[kind] = count.get<int>();
  }
  return cells;
}

double cell_area(const std::string& stat) {
  constexpr std::string_view before = "Chip area for ";
  const std::size_t line = stat.rfind(before);
  const std::size_t colon = line == std::string::npos ? line : stat.find("': ", line);
  if (colon == std::string::npos) throw std::runtime_error("Yosys printed no cell area");
  return std::strtod(stat.c_str() + colon + 3, nullptr);
}

std::vector<ResourceCount> count_resources(const Target& target, const std::map<std::string, int>& cells) {
  std::vector<ResourceCount> counts;
  for (const Resource& resource : target.resources) {
    if (!resource.packed.empty()) continue;
    ResourceCount count{resource.name, 0, resource.available};
    for (const auto& [kind, number] : cells)
      for (const auto& [pattern, weight] : resource.cells)
        if (fnmatch(pattern.c_str(), kind.c_str(), 0) == 0) count.used += weight * number;
    counts.push_back(std::move(count));
  }
  return counts;
}

std::string synthesis_lines(const Target& target, const std::string& top) {
  std::string lines;
  for (const std::string& line : target.synthesis)
    lines += filled_in(line, {{"top", top}, {"liberty", target.liberty}}) + "\n";
  return lines;
}

Synthesis synthesise(const Target& target, const ChipSources& sources, const Tool& yosys,
                     const Workbench& bench) {
  Synthesis result{.top = sources.top, .cells = {}, .counts = {}, .area_um2 = {}};
  std::string script;
  for (const host::File& file : sources.verilog) {
    bench.put(file);
    script += fmt::format("read_verilog {}\n", file.name);
  }
  for (const auto& [name, contents] : target.files) bench.put_and_keep({name, contents});
  const std::string cells = sources.top + "_cells.json";
  const std::string area = sources.top + "_area.txt";
  script += synthesis_lines(target, sources.top);
  // Cells without hardware, by which newer Yosys remembers where modules were before it flattened them.
  script += "delete t:$scopeinfo\n";
  script += fmt::format("tee -q -o {} stat -json\n", cells);
  if (!target.liberty.empty()) script += fmt::format("tee -q -o {} stat -liberty {}\n", area, target.liberty);
  // OpenSTA reads no assignment to bits that are joined.
  script +=
      fmt::format("write_verilog -noattr -simple-lhs {}\nwrite_json {}\n", result.verilog(), result.json());
  const std::string script_name = sources.top + "_synthesis.ys";
  bench.put_and_keep(rtl::with_licence({script_name, script}));
  bench.run(yosys, {"-s", script_name}, sources.top + "_synthesis.log");
  for (const std::string& name : {cells, result.verilog(), result.json()}) bench.keep(name);
  result.cells = mapped_cells(bench.read(cells));
  result.counts = count_resources(target, result.cells);
  if (!target.liberty.empty()) {
    bench.keep(area);
    result.area_um2 = cell_area(bench.read(area));
  }
  return result;
}

double slack_ns(const std::string& output) {
  const std::size_t at = output.find(slack_label);
  if (at == std::string::npos) throw std::runtime_error("OpenSTA found no path from register to register");
  return std::strtod(output.c_str() + at + slack_label.size(), nullptr);
}

double critical_path_ns(const Target& target, const Synthesis& netlist, const std::string& clock,
                        const Tool& sta, const Workbench& bench) {
  const std::string name = netlist.top + "_timing.tcl";
  bench.put_and_keep(rtl::with_licence({name, script(target, netlist, clock)}));
  const std::string output = bench.run(sta, {"-exit", name}, netlist.top + "_timing.log");
  return period_ns - slack_ns(output);
}

}  // namespace hitpipe::sim
