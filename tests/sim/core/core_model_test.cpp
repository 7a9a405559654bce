// The core's machines, cycle by cycle, against the walk in software: the same hits and the same number of
// reads for all rays of a picture, with memories of every kind. Damaged images end too.
#include "sim/core/core_model.hpp"

#include <mutex>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sw_ref/core/core_tracer.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/world/int_tracer.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::core_model_test {
namespace {

const hls::WorldBits world{12, 1, 12, 0, 0};
const hls::MajorBits boxes{12, 1, 7, 0, 12};

/// The rays of a picture, with what software answers.
class Recorded final : public ref::Tracer {
 public:
  Recorded(const ref::CoreImage& image, int places) : core_(image, {world, boxes, places}) {}

  void trace(const ref::TraceJob& job, ref::TraceCounts& counts) const override {
    core_.trace(job, counts);
    const std::scoped_lock lock(recording_);
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      jobs.push_back({ref::int_ray(job.rays[i], world), job.query == ref::Query::any});
      triangles.push_back(job.triangles[i]);
    }
  }
  [[nodiscard]] std::size_t bytes_per_node() const override { return core_.bytes_per_node(); }
  [[nodiscard]] std::size_t node_count() const override { return core_.node_count(); }

  mutable std::vector<CoreJob> jobs;
  mutable std::vector<std::uint32_t> triangles;

 private:
  ref::CoreTracer core_;
  mutable std::mutex recording_;
};

struct Picture {
  ref::IntScene scene = ref::int_scene(hills(), world, {.builder = ref::Builder::sah, .max_triangles = 2});
  ref::CoreImage image = ref::core_image(scene);
  std::vector<CoreJob> jobs;
  std::vector<std::uint32_t> triangles;
  ref::TraceCounts work;

  explicit Picture(int places, int size = 48) {
    const Recorded tracer(image, places);
    const ref::IntSurfaces surfaces(scene);
    ref::RenderOptions options;
    options.width = options.height = size;
    options.surfaces = &surfaces;
    work = render(scene.scene, tracer, options).counts.total();
    jobs = tracer.jobs;
    triangles = tracer.triangles;
  }
};

struct Kind {
  const char* name;
  int rays;
  int stack_bits;
  MemoryOptions memory;
};

class CoreWith : public testing::TestWithParam<Kind> {};

TEST_P(CoreWith, AnswersAndReadsAsSoftwareDoes) {
  const Kind& kind = GetParam();
  const Picture picture(1 << kind.stack_bits);
  ASSERT_GT(picture.jobs.size(), 1'000U);
  CoreModelOptions options{.world = world, .boxes = boxes, .rays = kind.rays, .stack_bits = kind.stack_bits};
  options.door_interval = 1;
  CoreModel core(picture.image, options, kind.memory);
  std::vector<CoreAnswer> answers(picture.jobs.size());
  core.run(picture.jobs, answers);
  std::size_t any = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const CoreJob& job = picture.jobs[i];
    ASSERT_FALSE(answers[i].failed) << "ray " << i;
    ASSERT_EQ(answers[i].hit.found(), picture.triangles[i] != ref::IntHit::none) << "ray " << i;
    any += job.any ? 1 : 0;
    if (job.any) continue;
    ASSERT_EQ(answers[i].hit.triangle, picture.triangles[i]) << "ray " << i;
    if (!answers[i].hit.found()) continue;
    const auto crossing =
        ref::int_crossing(job.ray, picture.scene.mesh.triangles[picture.triangles[i]], world);
    ASSERT_TRUE(crossing);
    ASSERT_EQ(answers[i].hit.t, crossing->t) << "ray " << i;
  }
  EXPECT_GT(any, 100U);
  EXPECT_EQ(core.counts().rays, picture.jobs.size());
  EXPECT_EQ(core.counts().records, picture.work.nodes_loaded);
  EXPECT_EQ(core.counts().triangles, picture.work.triangles_loaded);
  EXPECT_EQ(core.memory_counts().outside, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Memories, CoreWith,
    testing::Values(Kind{"AtOnce", 128, 3, {.least_latency = 1, .most_latency = 1}},
                    Kind{"OneRay", 1, 3, {.least_latency = 1, .most_latency = 30}},
                    Kind{"SevenRays", 7, 1, {.least_latency = 1, .most_latency = 200}},
                    Kind{"Random", 128, 1, {.least_latency = 1, .most_latency = 200}},
                    Kind{
                        "Refusing", 256, 2, {.least_latency = 1, .most_latency = 400, .refused_percent = 70}},
                    Kind{"InOrder", 64, 3, {.least_latency = 1, .most_latency = 50, .in_order = true}},
                    Kind{"Cached", 32, 3, {.cache_kib = 4}}),
    [](const auto& each) { return each.param.name; });

CoreCounts counts_of(const ref::CoreImage& image, std::uint32_t most_steps) {
  const CoreModelOptions options{.world = world, .boxes = boxes, .rays = 8, .most_steps = most_steps};
  CoreModel core(image, options, {.least_latency = 1, .most_latency = 20});
  const Picture picture(8, 4);
  std::vector<CoreAnswer> answers(picture.jobs.size());
  core.run(picture.jobs, answers);
  EXPECT_EQ(core.memory_counts().outside, 0U);
  return core.counts();
}

TEST(CoreWithADamagedImage, AnswersEveryRay) {
  const Picture picture(8, 4);
  ref::CoreImage image = picture.image;
  // The root leads to itself.
  ref::CoreRecord first = ref::record_of(image.blocks[0]);
  ref::CoreRecord loop = first;
  loop.pointer = 0;
  image.blocks[0] = to_block(loop);
  const CoreCounts looped = counts_of(image, 100);
  EXPECT_GT(looped.failed, 0U);
  EXPECT_LE(looped.records, 100 * looped.rays);
  // Children behind the image's end, and on it.
  for (const std::uint32_t place : {0U, 1U, 1'000'000U}) {
    ref::CoreRecord away = ref::record_of(image.blocks[first.pointer]);
    away.pointer = static_cast<std::uint32_t>(image.blocks.size()) - 1 + place;
    image.blocks[0] = to_block(first);
    image.blocks[first.pointer] = to_block(away);
    EXPECT_GT(counts_of(image, 100).failed, 0U) << place;
  }
}

TEST(CoreModel, RefusesOptions) {
  const Picture picture(8, 4);
  const auto said = [&](const CoreModelOptions& options) {
    return message_of<std::invalid_argument>([&] { (void)CoreModel(picture.image, options, {}); });
  };
  EXPECT_EQ(said({.world = world, .boxes = boxes, .rays = 257}), "rays in flight 257: allowed is 1 to 256");
  EXPECT_EQ(said({.world = world, .boxes = boxes, .address_bits = 4}),
            fmt::format("blocks of the image {}: allowed is 1 to 16", picture.image.blocks.size()));
}

}  // namespace
}  // namespace hitpipe::sim::core_model_test
