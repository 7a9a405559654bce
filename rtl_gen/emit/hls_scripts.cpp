#include "rtl_gen/emit/hls_scripts.hpp"

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

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
# INCLUDE   the folder that holds hitpipe's hls/: its sources, or include/hitpipe where it is installed (. unless given)
# PART      the device
# CLOCK     period in ns (5 unless given)
# PROJECT   folder to work in (hitpipe_<module> unless given)
set module {}
)",
             title, module, module) +
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

std::string catapult_tcl(const std::string& title, const std::string& module) {
  return fmt::format(
             R"(# {} through Catapult. Settings come from the environment.
#   INCLUDE=/path/to/hitpipe catapult -shell -file {}_catapult.tcl
# INCLUDE   the folder that holds hitpipe's hls/: its sources, or include/hitpipe where it is installed (. unless given)
# LIBRARY   the component library, with its options (nangate-45nm_beh unless given)
# CLOCK     period in ns (2 unless given)
set module {}
)",
             title, module, module) +
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
directive set /hitpipe_$module/core/main -PIPELINE_INIT_INTERVAL 1
go architect
go extract
)";
}

}  // namespace

std::vector<host::File> hls_scripts(const std::string& title, const std::string& module) {
  return {{module + "_vitis_hls.tcl", vitis_tcl(title, module)},
          {module + "_hls.cfg", vitis_cfg(title, module)},
          {module + "_catapult.tcl", catapult_tcl(title, module)}};
}

}  // namespace hitpipe::rtl
