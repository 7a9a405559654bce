// A row of a sweep for the tests of plots.
#pragma once

#include <cstdint>
#include <string>

#include "sim/sweep/row.hpp"

namespace hitpipe::cli {

inline sim::SweepRow row(const std::string& design, const std::string& bits, std::uint64_t box_tests) {
  sim::SweepRow made;
  made.scene = "spheres";
  made.design = design;
  made.bits = bits;
  made.rays_in_flight = 32;
  made.stage_delay_ps = 3000;
  made.area_um2 = 2'000'000;
  made.unit_tests = box_tests;
  made.box_tests = box_tests;
  made.reference_box_tests = 1000;
  made.cycles = 2 * box_tests;
  return made;
}

}  // namespace hitpipe::cli
