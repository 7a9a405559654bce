// Boxes and triangles answered by Verilog: the same answers as exact integers, and the same picture as in
// software.
#include "sim/cosim/world_tracer.hpp"

#include <gtest/gtest.h>

#include "rays/trace/int_tracer.hpp"
#include "sim/cosim/counts.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/render.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::world_tracer_test {
namespace {

VerilatedDesign unit(const std::string& name, const std::string& bits, int interval = 1) {
  const rtl::Design& design = rtl::find_design(name);
  return VerilatedDesign(
      rtl::make_unit(design, design.parse_format(bits), rtl::Library::thesis(), {.interval = interval}));
}

ref::RenderOptions options_of(const ref::IntSurfaces& surfaces) {
  ref::RenderOptions options;
  options.width = options.height = 24;
  options.surfaces = &surfaces;
  return options;
}

/// Triangle format, box unit, its format, interval.
class Worlds : public testing::TestWithParam<std::tuple<std::string, std::string, std::string, int>> {};

TEST_P(Worlds, AreTracedAsInSoftware) {
  const auto& [triangles, box_design, boxes, interval] = GetParam();
  const VerilatedDesign triangle_unit = unit("int_triangle", triangles, interval);
  const VerilatedDesign box_unit = unit(box_design, boxes, interval);
  const auto bits = triangle_unit.unit().format.as<hls::WorldBits>();
  const ref::IntScene scene = ref::int_scene(hills(), bits);
  const ref::IntSurfaces surfaces(scene);
  const WorldTracer tracer(scene, {.boxes = &box_unit, .triangles = &triangle_unit, .rays_in_flight = 8});
  const ref::RenderResult by_verilog = ref::render(scene.scene, tracer, options_of(surfaces));
  const auto software = ref::int_tracer(scene.mesh, scene.hierarchy(), {.world = bits});
  const ref::RenderResult by_software = ref::render(scene.scene, *software, options_of(surfaces));

  const WorldCounts counts = tracer.counts();
  EXPECT_EQ(counts.different, 0U);
  EXPECT_EQ(counts.boxes.rtl_mismatches + counts.triangles.rtl_mismatches, 0U);
  EXPECT_EQ(counts.divisions.rtl_mismatches, 0U);
  EXPECT_EQ(counts.divisions.tests, counts.triangles.hits);
  EXPECT_GT(counts.divisions.hits, counts.divisions.tests / 4) << "nearer ones";
  EXPECT_EQ(by_verilog.image, by_software.image);
  EXPECT_EQ(by_verilog.triangles, by_software.triangles);
  const ref::TraceCounts work = by_verilog.counts.total();
  if (box_design == "int_major") {
    EXPECT_EQ(counts.boxes.tests, work.box_tests);
  } else {
    EXPECT_EQ(2 * counts.boxes.tests - by_verilog.counts.total().rays, work.box_tests);
  }
  EXPECT_EQ(counts.triangles.tests, work.triangle_tests);
  EXPECT_EQ(counts.rays, by_software.counts.total().rays);
  EXPECT_GT(counts.triangles.hits, 250U);
  EXPECT_LE(counts.boxes.hits, work.box_tests);
  EXPECT_GE(counts.boxes.cycles, counts.boxes.tests * static_cast<std::uint64_t>(interval));
}

INSTANTIATE_TEST_SUITE_P(Formats, Worlds,
                         testing::Values(std::tuple{"20+1s20", "int_major", "20+1/11s20", 1},
                                         std::tuple{"12+1s12t2b1", "int_major", "12+1/6f2s12", 3},
                                         std::tuple{"24+1s24b1", "int_major", "24+1/11s24", 1},
                                         std::tuple{"20+1s20", "int_major_pair", "20+1/11s20", 1},
                                         std::tuple{"12+1s12t2", "int_major_pair", "12+1/6f2s12", 3}));

TEST(WorldTracer, AnEmptyMeshIsNeverHit) {
  const VerilatedDesign triangle_unit = unit("int_triangle", "20+1s20");
  const VerilatedDesign box_unit = unit("int_major", "20+1/11s20");
  ref::Scene empty = hills();
  empty.mesh = {};
  const ref::IntScene scene = ref::int_scene(empty, {});
  const WorldTracer tracer(scene, {.boxes = &box_unit, .triangles = &triangle_unit});
  const ref::Ray ray{{0, 0, 0}, {1, 0, 0}, ref::Ray::infinite};
  std::uint32_t found = 0;
  ref::TraceCounts counts;
  tracer.trace({{&ray, 1}, ref::Query::closest, {&found, 1}}, counts);
  EXPECT_EQ(found, ref::IntHit::none);
  EXPECT_EQ(tracer.counts().different, 0U);
}

TEST(WorldTracer, RefusesOtherWorlds) {
  const VerilatedDesign triangle_unit = unit("int_triangle", "20+1s20");
  const VerilatedDesign of_floats = unit("int_major", "20+1/13");
  const VerilatedDesign box_unit = unit("int_major", "20+1/11s20");
  const ref::IntScene scene = ref::int_scene(hills(), {});
  EXPECT_THROW(WorldTracer(scene, {.boxes = &of_floats, .triangles = &triangle_unit}), std::runtime_error);
  EXPECT_THROW(WorldTracer(scene, {.boxes = &triangle_unit, .triangles = &triangle_unit}),
               std::runtime_error);
  EXPECT_THROW(WorldTracer(scene, {.boxes = &box_unit, .triangles = &triangle_unit, .rays_in_flight = 0}),
               std::invalid_argument);
}

}  // namespace
}  // namespace hitpipe::sim::world_tracer_test
