// A row, and a plan of a few rows, for the tests of sweeps.
#pragma once

#include <vector>

#include "sim/sweep/plan.hpp"
#include "sim/sweep/row.hpp"

namespace hitpipe::sim {

inline SweepRow a_row() {
  SweepRow row;
  row.program = "hitpipe 1";
  row.scene = "two, \"quoted\"";
  row.content = "fnv1a-0123";
  row.triangles = 24578;
  row.hierarchy = "sah 2";
  row.bvh_nodes = 12119;
  row.width = 64;
  row.height = 48;
  row.bounces = 5;
  row.library = "thesis_250nm";
  row.rays_in_flight = 32;
  row.design = "int_slabs";
  row.bits = "20/24";
  row.stages = 4;
  row.stage_delay_ps = 3176;
  row.area_um2 = 1'234'567;
  row.bytes_per_node = 23;
  row.triangle = {.delay_ps = 2876, .area_um2 = 10'000'000};
  row.rays_primary = 3072;
  row.rays_secondary = 1000;
  row.rays_shadow = 4000;
  row.rays_rejected = 72;
  row.unit_tests = 400'000;
  row.box_tests = 400'000;
  row.hits = 200'000;
  row.triangle_tests = 70'000;
  row.reference_box_tests = 400'800;
  row.reference_triangle_tests = 69'000;
  row.false_hits = 123;
  row.false_misses = 0;
  row.rtl_mismatches = 0;
  row.different_triangles = 0;
  row.different_pixels = 0;
  row.cycles = 500'000;
  row.set_up = {.divisions = 3, .bits = 20, .delay_ps = 2000, .area_um2 = 100'000};
  row.energy_pj_per_box = 500;
  row.cost = "tests and set-up";
  row.bytes_4kib = 4'000'000;
  row.bytes_16kib = 2'000'000;
  row.bytes_64kib = 1'000'000;
  row.indexed_bytes = 12'000'000;
  row.indexed_bytes_4kib = 5'000'000;
  row.indexed_bytes_16kib = 3'000'000;
  row.indexed_bytes_64kib = 2'000'000;
  row.extra_box_pct_low = -0.25;
  row.extra_box_pct_high = -0.125;
  row.extra_triangle_pct_low = 1;
  row.extra_triangle_pct_high = 2;
  row.rtl_seconds = 0.125;
  row.software_s = 1.75;
  row.software_s_low = 1.5;
  row.software_s_high = 2;
  return row;
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
  const std::vector<Format> of_both{hls::IntBits{24, 24}, hls::IntBits{6, 6}, hls::IntBits{6, 6}};
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_plucker"), of_both},
                                           {&rtl::find_design("fp_slabs"), {hls::Binary32{}}},
                                           {&rtl::find_design("int_slabs"), of_both}};
  return plan_sweep(designs, std::vector<int>{8, 1, 8});
}

}  // namespace hitpipe::sim
