// The program hitpipe with the foreign design and, if asked for, one without a set-up of rays and boxes.
#include "cli/program.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "tests/foreign_design/foreign_design.hpp"
#include "tests/foreign_design/one_axis_slab.hpp"

int main(int argc, char** argv) {
  hitpipe::add_foreign_design();
  hitpipe::add_foreign_software();
#ifdef HITPIPE_ONE_AXIS_SLAB
  hitpipe::rtl::add_design(hitpipe::rtl::design_of<hitpipe::hls::OneAxisSlab>());
#endif
  return hitpipe::cli::run(argc, argv);
}
