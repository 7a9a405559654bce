// The core's walk in software finds what the exact traversal finds, with any number of places in its stack.
#include "sw_ref/core/core_tracer.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "rays/trace/int_tracer.hpp"
#include "rays/world/int_triangle.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref::core_tracer_test {
namespace {

struct Figures {
  TraceCounts work;
  std::uint64_t restarts = 0;
};

/// Compares all rays of a picture and returns what they cost.
Figures traced(const IntScene& scene, const CoreTracerOptions& options, int size) {
  const CoreImage image = core_image(scene);
  const CoreTracer core(image, scene.mesh.mesh, options);
  const auto exact = int_tracer(scene.mesh, scene.hierarchy(), {.world = options.world});
  const IntSurfaces surfaces(scene);
  RenderOptions render_options;
  render_options.width = render_options.height = size;
  render_options.surfaces = &surfaces;
  const RenderResult by_core = render(scene.scene, core, render_options);
  const RenderResult by_exact = render(scene.scene, *exact, render_options);
  EXPECT_EQ(by_core.triangles, by_exact.triangles);
  EXPECT_EQ(by_core.image, by_exact.image);
  return {by_core.counts.total(), core.restarts()};
}

TEST(CoreTracer, FindsWhatTheExactTraversalFinds) {
  const hls::WorldBits world{12, 1, 12, 0, 0};
  const IntScene scene =
      int_scene(sim::hills(), world, {.build = {.builder = Builder::sah, .max_triangles = 2}});
  std::uint64_t last_reads = ~std::uint64_t{0};
  for (const int places : {0, 1, 2, 4, 8, 60}) {
    const Figures made = traced(scene, {world, {12, 1, 7, 0, 12}, places}, 48);
    EXPECT_LE(made.work.nodes_loaded, last_reads) << places << " places";
    last_reads = made.work.nodes_loaded;
    EXPECT_TRUE(places != 60 || made.restarts == 0);
    EXPECT_TRUE(places != 0 || made.restarts > made.work.rays);
  }
}

/// The model of the design: 18.2 blocks a ray for `spheres` with a surface-area tree, at most two triangles a
/// leaf, and eight places.
TEST(CoreTracer, SpheresTakeAsManyBlocksAsTheModel) {
  const IntScene scene =
      int_scene(load_scene("spheres"), {}, {.build = {.builder = Builder::sah, .max_triangles = 2}});
  const Figures made = traced(scene, {}, 96);
  const double blocks = static_cast<double>(made.work.nodes_loaded + made.work.triangles_loaded) /
                        static_cast<double>(made.work.rays);
  EXPECT_NEAR(blocks, 18.2, 1.0);
}

TEST(CoreTracer, TellsEachBlockThatItReads) {
  struct Told final : LoadObserver {
    std::vector<std::uint32_t> blocks;
    void node_loaded(std::uint32_t block) override { blocks.push_back(block); }
    void triangle_loaded(std::uint32_t) override { FAIL() << "the image has blocks alone"; }
  };
  const IntScene scene = int_scene(sim::hills(), {}, {.build = surface_area_build});
  const CoreImage image = core_image(scene);
  const CoreTracer core(image, scene.mesh.mesh, {});
  Told told;
  const Mesh& mesh = scene.scene.mesh;
  const glm::uvec3 aim = mesh.triangles[100];
  const glm::vec3 middle = (mesh.vertices[aim.x] + mesh.vertices[aim.y] + mesh.vertices[aim.z]) / 3.0F;
  const glm::vec3 origin{0.1F, 0.9F, 0.1F};
  const Ray ray{.origin = origin, .direction = middle - origin};
  std::uint32_t triangle = IntHit::none;
  TraceCounts counts;
  core.trace({.rays = {&ray, 1}, .triangles = {&triangle, 1}, .loads = &told}, counts);
  EXPECT_NE(triangle, IntHit::none);
  EXPECT_EQ(told.blocks.size(), counts.nodes_loaded + counts.triangles_loaded);
  ASSERT_FALSE(told.blocks.empty());
  EXPECT_EQ(told.blocks.front(), 0U);
  // The triangle that is hit was read.
  const auto read = [&](std::uint32_t block) { return triangle_of(image.blocks[block]).number == triangle; };
  EXPECT_TRUE(std::any_of(told.blocks.begin(), told.blocks.end(), read));
}

TEST(CoreTracer, OfAnEmptyMeshHitsNothing) {
  Scene empty = sim::hills();
  empty.mesh = {};
  const IntScene scene = int_scene(empty, {});
  const CoreImage image = core_image(scene);
  const CoreTracer core(image, scene.mesh.mesh, {});
  const Ray ray{{0, 0, 0}, {1, 0, 0}, Ray::infinite};
  std::uint32_t found = 0;
  TraceCounts counts;
  core.trace({{&ray, 1}, Query::closest, {&found, 1}}, counts);
  EXPECT_EQ(found, IntHit::none);
  EXPECT_EQ(counts.nodes_loaded, 1U);
}

TEST(CoreTracer, RefusesOtherFormats) {
  const IntScene scene = int_scene(sim::hills(), {});
  const CoreImage image = core_image(scene);
  const Mesh& mesh = scene.mesh.mesh;
  EXPECT_THROW(CoreTracer(image, mesh, {.boxes = hls::MajorBits{16, 1, 11, 0, 16}}), std::invalid_argument);
  EXPECT_THROW(CoreTracer(image, mesh, {.places = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace hitpipe::ref::core_tracer_test
