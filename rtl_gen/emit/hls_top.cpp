#include "rtl_gen/emit/hls_top.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

/// What a script says of the folder of hitpipe's headers.
constexpr const char* include_setting =
    "# INCLUDE   the folder that holds hitpipe's hls/: its sources, or include/hitpipe where it is installed "
    "(. unless given)\n";

/// Where the script, hitpipe's headers and the vectors are; what a user may set in the environment.
constexpr const char* settings_by_place = R"(proc setting {name otherwise} {
  if {[info exists ::env($name)]} { return $::env($name) }
  return $otherwise
}

set here [file dirname [file normalize [info script]]]
set include [file normalize [setting INCLUDE .]]
if {![file exists [file join $include hls top top_domain.hpp]]} {
  error "INCLUDE=$include: there is no hls/top/top_domain.hpp in that folder"
}
set vectors [file normalize [file join $here .. tb ${module}_vectors.hex]]
)";

std::string vitis_tcl(const std::string& title, const std::string& module) {
  return fmt::format(
             R"(# {} through Vitis HLS: C simulation, synthesis, export as IP. Settings come from the environment.
#   INCLUDE=/path/to/hitpipe PART=xc7a100tcsg324-1 vitis_hls -f {}_vitis_hls.tcl
{}# PART      the device
# CLOCK     period in ns (5 unless given)
# PROJECT   folder to work in (hitpipe_<module> unless given)
set module {}
)",
             title, module, include_setting, module) +
         settings_by_place + R"(set flags "-std=c++14 -I$include -DHITPIPE_VENDOR"

open_project -reset [setting PROJECT hitpipe_$module]
set_top hitpipe_$module
add_files [file join $here $module.cpp] -cflags $flags
add_files -tb [file join $here ${module}_csim.cpp] -cflags $flags
add_files -tb $vectors
open_solution -reset solution
set_part [setting PART xc7a100tcsg324-1]
create_clock -period [setting CLOCK 5]
csim_design -argv $vectors
csynth_design
export_design -format ip_catalog
exit
)";
}

std::string vitis_cfg(const std::string& title, const std::string& module) {
  return fmt::format(
      R"(# {0} for the unified Vitis compiler. Write the folder that holds hitpipe's hls/ in place of HITPIPE.
#   v++ -c --mode hls --config {1}_hls.cfg --work_dir work
#   vitis-run --mode hls --csim --config {1}_hls.cfg --work_dir work
part=xc7a100tcsg324-1

[hls]
flow_target=vivado
clock=5ns
package.output.format=ip_catalog
package.output.syn=true
syn.top=hitpipe_{1}
syn.file={1}.cpp
syn.cflags=-std=c++14 -IHITPIPE -DHITPIPE_VENDOR
tb.file={1}_csim.cpp
tb.file=../tb/{1}_vectors.hex
tb.cflags=-std=c++14 -IHITPIPE -DHITPIPE_VENDOR
)",
      title, module);
}

std::string catapult_tcl(const std::string& title, const std::string& module, int interval) {
  return fmt::format(
             R"(# {} through Catapult. Settings come from the environment.
#   INCLUDE=/path/to/hitpipe catapult -shell -file {}_catapult.tcl
{}# LIBRARY   the component library, with its options (nangate-45nm_beh unless given)
# CLOCK     period in ns (2 unless given)
set module {}
)",
             title, module, include_setting, module) +
         settings_by_place + R"(
solution new -state initial
solution options defaults
solution options set /Input/CppStandard c++14
solution options set /Input/CompilerFlags -DHITPIPE_AC_TYPES
solution options set /Input/SearchPath $include
solution file add [file join $here $module.cpp] -type C++
solution file add [file join $here ${module}_csim.cpp] -type C++ -exclude true

go analyze
directive set -DESIGN_HIERARCHY hitpipe_$module
go compile
set library [setting LIBRARY \
  {nangate-45nm_beh -- -rtlsyntool DesignCompiler -vendor Nangate -technology 045nm}]
eval [concat solution library add $library]
go libraries
directive set -CLOCKS [list clk [list -CLOCK_PERIOD [setting CLOCK 2]]]
go assembly
directive set /hitpipe_$module/core/main -PIPELINE_INIT_INTERVAL )" +
         fmt::format("{}\ngo architect\ngo extract\n", interval);
}

