// The core, cycle by cycle, against the walk in software: the same hits and the same number of reads for all
// rays of a picture, with memories of every kind. Its Verilog gives the same outputs in every cycle.
#include "sim/core/core_bench.hpp"

#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/world/int_ray.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/feature.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/sim/core/both_cores.hpp"
#include "tests/sim/core/core_pictures.hpp"

namespace hitpipe::sim::core_bench_test {
namespace {

using namespace core_pictures;

struct Kind {
  const char* name;
  int rays;
  int stack_bits;
  MemoryOptions memory;
  int cache_kib = 0;  ///< of the core
  bool rings = false;

  [[nodiscard]] rtl::CoreOptions core() const {
    rtl::CoreOptions made = options_of(rays, stack_bits);
    made.cache.kib = cache_kib;
    made.rings = rings;
    made.float_door = rings;
    return made;
  }
};

constexpr CoreBenchOptions far_image{.base = 0x1'8000'0003, .held_percent = 30};

void expect_right(const CorePicture& picture, const CoreBench& bench,
                  const std::vector<CoreAnswer>& answers) {
  EXPECT_EQ(picture.rays.wrong(answers), 0U);
  std::size_t any = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const CoreJob& job = picture.rays.jobs[i];
    any += job.any ? 1 : 0;
    if (job.any || !answers[i].hit.found()) continue;
    const auto crossing = ref::int_crossing(ref::int_ray(job.ray, world),
                                            picture.scene->mesh.triangles[picture.rays.triangles[i]], world);
    ASSERT_TRUE(crossing);
    ASSERT_EQ(answers[i].hit.t, crossing->t) << "ray " << i;
  }
  EXPECT_GT(any, 20U);
  EXPECT_EQ(bench.counts().rays, picture.rays.jobs.size());
  EXPECT_EQ(bench.counts().records, picture.rays.work.nodes_loaded);
  EXPECT_EQ(bench.counts().triangles, picture.rays.work.triangles_loaded);
  EXPECT_EQ(bench.memory_counts().outside, 0U);
}

class CoreWith : public testing::TestWithParam<Kind> {};

TEST_P(CoreWith, AnswersAndReadsAsSoftwareDoes) {
  const Kind& kind = GetParam();
  const CorePicture picture(1 << kind.stack_bits);
  ASSERT_GT(picture.rays.jobs.size(), 1'000U);
  const rtl::Core core = rtl::make_core(kind.core(), library());
  NativeCore native(core);
  CoreBench bench(core, native, picture.image, kind.memory, far_image);
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  bench.run(picture.rays.jobs, answers);
  expect_right(picture, bench, answers);
}

/// A block RAM may give any word that is read while it is written. No machine of a core uses one.
TEST_P(CoreWith, NeedsNoWordThatIsReadWhileItIsWritten) {
  const Kind& kind = GetParam();
  const CorePicture picture(1 << kind.stack_bits, 24);
  for (const bool serial : {false, true}) {
    rtl::CoreOptions options = kind.core();
    options.serial_triangle = serial;
    const rtl::Core core = rtl::make_core(options, library());
    NativeCore usual(core), spoilt(core, rtl::Collision::any_word);
    std::vector<CoreAnswer> answers(picture.rays.jobs.size());
    CoreBench bench(core, usual, picture.image, kind.memory, far_image);
    bench.run(picture.rays.jobs, answers);
    CoreBench spoilt_bench(core, spoilt, picture.image, kind.memory, far_image);
    spoilt_bench.run(picture.rays.jobs, answers);
    expect_right(picture, spoilt_bench, answers);
    EXPECT_EQ(spoilt_bench.counts().cycles, bench.counts().cycles);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Memories, CoreWith,
    testing::Values(
        Kind{"AtOnce", 128, 3, {.least_latency = 1, .most_latency = 1}},
        Kind{"OneRay", 1, 3, {.least_latency = 1, .most_latency = 30}},
        Kind{"SevenRays", 7, 1, {.least_latency = 1, .most_latency = 200}},
        Kind{"Random", 128, 1, {.least_latency = 1, .most_latency = 200}},
        Kind{"Refusing", 256, 2, {.least_latency = 1, .most_latency = 400, .refused_percent = 70}},
        Kind{"InOrder", 64, 3, {.least_latency = 1, .most_latency = 50, .in_order = true}},
        Kind{"BehindAModel", 32, 3, {.cache_kib = 4}},
        Kind{"Cached", 32, 3, {.least_latency = 1, .most_latency = 60, .reads_lines = true}, 4},
        Kind{
            "RingsAndACache", 32, 3, {.least_latency = 1, .most_latency = 60, .reads_lines = true}, 4, true}),
    [](const auto& each) { return each.param.name; });

struct Form {
  hls::RayBits bits;
  int triangle_interval = 4;  ///< 0: one multiplier
  bool weights = false;
  int cache_kib = 0, data_bits = 256, cache_line = 64;
  bool rings = false;
  bool narrow = false;  ///< with few bits of triangle numbers, leaf counts and steps
};

/// What the picture needs, and no more.
void make_narrow(rtl::CoreOptions& options, const CorePicture& picture) {
  options.number_bits = picture.image.header.number_bits();
  options.leaf_bits = picture.image.header.leaf_bits();
  options.step_bits = 6;
  EXPECT_EQ(options.number_bits, 9);
  EXPECT_EQ(options.leaf_bits, 2);
}

/// In every format: with a fraction of T and of box distances, and with the smallest numbers.
class CoreInVerilog : public testing::TestWithParam<Form> {};

TEST_P(CoreInVerilog, IsTheSameInEveryCycle) {
  const hls::RayBits& format = GetParam().bits;
  const CorePicture picture(4, 12, format.world(), format.boxes());
  rtl::CoreOptions options = options_of(12, 2);
  options.bits = format;
  options.tag_bits = 4;
  rtl::core_option("--triangle-ii").set(options, GetParam().triangle_interval);
  options.weights = GetParam().weights;
  options.rings = GetParam().rings;
  options.float_door = options.rings;
  options.cache.kib = GetParam().cache_kib;
  options.cache.line = GetParam().cache_line;
  options.data_bits = GetParam().data_bits;
  if (GetParam().narrow) make_narrow(options, picture);
  MemoryOptions memory{.least_latency = 1, .most_latency = 60, .refused_percent = 20};
  memory.in_order = options.has_one_id();
  memory.reads_lines = rtl::bus_of(options).has_lines;
  const rtl::Core core = rtl::make_core(options, library());
  BothCores both(core, rtl::to_verilog(core, library()));
  CoreBench bench(core, both, picture.image, memory, far_image);
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  bench.run(picture.rays.jobs, answers);
  EXPECT_EQ(answers.front().weights.has_value(), options.weights);
  EXPECT_EQ(both.first_difference, "");
  EXPECT_EQ(picture.rays.wrong(answers), 0U);
  EXPECT_EQ(bench.counts().records, picture.rays.work.nodes_loaded);
  EXPECT_EQ(bench.counts().triangles, picture.rays.work.triangles_loaded);
}

INSTANTIATE_TEST_SUITE_P(
    Formats, CoreInVerilog,
    testing::Values(Form{bits}, Form{hls::RayBits{}}, Form{{16, 2, 9, -1, 14, 3}},
                    Form{{24, 1, 14, 1, 24, 1}}, Form{{8, 0, 4, 0, 8, 0}}, Form{bits, 0},
                    Form{{24, 1, 14, 1, 24, 1}, 0}, Form{bits, 4, true}, Form{{24, 3, 14, 0, 32, 0}, 7, true},
                    Form{bits, 4, false, 4}, Form{bits, 0, false, 2, 64}, Form{bits, 4, true, 8, 512},
                    Form{bits, 4, false, 2, 128, 32}, Form{bits, 4, false, 2, 512, 32},
                    Form{bits, 4, false, 0, 64, 64, true}, Form{hls::RayBits{}, 4, false, 4, 256, 64, true},
                    Form{bits, 4, false, 4, 64, 64, false, true},
                    Form{bits, 0, false, 0, 256, 64, false, true}),
    [](const auto& each) {
      return Format(each.param.bits).identifier() + (each.param.triangle_interval == 0 ? "_serial" : "") +
             (each.param.weights ? "_weights" : "") + (each.param.rings ? "_rings" : "") +
             (each.param.narrow ? "_narrow" : "") +
             (each.param.cache_kib == 0 ? ""
                                        : fmt::format("_cache{}x{}x{}", each.param.cache_kib,
                                                      each.param.data_bits, each.param.cache_line));
    });

/// Rays that a unit int_ray in the core makes integers, among some that are no rays.
TEST(CoreWithFloats, AnswersAsWithIntegers) {
  const CorePicture picture(4, 12);
  rtl::CoreOptions options = options_of(12, 2);
  options.float_door = true;
  options.tag_bits = 7;
  const rtl::Core core = rtl::make_core(options, library());
  BothCores both(core, rtl::to_verilog(core, library()));
  CoreBench bench(core, both, picture.image, {.least_latency = 1, .most_latency = 60, .refused_percent = 20},
                  far_image);
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  bench.run(picture.rays.jobs, answers);
  expect_right(picture, bench, answers);

  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const ref::Ray none[] = {{.origin = {0, 0, 0}, .direction = {0, 0, 0}},
                           {.origin = {0, 1.5F, 0}, .direction = {1, 0, 0}},
                           {.origin = {0, 0, 0}, .direction = {1, nan, 0}},
                           {.origin = {0, 0, nan}, .direction = {0, 1, 0}},
                           {.origin = {0, 0, 0}, .direction = {0, 1, 0}, .length = -1},
                           {.origin = {0, 0, 0}, .direction = {0, ref::Ray::infinite, 0}}};
  std::vector<CoreJob> jobs;
  for (std::size_t i = 0; i < picture.rays.jobs.size(); ++i) {
    jobs.push_back(picture.rays.jobs[i]);
    jobs.push_back({none[i % std::size(none)]});
  }
  std::vector<CoreAnswer> mixed(jobs.size());
  bench.run(jobs, mixed);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ASSERT_EQ(mixed[2 * i].hit.triangle, answers[i].hit.triangle) << "ray " << i;
    ASSERT_EQ(mixed[2 * i].hit.t, answers[i].hit.t) << "ray " << i;
    ASSERT_EQ(mixed[2 * i].failed, hls::not_failed) << "ray " << i;
    ASSERT_EQ(mixed[2 * i + 1].failed, hls::no_ray) << "behind ray " << i;
  }
  EXPECT_EQ(both.first_difference, "");
}

/// A change of the core's Verilog, and what shows it: a wrong answer, or that the core is not the software's
/// in some cycle.
struct Fault {
  const char *name, *good, *bad;
  bool answers_are_wrong;
};

class FaultyCore : public testing::TestWithParam<Fault> {};

TEST_P(FaultyCore, IsSeen) {
  const Fault& fault = GetParam();
  const CorePicture picture(2, 12);
  const rtl::Core core = rtl::make_core(options_of(12, 1), library());
  BothCores both(core, rtl::replaced(rtl::to_verilog(core, library()), fault.good, fault.bad));
  VerilatedMachine faulty(core, rtl::replaced(rtl::to_verilog(core, library()), fault.good, fault.bad));
  const MemoryOptions memory{.least_latency = 1, .most_latency = 60};
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  CoreBench compared(core, both, picture.image, memory);
  compared.run(picture.rays.jobs, answers);
  EXPECT_NE(both.first_difference, "");

  CoreBench bench(core, faulty, picture.image, memory);
  bool wrong = false;
  try {
    bench.run(picture.rays.jobs, answers);
    wrong = picture.rays.wrong(answers) != 0;
  } catch (const std::logic_error&) {
    wrong = true;
  }
  EXPECT_EQ(wrong, fault.answers_are_wrong);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, FaultyCore,
    testing::Values(
        Fault{"AnswerWithAnothersTag", "tags_word <= tags[leaving_ray]", "tags_word <= tags[ray_1]", true},
        Fault{"TestWithAnothersRay", "origins_word <= origins[rays_word]",
              "origins_word <= origins[reader_1]", true},
        Fault{"LengthOfAnotherRay", "leaf_bests_word <= leaf_bests[leaf_ray]",
              "leaf_bests_word <= leaf_bests[leaf_ray_1]", true},
        Fault{"RequestIsMadeTwice", "assign granted = ~there_2", "assign granted = ~there_1", true},
        Fault{"TIsNothing", "assign hit_t = replies_hit_t;", "assign hit_t = 0;", true},
        Fault{"TIsOneTooMuch", "assign hit_t = replies_hit_t;", "assign hit_t = replies_hit_t + 1;", true},
        Fault{"AnswerWaitsForTheLast", "wire moves = there & ~holds", "wire moves = there & ~there_1",
              false}),
    [](const auto& each) { return each.param.name; });

/// What the bench says of a core whose Verilog has a fault.
std::string complaint_of(const rtl::Core& core, const char* good, const char* bad) {
  const CorePicture picture(2, 12);
  VerilatedMachine faulty(core, rtl::replaced(rtl::to_verilog(core, library()), good, bad));
  CoreBench bench(core, faulty, picture.image, {.least_latency = 1, .most_latency = 60});
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  return message_of<std::logic_error>([&] { bench.run(picture.rays.jobs, answers); });
}

/// 12 rays, of which each may wait for 1002 cycles, 60 cycles of memory, and some.
TEST(CoreBench, SaysThatACoreStandsStill) {
  const rtl::Core core = rtl::make_core(options_of(12, 1), library());
  EXPECT_EQ(complaint_of(core, "assign hit_valid = replies_hit_valid;", "assign hit_valid = 1'b0;"),
            "the core stands still: 22085 cycles without a request or an answer");
}

/// Each ray tests all of them before it has an answer.
TEST(CoreBench, WaitsForManyTrianglesInOnePlace) {
  ref::Scene heap = hills();
  const glm::uvec3 first = heap.mesh.triangles.front();
  heap.mesh.triangles.assign(3'000, first);
  heap.mesh.materials.clear();
  const auto scene =
      std::make_shared<const ref::IntScene>(ref::int_scene(heap, world, {.build = {.max_triangles = 2}}));
  const ref::CoreImage image = ref::core_image(*scene);
  const ref::Mesh::Corners corners = scene->mesh.mesh.corners(0);
  const glm::vec3 middle = (corners.a + corners.b + corners.c) / 3.0F, eye{0, 0.9F, 0};
  const std::vector<AskedRay> asked(64, AskedRay{.ray = {.origin = eye, .direction = middle - eye}});
  const PictureRays rays = listed_rays(scene, image, {world, boxes, 8}, asked);
  const rtl::Core core = rtl::make_core(options_of(64, 3), library());
  NativeCore native(core);
  CoreBench bench(core, native, image, {.least_latency = 20, .most_latency = 20});
  std::vector<CoreAnswer> answers(rays.jobs.size());
  bench.run(rays.jobs, answers);
  EXPECT_EQ(rays.wrong(answers), 0U);
  EXPECT_EQ(answers.front().hit.triangle, 0U) << "of equal ones the first";
  EXPECT_EQ(bench.counts().triangles, 64U * 3'000);
}

TEST(CoreBench, TakesFewTagsAndAddressesThatGoRound) {
  const CorePicture picture(4, 24);
  rtl::CoreOptions options = options_of(12, 2, 12);
  options.byte_bits = 17;
  options.tag_bits = 2;
  const rtl::Core core = rtl::make_core(options, library());
  NativeCore native(core);
  CoreBench bench(core, native, picture.image, {.least_latency = 1, .most_latency = 20}, {.base = 2'000});
  std::vector<CoreAnswer> answers(picture.rays.jobs.size());
  bench.run(picture.rays.jobs, answers);
  expect_right(picture, bench, answers);
}

TEST(CoreBench, RefusesALargeImage) {
  const CorePicture picture(8, 4);
  const rtl::Core core = rtl::make_core(options_of(8, 3, 4), library());
  NativeCore native(core);
  EXPECT_EQ(
      message_of<std::invalid_argument>([&] { CoreBench(core, native, picture.image, {}); }),
      fmt::format("the image has {} blocks, but the core reads 16 at most", picture.image.blocks.size()));
}

}  // namespace
}  // namespace hitpipe::sim::core_bench_test
