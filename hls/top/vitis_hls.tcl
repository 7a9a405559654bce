# A design through Vitis HLS: C simulation, synthesis, export as IP. Settings come from the environment.
#   DESIGN=int_slabs PART=xc7a100tcsg324-1 vitis_hls -f hls/top/vitis_hls.tcl
# DESIGN    int_slabs, int_plucker, fp_slabs or fp_plucker
# PART      the device
# CLOCK     period in ns (5 unless given)
# BITS      n/t of an integer design (24/24 unless given)
# PROJECT   folder to work in (hitpipe_<design> unless given)
# CXXFLAGS  what the compiler needs to take C++20 (-std=c++20 unless given)
proc setting {name otherwise} {
  if {[info exists ::env($name)]} { return $::env($name) }
  return $otherwise
}

set pipelines {int_slabs IntSlabs int_plucker IntPlucker fp_slabs FpSlabs fp_plucker FpPlucker}
set design [setting DESIGN int_slabs]
if {![dict exists $pipelines $design]} {
  error "DESIGN=$design: unknown; there are: [join [dict keys $pipelines] {, }]"
}
set bits [setting BITS 24/24]
if {![regexp {^([0-9]+)/([0-9]+)$} $bits all coord interval]} {
  error "BITS=$bits: allowed is n/t, for example 20/24"
}
set project [setting PROJECT hitpipe_$design]
set here [file dirname [file normalize [info script]]]
set root [file dirname [file dirname $here]]
set flags "[setting CXXFLAGS -std=c++20] -I$root -DHITPIPE_VENDOR\
 -DHITPIPE_COORD_BITS=$coord -DHITPIPE_INTERVAL_BITS=$interval"

set bench [file join [pwd] ${project}_csim.cpp]
set out [open $bench w]
puts $out "#include \"hls/pipelines/$design.hpp\""
puts $out "#include \"hls/top/csim.hpp\""
puts $out "#include \"hls/top/$design.hpp\"\n"
puts $out "int main() {"
puts $out "  return hitpipe::hls::top::csim<hitpipe::hls::[dict get $pipelines $design]>(hitpipe_$design);"
puts $out "}"
close $out

open_project -reset $project
set_top hitpipe_$design
add_files [file join $here $design.cpp] -cflags $flags
add_files -tb $bench -cflags $flags
open_solution -reset solution
set_part [setting PART xc7a100tcsg324-1]
create_clock -period [setting CLOCK 5]
csim_design
csynth_design
export_design -format ip_catalog
exit