std::string bambu_sh(const std::string& title, const std::string& module, int interval) {
  return fmt::format(R"sh(#!/bin/sh
# {0} through Bambu: synthesis, and co-simulation with the vectors of the C simulation. Settings come from the
# environment.
#   INCLUDE=/path/to/hitpipe ./{1}_bambu.sh
{2}# DEVICE    the device, as Bambu names it (xc7a100t-1csg324-VVD unless given)
# CLOCK     period in ns (5 unless given)
# PROJECT   folder to work in (hitpipe_<module> unless given)
set -eu
module={1}
here=$(cd "$(dirname "$0")" && pwd)
include=${{INCLUDE:-.}}
if [ ! -e "$include/hls/top/top_domain.hpp" ]; then
  echo "INCLUDE=$include: there is no hls/top/top_domain.hpp in that folder" >&2
  exit 1
fi
include=$(cd "$include" && pwd)
project=${{PROJECT:-hitpipe_$module}}
mkdir -p "$project"
cd "$project"
bambu "$here/$module.cpp" --top-fname="hitpipe_$module" --generate-interface=INFER \
  "-I$include" -DHITPIPE_AC_TYPES --std=c++14 --compiler=I386_CLANG16 -O3 "-p=hitpipe_$module={3}" \
  --device="${{DEVICE:-xc7a100t-1csg324-VVD}}" --clock-period="${{CLOCK:-5}}" \
  --simulate --simulator=VERILATOR --generate-tb="$here/${{module}}_csim.cpp" \
  --tb-arg="$here/../tb/${{module}}_vectors.hex"
grep mismatches HLS_output/simulation/testbench.log
)sh",
                     title, module, include_setting, interval);
}

std::vector<host::File> hls_scripts(const std::string& title, const std::string& module, int interval) {
  return {{module + "_vitis_hls.tcl", vitis_tcl(title, module)},
          {module + "_hls.cfg", vitis_cfg(title, module)},
          {module + "_catapult.tcl", catapult_tcl(title, module, interval)},
          {module + "_bambu.sh", bambu_sh(title, module, interval)}};
}

constexpr std::size_t columns = 110;  // as .clang-format has it

std::string top_type(int width, bool is_signed) {
  if (width == 1 && !is_signed) return "Bit";
  return fmt::format("{}<{}>", is_signed ? "Integer" : "Pattern", width);
}

/// " --name N --ii N", without what the unit has by itself.
std::string options_of(const Design& design, const Format& format, const std::string& module, int interval) {
  return (module == design.module_at(format) ? "" : " --name " + module) +
         (interval == 1 ? "" : fmt::format(" --ii {}", interval));
}

/// The function with its arguments, then `end`, wrapped as clang-format does. `types` is the prefix of its
/// types.
std::string signature(const Design& design, const Format& format, const std::string& module,
                      const std::string& types, const std::string& end) {
  std::vector<std::string> arguments;
  for (const Port& port : design.ports(format))
    arguments.push_back(fmt::format("{}{} {}", types, top_type(port.width, port.is_signed), port.name));
  for (const hls::Result& result : design.results(format))
    arguments.push_back(
        fmt::format("{}{}& {}", types, top_type(result.width, result.is_signed), result.name));

  std::string text = fmt::format("void {}(", hls_function(module));
  const std::string indent(text.size(), ' ');
  std::size_t column = text.size();
  for (const std::string& argument : arguments) {
    const bool first = &argument == &arguments.front();
    const std::size_t tail = &argument == &arguments.back() ? end.size() : 1;
    if (!first && column + 1 + argument.size() + tail > columns) {
      text += ",\n" + indent + argument;
      column = indent.size() + argument.size() + 1;
      continue;
    }
    text += (first ? "" : ", ") + argument;
    column += argument.size() + (first ? 1 : 2);
  }
  return text + end;
}

std::string header(const Design& design, const Format& format, const std::string& module, int interval) {
  return fmt::format(R"(// Top function of {} for high-level synthesis: {}.
// Written by `hitpipe rtl {}{}{} --hls`.
#pragma once

#include "hls/top/top_domain.hpp"

extern "C" {{
{}
}}
)",
                     design.name_at(format), design.summary, design.name, design.bits_option(format),
                     options_of(design, format, module, interval),
                     signature(design, format, module, "hitpipe::hls::top::", ");"));
}

