// The core's machines, cycle by cycle, against the walk in software: the same hits and the same number of
// reads for all rays of a picture, with memories of every kind. Damaged images end too.
#include "sim/core/core_bench.hpp"

#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sim/core/picture_rays.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::core_model_test {
namespace {

const hls::WorldBits world{12, 1, 12, 0, 0};
const hls::MajorBits boxes{12, 1, 7, 0, 12};

struct Picture {
  ref::IntScene scene = ref::int_scene(hills(), world, {.builder = ref::Builder::sah, .max_triangles = 2});
  ref::CoreImage image = ref::core_image(scene);
  PictureRays rays;

  explicit Picture(int places, int size = 48)
      : rays(picture_rays(scene, image, {world, boxes, places}, {.width = size, .height = size})) {}
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
  ASSERT_GT(picture.rays.jobs.size(), 1'000U);
  CoreModelOptions options{.world = world, .boxes = boxes, .rays = kind.rays, .stack_bits = kind.stack_bits};
  options.door_interval = 1;
  CoreModel core(picture.image, options, kind.memory);
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  core.run(picture.rays.jobs, answers);
  EXPECT_EQ(picture.rays.wrong(answers), 0U);
  std::size_t any = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const CoreJob& job = picture.rays.jobs[i];
    any += job.any ? 1 : 0;
    if (job.any || !answers[i].hit.found()) continue;
    const auto crossing =
        ref::int_crossing(job.ray, picture.scene.mesh.triangles[picture.rays.triangles[i]], world);
    ASSERT_TRUE(crossing);
    ASSERT_EQ(answers[i].hit.t, crossing->t) << "ray " << i;
  }
  EXPECT_GT(any, 100U);
  EXPECT_EQ(core.counts().rays, picture.rays.jobs.size());
  EXPECT_EQ(core.counts().records, picture.rays.work.nodes_loaded);
  EXPECT_EQ(core.counts().triangles, picture.rays.work.triangles_loaded);
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
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  core.run(picture.rays.jobs, answers);
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
