// A sweep: its rows are the counts of co-simulations, and threads do not change them.
#include "sim/sweep/sweep.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "area_model/price.hpp"
#include "hls/box/major_format.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/cosim/generic_tracer.hpp"
#include "sim/fit/fit.hpp"
#include "sim/sweep/rows_file.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/sweep/sample_rows.hpp"
#include "tests/sim/temporary_folder.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim::sweep_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::vector<SweepRow> swept(const ref::Scene& scene, const ref::Bvh& bvh,
                            const std::vector<SweepPoint>& points, int threads) {
  std::map<RowKey, SweepRow> rows;
  run_sweep(scene, bvh, points, {.width = 24, .height = 16, .threads = threads}, [&](const SweepRow& row) {
    EXPECT_TRUE(rows.emplace(key_of(row.design, row.bits, row.rays_in_flight), row).second);
  });
  std::vector<SweepRow> sorted;
  for (auto& [key, row] : rows) {
    EXPECT_GT(row.rtl_seconds, -1e-9);
    EXPECT_GT(row.software_s, 0.0);
    EXPECT_LE(row.software_s_low, row.software_s);
    EXPECT_GE(row.software_s_high, row.software_s);
    row.rtl_seconds = 0;
    row.software_s = row.software_s_low = row.software_s_high = std::nullopt;
    sorted.push_back(row);
  }
  return sorted;
}

TEST(Sweep, RowsAreTheCountsOfTheirCosimulation) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<SweepPoint> points = small_plan();
  const std::vector<SweepRow> rows = swept(scene, bvh, points, 2);
  ASSERT_EQ(rows.size(), points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SweepRow& row = rows[i];
    const SweepPoint& point = points[i];
    SCOPED_TRACE(row.design + " " + row.bits);
    const VerilatedDesign verilated(rtl::make_unit(*point.design, point.format, rtl::Library::thesis()));
    const CosimResult counted =
        cosimulate(verilated, scene, bvh,
                   {.width = 24, .height = 16, .rays_in_flight = point.rays_in_flight, .referee = true});
    const area::Price price =
        area::price(*point.design, point.format, rtl::Library::thesis(), area::Account::built);
    EXPECT_EQ(row.design, point.design->name);
    EXPECT_EQ(row.bits, to_string(point.format));
    EXPECT_EQ(row.rays_in_flight, point.rays_in_flight);
    EXPECT_EQ(row.area_um2, price.area_um2);
    EXPECT_EQ(row.stage_delay_ps, price.stage_delay_ps);
    EXPECT_EQ(row.stages, price.stages);
    EXPECT_EQ(row.triangles, 288U);
    EXPECT_EQ(row.library, "thesis_250nm");
    EXPECT_EQ(static_cast<std::size_t>(row.bytes_per_node), bytes_per_node(*point.design, point.format));
    EXPECT_EQ(row.rays_primary, 384U);
    EXPECT_EQ(row.rays_shadow, counted.rays_shadow);
    EXPECT_EQ(row.rays_rejected, counted.rejected);
    EXPECT_TRUE(row.set_up.divisions);
    ASSERT_TRUE(row.energy_pj_per_box);
    EXPECT_GT(*row.energy_pj_per_box, 10.0);
    EXPECT_LT(*row.energy_pj_per_box, 50'000.0) << "with one ray in flight a unit waits, clocked";
    // The model of memory reads what the unit reads.
    EXPECT_EQ(row.indexed_bytes, row.bytes_fetched() + 16 * row.triangle_tests);
    EXPECT_LT(row.bytes_4kib, row.bytes_fetched());
    EXPECT_LE(row.bytes_64kib, row.bytes_16kib);
    EXPECT_EQ(row.boxes_per_test, price.boxes);
    EXPECT_EQ(row.unit_tests, counted.unit.tests);
    EXPECT_EQ(row.box_tests, counted.unit.box_tests);
    EXPECT_DOUBLE_EQ(row.occupancy_pct(), counted.occupancy_pct());
    EXPECT_EQ(row.hits, counted.unit.hits);
    EXPECT_EQ(row.triangle_tests, counted.unit.triangle_tests);
    EXPECT_EQ(row.reference_box_tests, counted.reference.box_tests);
    EXPECT_EQ(row.reference_triangle_tests, counted.reference.triangle_tests);
    EXPECT_EQ(row.false_hits, counted.unit.false_hits);
    EXPECT_EQ(row.false_misses, counted.unit.false_misses);
    EXPECT_EQ(row.cycles, counted.unit.cycles);
    EXPECT_TRUE(row.verified(point.design->conservative));
    EXPECT_EQ(row.false_hits > 0, row.bits == "6/6");
  }
}