std::string interfaces(const Design& design, const Format& format) {
  std::string operands, results, bambu_results;
  for (const Port& port : design.ports(format))
    operands += fmt::format("#pragma HLS INTERFACE mode = ap_none port = {}\n", port.name);
  for (const hls::Result& result : design.results(format)) {
    results += fmt::format("#pragma HLS INTERFACE mode = ap_vld port = {}\n", result.name);
    bambu_results += fmt::format("#pragma HLS INTERFACE mode = ap_none port = {}\n", result.name);
  }
  return fmt::format("{}#if defined(__BAMBU__)\n{}#else\n{}#endif\n", operands, bambu_results, results);
}

std::string source(const Design& design, const Format& format, const std::string& module, int interval) {
  std::string operands, results;
  for (const Port& port : design.ports(format))
    operands +=
        fmt::format("  in.{}{} = {};\n", port.name, port.kind == hls::Kind::real ? ".bits" : "", port.name);
  for (const hls::Result& result : design.results(format))
    results += fmt::format("  {} = out.{};\n", result.name, result.name);
  return fmt::format(
      R"(// {rate}: operands are plain ports, taken when the block starts. A result comes with a valid bit,
// in Bambu without one, which would stay 0 in a pipeline.
#include "{name}.hpp"

#if defined(__BAMBU__)  // it passes what a function that stays a call takes in a memory, wrong in a pipeline
#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)
#endif
#include "{header}"
#if defined(__BAMBU__)
#pragma clang attribute pop
#endif

using namespace hitpipe::hls;

{signature}
#if defined(__BAMBU__) || (defined(__SYNTHESIS__) && !defined(HITPIPE_AC_TYPES))
#pragma HLS PIPELINE II = {interval}
{interfaces}#endif
  using Format = {format};
  {pipeline}::Operands<top::Domain, Format> in;
{operands}  const auto out = {pipeline}::test<top::Domain>(Format(), in);
{results}}}
)",
      fmt::arg("rate", interval == 1 ? "One test a cycle" : fmt::format("A test every {} cycles", interval)),
      fmt::arg("interval", interval), fmt::arg("name", module), fmt::arg("header", design.source.header),
      fmt::arg("signature", signature(design, format, module, "top::", ") {")),
      fmt::arg("interfaces", interfaces(design, format)), fmt::arg("format", format.type()),
      fmt::arg("pipeline", design.source.pipeline), fmt::arg("operands", operands),
      fmt::arg("results", results));
}

std::string csim(const Design& design, const Format& format, const std::string& module) {
  std::vector<std::string> includes{"hls/top/csim.hpp", module + ".hpp"};
  std::sort(includes.begin(), includes.end());
  return fmt::format(
      R"(// C simulation of the top function of {0}: replays vectors and compares the results.
//   csim [FILE]    {1}_vectors.hex unless given
#include "{3}"
#include "{4}"

int main(int argc, char** argv) {{
  return hitpipe::hls::top::csim(argc, argv, "{1}_vectors.hex", {2});
}}
)",
      design.name_at(format), module, hls_function(module), includes[0], includes[1]);
}

}  // namespace

std::vector<host::File> HlsTop::files() const {
  std::vector<host::File> all{header, source, csim};
  all.insert(all.end(), scripts.begin(), scripts.end());
  return all;
}

HlsTop hls_top(const Design& design, const Format& format, const std::string& module, int interval) {
  if (design.source.pipeline.empty())
    throw std::runtime_error(
        fmt::format("{}: no top function for high-level synthesis; the design does not say where its C++ is",
                    design.name));
  return {.header = {module + ".hpp", header(design, format, module, interval)},
          .source = {module + ".cpp", source(design, format, module, interval)},
          .csim = {module + "_csim.cpp", csim(design, format, module)},
          .scripts = hls_scripts(design.name_at(format), module, interval)};
}

std::string hls_function(const std::string& module) {
  return "hitpipe_" + module;
}

}  // namespace hitpipe::rtl
