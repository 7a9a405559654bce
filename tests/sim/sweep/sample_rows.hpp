// A row, and a plan of a few rows, for the tests of sweeps.
#pragma once

#include <vector>

#include "sim/sweep/plan.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::sim {

inline SweepRow a_row() {
  return {.scene = "two, \"quoted\"",
          .triangles = 24578,
          .bvh_nodes = 12119,
          .width = 64,
          .height = 48,
          .rays_in_flight = 32,
          .library = "thesis_250nm",
          .design = "int_slabs",
          .bits = "20/24",
          .stages = 4,
          .stage_delay_ps = 3176,
          .area_um2 = 1'234'567,
          .bytes_per_node = 23,
          .triangle = {.delay_ps = 2876, .area_um2 = 10'000'000},
          .rays_primary = 3072,
          .rays_secondary = 1000,
          .rays_shadow = 4000,
          .rays_rejected = 72,
          .unit_tests = 400'000,
          .box_tests = 400'000,
          .hits = 200'000,
          .triangle_tests = 70'000,
          .reference_box_tests = 400'800,
          .reference_triangle_tests = 69'000,
          .false_hits = 123,
          .false_misses = 0,
          .rtl_mismatches = 0,
          .different_triangles = 0,
          .different_pixels = 0,
          .cycles = 500'000,
          .rtl_seconds = 0.125,
          .software_ratio = 1.75};
}

/// The same boxes in half the tests and cycles, by a unit of the same area.
inline SweepRow a_pair() {
  SweepRow row = a_row();
  row.design = "int_major_pair";
  row.bits = "20+1/12";
  row.boxes_per_test = 2;
  row.unit_tests /= 2;
  row.cycles /= 2;
  return row;
}

inline std::vector<SweepPoint> small_plan() {
  const std::vector<rtl::Format> of_both{hls::IntBits{24, 24}, hls::IntBits{6, 6}, hls::IntBits{6, 6}};
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_plucker"), of_both},
                                           {&rtl::find_design("fp_slabs"), {hls::Binary32{}}},
                                           {&rtl::find_design("int_slabs"), of_both}};
  return plan_sweep(designs, std::vector<int>{8, 1, 8});
}

}  // namespace hitpipe::sim