/// Almost two boxes for each test and cycle.
TEST(Sweep, APairAnswersForTwoBoxesInACycle) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const Format bits = hls::MajorBits{12, 1, 12};
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_major"), {bits}},
                                           {&rtl::find_design("int_major_pair"), {bits}}};
  const std::vector<SweepRow> rows = swept(scene, bvh, plan_sweep(designs, std::vector<int>{32}), 2);
  ASSERT_EQ(rows.size(), 2U);
  const SweepRow& one = rows[0];
  const SweepRow& pair = rows[1];
  EXPECT_EQ(one.boxes_per_test, 1);
  EXPECT_EQ(one.unit_tests, one.box_tests);
  EXPECT_EQ(pair.boxes_per_test, 2);
  EXPECT_LT(pair.unit_tests, pair.box_tests);
  EXPECT_LE(pair.box_tests, 2 * pair.unit_tests);
  EXPECT_GE(pair.cycles, pair.unit_tests);
  EXPECT_LT(pair.cycles, pair.box_tests);
  EXPECT_LE(pair.occupancy_pct(), 100.0);
  EXPECT_GT(pair.occupancy_pct(), 90.0);
  EXPECT_GT(pair.area_um2, one.area_um2);
  EXPECT_LT(pair.area_delay_mm2_ns(), one.area_delay_mm2_ns());
  for (const SweepRow& row : rows) EXPECT_TRUE(row.verified(true));
}

/// The same tests, one in three cycles.
TEST(Sweep, AnIntervalTakesAreaAndTime) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_slabs"), {hls::IntBits{12, 12}}}};
  const std::vector<SweepPoint> points = plan_sweep(designs, std::vector<int>{32}, std::vector<int>{1, 3});
  std::vector<SweepRow> rows;
  run_sweep(scene, bvh, points, {.width = 24, .height = 16},
            [&](const SweepRow& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), 2U);
  std::ranges::sort(rows, {}, &SweepRow::interval);
  const SweepRow& every = rows[0];
  const SweepRow& third = rows[1];
  EXPECT_EQ(third.interval, 3);
  EXPECT_EQ(third.hits, every.hits);
  EXPECT_EQ(third.unit_tests, every.unit_tests);
  EXPECT_GE(third.cycles, 3 * third.unit_tests);
  EXPECT_GT(third.occupancy_pct(), 90.0);
  EXPECT_LE(third.occupancy_pct(), 100.0);
  EXPECT_LT(third.area_um2, every.area_um2);
  for (const SweepRow& row : rows) EXPECT_TRUE(row.verified(true));
}

TEST(Sweep, RowsDoNotDependOnThreads) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<SweepRow> one = swept(scene, bvh, small_plan(), 1);
  for (const int threads : {2, 64}) EXPECT_EQ(swept(scene, bvh, small_plan(), threads), one) << threads;
}

/// Section 7.4 assumes that a long pipeline is not always full: a single ray fills only one stage of it.
TEST(Sweep, OccupancyRisesWithRaysInFlightUpToThePipelinesLength) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<DesignFormats> designs{{&rtl::find_design("fp_slabs"), {hls::Binary32{}}}};
  const std::vector<int> rays{1, 4, 32};
  const std::vector<SweepRow> rows = swept(scene, bvh, plan_sweep(designs, rays), 2);
  ASSERT_EQ(rows.size(), rays.size());
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_GT(rows[i].occupancy_pct(), rows[i - 1].occupancy_pct());
  const double alone = 100.0 / verilated({"fp_slabs", Format(hls::Binary32{})}).latency();
  EXPECT_NEAR(rows.front().occupancy_pct(), alone, 0.15 * alone);
  EXPECT_GT(rows.back().occupancy_pct(), 90.0);
}

