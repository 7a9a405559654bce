// The search for the least whole cost on six scenes: the result costs no more than any format that it could have
// kept, by counts and prices of the test's own.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "hls/box/major_format.hpp"
#include "sim/cosim/generic_tracer.hpp"
#include "sim/fit/fit_scene.hpp"
#include "sim/software/software.hpp"
#include "sim/sweep/sweep.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::sim::least_cost_test {
namespace {

const rtl::Library& library() {
  return rtl::Library::thesis();
}

/// Of a unit that is cut to the scene at this precision, as `hitpipe fit` counts it.
double whole_cost(const rtl::Design& design, const Precision& precision, const FitScene& scene,
                  const ref::TraceCounts& tests) {
  SweepRow row =
      priced_row(design, precision.format, price_of_fit(design, precision, scene.demands, library()).value());
  row.triangle = triangle_cost(library());
  const auto boxes = static_cast<std::uint64_t>(row.boxes_per_test);
  row.cycles = (tests.box_tests + boxes - 1) / boxes;
  row.triangle_tests = tests.triangle_tests;
  return row.whole_area_run_time();
}

ref::TraceCounts counts_of(const rtl::Design& design, const Format& format, const FitScene& scene) {
  const auto tracer = make_tracer(design, {format, {}, true}, scene.scene.mesh, scene.bvh);
  ref::TraceCounts counts;
  for (const ref::RecordedBatch& batch : scene.rays.batches) {
    std::vector<std::uint32_t> triangles(batch.rays.size());
    tracer->trace({batch.rays, batch.query, triangles}, counts);
  }
  return counts;
}

class LeastCost : public testing::TestWithParam<const char*> {};

TEST_P(LeastCost, IsNoMoreThanThatOfAnyFormatThatTheSearchCouldKeep) {
  const ref::BuiltInScene& built_in = *ref::find_built_in(GetParam());
  ref::SceneOptions least;
  if (built_in.scales()) least.triangles = built_in.least;
  FitOptions options;
  options.width = options.height = 24;
  const FitScene scene = prepare_fit(ref::load_scene(built_in.name, least), options);
  for (const char* const name : {"int_major", "int_slabs"}) {
    const rtl::Design& design = rtl::find_design(name);
    const Format most = fit_from(design);
    const PrecisionSearch search{
        .design = &design,
        .scene = &scene.scene,
        .bvh = &scene.bvh,
        .demands = &scene.demands,
        .rays = &scene.rays,
        .most = most,
        .cost = [&](const Precision& precision,
                    const ref::TraceCounts& tests) { return whole_cost(design, precision, scene, tests); },
        .threads = 2};
    const Precision found = fewest_bits(search).value();
    ASSERT_FALSE(found.starts.empty());
    EXPECT_EQ(found.starts.front().format, most);
    const auto cost_of = [&](const Format& format) {
      return whole_cost(design, {.format = format, .endless_extra_box_tests_pct = 0.0}, scene,
                        counts_of(design, format, scene));
    };
    EXPECT_DOUBLE_EQ(found.starts.front().cost, cost_of(most));
    std::vector<Format> kept{most, design.default_format};
    for (const auto& group : software_of(design).smaller_formats(most))
      for (const Format& format : software_of(design).sweep_formats)
        if (std::ranges::find(group, format) != group.end()) kept.push_back(format);
    for (const Format& format : kept)
      EXPECT_LE(found.cost, cost_of(format)) << name << ' ' << to_string(format);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LeastCost,
                         testing::Values("spheres", "poppy", "statue", "waves", "plant_slice", "terrain"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace hitpipe::sim::least_cost_test
