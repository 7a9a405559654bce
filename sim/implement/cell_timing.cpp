#include "sim/implement/cell_timing.hpp"

#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

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

double slack_ns(const std::string& output) {
  const std::size_t at = output.find(slack_label);
  if (at == std::string::npos) throw std::runtime_error("OpenSTA found no path from register to register");
  return std::strtod(output.c_str() + at + slack_label.size(), nullptr);
}

double critical_path_ns(const Target& target, const Synthesis& netlist, const std::string& clock,
                        const Tool& sta, const Workbench& bench) {
  const std::string name = netlist.top + "_timing.tcl";
  bench.put_and_keep({name, script(target, netlist, clock)});
  const std::string output = bench.run(sta, {"-exit", name}, netlist.top + "_timing.log");
  return period_ns - slack_ns(output);
}

}  // namespace hitpipe::sim
