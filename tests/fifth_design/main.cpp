// The program hitpipe with two designs more: one that has all parts, and one without a set-up of rays and
// boxes.
#include "cli/program.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "tests/fifth_design/designs.hpp"
#include "tests/fifth_design/endless_slabs.hpp"
#include "tests/fifth_design/one_axis_slab.hpp"

int main(int argc, char** argv) {
  hitpipe::sim::add_design(hitpipe::rtl::design_of<hitpipe::hls::EndlessSlabs>(),
                           hitpipe::sim::endless_slabs_software());
  hitpipe::rtl::add_design(hitpipe::rtl::design_of<hitpipe::hls::OneAxisSlab>());
  return hitpipe::cli::run(argc, argv);
}