TEST(Sweep, OfAListOfRaysHasNoPicture) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  std::vector<AskedRay> rays;
  for (int i = 0; i < 300; ++i)
    rays.push_back({{glm::vec3(0.3F, 0.8F, 0.2F), glm::vec3(-0.01F * static_cast<float>(i), -1.0F, 0.1F)},
                    i % 3 == 0 ? ref::Query::any : ref::Query::closest});
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_slabs"), {hls::IntBits{24, 24}}}};
  std::vector<SweepRow> rows;
  run_sweep(scene, bvh, plan_sweep(designs, std::vector<int>{8}), {.rays = rays},
            [&](const SweepRow& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), 1U);
  const SweepRow& row = rows.front();
  EXPECT_TRUE(row.verified(true));
  EXPECT_EQ(row.rays_primary, 200U);
  EXPECT_EQ(row.rays_shadow, 100U);
  EXPECT_EQ(row.width, 0);
  EXPECT_EQ(row.height, 0);
  EXPECT_EQ(row.bounces, 0);
  EXPECT_GT(row.box_tests, 300U);
  EXPECT_GT(row.software_s, 0.0);
  EXPECT_THAT(row.text(), HasSubstr(", rays of a file, library "));
  EXPECT_EQ(from_cells(to_cells(row)), row);
}

TEST(Sweep, FailureOfARowEndsItWithItsMessage) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  setenv("VERILATOR", "/nonexistent/verilator", 1);
  const std::string message = message_of<std::runtime_error>([&] {
    run_sweep(scene, bvh, small_plan(), {.width = 8, .height = 8, .threads = 2}, [](const SweepRow&) {});
    return 0;
  });
  unsetenv("VERILATOR");
  EXPECT_THAT(message, StartsWith("/nonexistent/verilator: cannot be run; "));
}

TEST(SweepSubject, ChangesWithAllThatDecidesTheRows) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  std::set<std::string> all;
  const auto about = [&](const ref::Scene& s, const ref::Bvh& b, const SweepOptions& options) {
    all.insert(sweep_subject(s, b, options).text());
  };
  about(scene, bvh, {});
  about(scene, bvh, {.threads = 7});  // the only one that changes nothing
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(*all.begin(),
              testing::MatchesRegex("hitpipe: hills, content fnv1a-[0-9a-f]+, hierarchy , 256 x 256 "
                                    "pixels, 5 bounces, library thesis_250nm, cost of tests and set-up"));
  about(scene, bvh, {.program = "hitpipe 2"});
  about(scene, bvh, {.tests_only = true});
  about(scene, bvh, {.width = 255});
  about(scene, bvh, {.height = 255});
  about(scene, bvh, {.light = {.bounces = 4}});
  about(scene, bvh, {.light = {.seed = 2}});  // nothing is drawn by it
  EXPECT_EQ(all.size(), 6U);
  about(scene, bvh, {.light = {.diffuse = 1}});
  about(scene, bvh, {.light = {.diffuse = 1, .seed = 2}});
  about(scene, bvh, {.light = {.occlusion = 1}});
  const std::vector<AskedRay> one{{{glm::vec3(0.0F), glm::vec3(1.0F)}}};
  const std::vector<AskedRay> another{{{glm::vec3(0.0F), glm::vec3(1.0F)}, ref::Query::any}};
  about(scene, bvh, {.rays = one});
  about(scene, bvh, {.width = 8, .light = {.diffuse = 1}, .rays = one});  // the picture's
  about(scene, bvh, {.rays = another});
  EXPECT_EQ(all.size(), 11U);
  about(scene, ref::build_bvh(scene.mesh, {.max_triangles = 1}), {});
  const auto changed = [&](auto change) {
    ref::Scene other = hills();
    change(other);
    about(other, bvh, {});
  };
  changed([](ref::Scene& s) { s.camera.eye.x += 0.001F; });
  changed([](ref::Scene& s) { s.camera.projection = ref::Projection::orthographic; });
  changed([](ref::Scene& s) { s.camera.half_height += 0.001; });
  changed([](ref::Scene& s) { s.lights.pop_back(); });
  changed([](ref::Scene& s) { s.lights.back().kind = ref::LightKind::sun; });
  changed([](ref::Scene& s) { s.materials[0].reflect.x = 0.25F; });
  changed([](ref::Scene& s) { s.mesh.vertices[3].y += 0.001F; });
  changed([](ref::Scene& s) { s.name = "line\nbreak"; });
  EXPECT_EQ(all.size(), 20U);
  for (const std::string& text : all) EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace hitpipe::sim::sweep_test
