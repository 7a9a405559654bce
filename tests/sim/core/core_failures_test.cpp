// A core whose image is damaged or whose memory gives errors: each answer is right or says why it has failed.
#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "sim/core/core_bench.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/vector_scenes.hpp"
#include "tests/sim/core/core_pictures.hpp"

namespace hitpipe::sim::core_failures_test {
namespace {

using namespace core_pictures;

/// Answers of a core of 8 rays, for the rays of a picture.
struct Answered {
  CorePicture picture{8, 12};
  std::vector<CoreAnswer> answers;
  CoreCounts counts;

  /// The answers are all the same, but for those that have failed.
  [[nodiscard]] bool agrees_with(const Answered& other) const {
    return std::equal(answers.begin(), answers.end(), other.answers.begin(),
                      [](const CoreAnswer& mine, const CoreAnswer& its) {
                        return mine.failed || its.failed ||
                               (mine.hit.triangle == its.hit.triangle && mine.hit.t == its.hit.t);
                      });
  }

  explicit Answered(const ref::CoreImage& image,
                    const MemoryOptions& memory = {.least_latency = 1, .most_latency = 20},
                    std::uint32_t most_steps = 100, const rtl::CoreOptions& options = options_of(8, 3))
      : answers(picture.rays.jobs.size()) {
    const rtl::Core core = rtl::make_core(options, library());
    NativeCore native(core);
    CoreBench bench(core, native, image, memory, {.most_steps = most_steps});
    bench.run(picture.rays.jobs, answers);
    EXPECT_EQ(bench.memory_counts().outside, 0U);
    counts = bench.counts();
  }
  [[nodiscard]] std::size_t failed(hls::Failure why) const {
    return static_cast<std::size_t>(std::count_if(
        answers.begin(), answers.end(), [&](const CoreAnswer& answer) { return answer.failed == why; }));
  }
  /// Not failed, but not software's.
  [[nodiscard]] std::size_t wrong() const {
    return picture.rays.wrong(answers) - (answers.size() - failed(hls::not_failed));
  }
};

class CoreWithADamagedImage : public testing::Test {
 protected:
  const CorePicture picture_{8, 4};
  ref::CoreImage image_ = picture_.image;
  const ref::CoreRecord root_ = ref::record_of(image_.blocks[0]);
  const ref::CoreRecord first_ = ref::record_of(image_.blocks[root_.pointer]);
  const int grid_ = bits.coord;
};

TEST_F(CoreWithADamagedImage, FailsRaysAtTheirSteps) {
  ref::CoreRecord loop = root_;
  loop.pointer = 0;
  image_.blocks[0] = to_block(loop, grid_);
  const Answered looped(image_, {.least_latency = 1, .most_latency = 20}, 20);
  EXPECT_GT(looped.failed(hls::too_many_steps), 0U);
  EXPECT_EQ(looped.failed(hls::not_failed) + looped.failed(hls::too_many_steps), looped.answers.size());
  EXPECT_LE(looped.counts.records, 20 * looped.counts.rays);
}

TEST_F(CoreWithADamagedImage, FailsRaysAtTheLastLevel) {
  ref::CoreRecord loop = root_;
  loop.pointer = 0;
  image_.blocks[0] = to_block(loop, grid_);
  EXPECT_GT(Answered(image_).failed(hls::too_many_levels), 0U);
}

/// Children behind the image's end, and on it, and so far that a core with few bits of a block's number would take them
/// for some in the image.
TEST_F(CoreWithADamagedImage, FailsRaysThatAreLedOutOfIt) {
  const auto end = static_cast<std::uint32_t>(image_.blocks.size());
  for (const std::uint32_t place :
       {end - 1, end, end + 1'000'000, 0xffff'ffffU, first_.pointer | 1U << 24, first_.pointer | 1U << 31}) {
    ref::CoreRecord away = first_;
    away.pointer = place;
    image_.blocks[root_.pointer] = to_block(away, grid_);
    const Answered led(image_);
    EXPECT_GT(led.failed(hls::outside_image), 0U) << place;
    EXPECT_EQ(led.wrong(), 0U) << place;
  }
}

/// A core whose image is as large as it can read: behind the last block comes the first.
TEST(CoreWithAFullImage, FailsRaysThatAreLedRoundItsEnd) {
  const CorePicture picture(8, 4);
  rtl::CoreOptions options = options_of(8, 3);
  options.address_bits = hls::count_bits(static_cast<int>(picture.image.blocks.size()));
  ref::CoreImage image = picture.image;
  image.blocks.resize(std::size_t{1} << options.address_bits);
  const ref::CoreRecord root = ref::record_of(image.blocks[0]);
  // Child 0 is the last block, and child 1 would be block 0, a right record.
  ref::CoreRecord away = root;
  away.pointer = static_cast<std::uint32_t>(image.blocks.size()) - 1;
  away.counts = {ref::PairChild::branch, ref::PairChild::branch};
  image.blocks.back() = to_block(ref::CoreRecord{.boxes = root.boxes, .pointer = 0}, bits.coord);
  image.blocks[root.pointer] = to_block(away, bits.coord);
  const Answered led(image, {.least_latency = 1, .most_latency = 20}, 100, options);
  EXPECT_GT(led.failed(hls::outside_image), 0U);
  EXPECT_EQ(led.failed(hls::outside_image) + led.failed(hls::not_failed), led.answers.size());
}

/// Zeros, as in a file that was half written.
TEST_F(CoreWithADamagedImage, FailsRaysThatReadNothing) {
  std::fill(image_.blocks.begin() + static_cast<std::ptrdiff_t>(image_.blocks.size() / 2),
            image_.blocks.end(), ref::CoreBlock{});
  const Answered half(image_);
  EXPECT_GT(half.failed(hls::unread_block), 0U);
  EXPECT_GT(half.failed(hls::not_failed), 0U);
  EXPECT_EQ(half.wrong(), 0U);
  image_.blocks.assign(image_.blocks.size(), {});
  EXPECT_EQ(Answered(image_).failed(hls::unread_block), half.answers.size());
}

/// As a core of 12 bits reads it.
TEST_F(CoreWithADamagedImage, FailsAllRaysInAnImageOfAnotherGrid) {
  const ref::IntScene other = ref::int_scene(hills(), {13, 1, 12, 0, 0}, {.build = {.max_triangles = 2}});
  const Answered answered(ref::core_image(other));
  EXPECT_EQ(answered.failed(hls::unread_block), answered.answers.size());
}

/// A triangle where a record is wanted, and a record where a triangle is.
TEST_F(CoreWithADamagedImage, FailsRaysThatReadAnotherKind) {
  const auto last = image_.blocks.end() - (image_.blocks.back() == ref::CoreBlock{} ? 2 : 1);
  const ref::CoreBlock triangle = *last;
  *last = image_.blocks[0];
  const Answered record(image_);
  EXPECT_GT(record.failed(hls::unread_block), 0U);
  EXPECT_EQ(record.wrong(), 0U);
  image_.blocks[root_.pointer] = triangle;
  // Rays that miss the root's box do not read it.
  const Answered triangle_for_record(image_);
  EXPECT_GT(triangle_for_record.failed(hls::unread_block), 100U);
  EXPECT_EQ(triangle_for_record.wrong(), 0U);
}

/// With a unit that tests triangles, or one multiplier.
class NarrowCore : public testing::TestWithParam<bool> {
 protected:
  NarrowCore() { narrow_.serial_triangle = wide_.serial_triangle = GetParam(); }
  [[nodiscard]] Answered narrow(const ref::CoreImage& image, std::uint32_t most_steps = 100) const {
    return Answered(image, memory_, most_steps, narrow_);
  }
  [[nodiscard]] Answered wide(const ref::CoreImage& image, std::uint32_t most_steps = 100) const {
    return Answered(image, memory_, most_steps, wide_);
  }

  const MemoryOptions memory_{.least_latency = 1, .most_latency = 20};
  const CorePicture picture_{8, 4};
  rtl::CoreOptions wide_ = options_of(8, 3), narrow_ = wide_;
};

/// The triangle that most rays meet has the largest number.
TEST_P(NarrowCore, FailsRaysThatReadANumberThatDoesNotFit) {
  narrow_.number_bits = 9;
  const std::uint32_t count = picture_.image.header.triangles;
  ASSERT_EQ(count, 288U);
  std::vector<std::size_t> met(count);
  for (const std::uint32_t triangle : CorePicture(8, 12).rays.triangles)
    if (triangle < count) ++met[triangle];
  const auto first = static_cast<std::uint32_t>(std::max_element(met.begin(), met.end()) - met.begin());
  const auto with_largest = [&](std::uint32_t largest) {
    return renumbered(picture_.image,
                      [&](std::uint32_t number) { return largest - (number + count - first) % count; });
  };
  const ref::CoreImage fits = with_largest(510);
  const Answered all = narrow(fits);
  EXPECT_EQ(all.failed(hls::not_failed), all.answers.size());
  EXPECT_TRUE(all.agrees_with(wide(fits)));
  EXPECT_TRUE(std::any_of(all.answers.begin(), all.answers.end(),
                          [](const CoreAnswer& answer) { return answer.hit.triangle == 510; }));
  // The largest is all ones, or 0 in those bits.
  for (const std::uint32_t largest : {511U, 512U, 0x1'01feU}) {
    const ref::CoreImage large = with_largest(largest);
    const Answered some = narrow(large);
    EXPECT_GT(some.failed(hls::unread_block), 0U) << largest;
    EXPECT_EQ(some.failed(hls::unread_block) + some.failed(hls::not_failed), some.answers.size()) << largest;
    EXPECT_TRUE(some.agrees_with(wide(large))) << largest;
    if (largest <= 512) {
      EXPECT_GT(some.failed(hls::not_failed), 0U) << largest;
    }
  }
}

/// Of a record that is damaged; in two bits these are a record, no child, or a leaf of two.
TEST_P(NarrowCore, FailsRaysThatReadACountThatDoesNotFit) {
  narrow_.leaf_bits = 2;
  const Answered all = narrow(picture_.image);
  EXPECT_EQ(all.failed(hls::not_failed), all.answers.size());
  EXPECT_EQ(all.wrong(), 0U);
  const ref::CoreRecord root = ref::record_of(picture_.image.blocks[0]);
  const ref::CoreRecord first = ref::record_of(picture_.image.blocks[root.pointer]);
  for (const std::size_t child : {0U, 1U})
    for (const int count : child == 0 ? std::vector{3, 6} : std::vector{4, 254}) {
      ref::CoreImage image = picture_.image;
      ref::CoreRecord large = first;
      large.counts.at(child) = count;
      image.blocks[root.pointer] = to_block(large, bits.coord);
      const Answered led = narrow(image);
      EXPECT_GT(led.failed(hls::outside_image), 0U) << count;
      EXPECT_EQ(led.failed(hls::outside_image) + led.failed(hls::not_failed), led.answers.size()) << count;
      EXPECT_EQ(led.wrong(), 0U) << count;
    }
}

/// All triangles are in one leaf.
TEST_P(NarrowCore, ReadsTheLargestLeafThatFits) {
  narrow_.leaf_bits = 3;
  ref::Scene heap = hills();
  heap.mesh.materials.clear();
  for (const int count : {6, 7}) {
    heap.mesh.triangles.resize(1);
    heap.mesh.triangles.resize(static_cast<std::size_t>(count), heap.mesh.triangles.front());
    const auto scene = std::make_shared<const ref::IntScene>(
        ref::int_scene(heap, world, {.build = {.max_triangles = count}}));
    const ref::CoreImage image = ref::core_image(*scene);
    ASSERT_EQ(image.header.most_in_leaf, count);
    const ref::Mesh::Corners corners = scene->mesh.mesh.corners(0);
    const glm::vec3 middle = (corners.a + corners.b + corners.c) / 3.0F, eye{0, 0.9F, 0};
    const std::vector<AskedRay> asked(8, AskedRay{.ray = {.origin = eye, .direction = middle - eye}});
    const PictureRays rays = listed_rays(scene, image, {world, boxes, 8}, asked);
    const rtl::Core core = rtl::make_core(narrow_, library());
    NativeCore native(core);
    CoreBench bench(core, native, image, memory_);
    std::vector<CoreAnswer> answers(rays.jobs.size());
    bench.run(rays.jobs, answers);
    for (const CoreAnswer& answer : answers) {
      EXPECT_EQ(answer.failed, count == 6 ? hls::not_failed : hls::outside_image);
      if (count == 6) {
        EXPECT_EQ(answer.hit.triangle, 0U);
      }
    }
    EXPECT_EQ(bench.counts().triangles, count == 6 ? 8U * 6 : 0U);
  }
}

/// A register with a larger number than the core can count to is the largest that it can.
TEST_P(NarrowCore, FailsRaysAtItsLargestStep) {
  narrow_.step_bits = 4;
  const Answered usual = wide(picture_.image, 15);
  ASSERT_GT(usual.failed(hls::too_many_steps), 0U);
  ASSERT_GT(usual.failed(hls::not_failed), 0U);
  for (const std::uint32_t most : {15U, 16U, 100U, (1U << 20) - 1}) {
    const Answered few = narrow(picture_.image, most);
    EXPECT_EQ(few.failed(hls::too_many_steps), usual.failed(hls::too_many_steps)) << most;
    EXPECT_EQ(few.failed(hls::not_failed), usual.failed(hls::not_failed)) << most;
    EXPECT_EQ(few.counts.records, usual.counts.records) << most;
    EXPECT_EQ(few.wrong(), 0U) << most;
  }
  EXPECT_GT(narrow(picture_.image, 14).failed(hls::too_many_steps), usual.failed(hls::too_many_steps));
}

INSTANTIATE_TEST_SUITE_P(Tests, NarrowCore, testing::Bool(),
                         [](const auto& each) { return each.param ? "Serial" : "Unit"; });

class CoreWithErrors : public testing::TestWithParam<bool> {};

/// Every answer is right or has failed, with a triangle unit and with one multiplier.
TEST_P(CoreWithErrors, OfMemoryGivesNoWrongAnswer) {
  rtl::CoreOptions options = options_of(8, 3);
  options.serial_triangle = GetParam();
  const CorePicture picture(8, 12);
  const Answered answered(picture.image, {.least_latency = 1, .most_latency = 20, .error_percent = 2},
                          (1U << 20) - 1, options);
  EXPECT_GT(answered.failed(hls::unread_block), 10U);
  EXPECT_GT(answered.failed(hls::not_failed), 10U);
  EXPECT_EQ(answered.failed(hls::unread_block) + answered.failed(hls::not_failed), answered.answers.size());
  EXPECT_EQ(answered.wrong(), 0U);
}
INSTANTIATE_TEST_SUITE_P(Tests, CoreWithErrors, testing::Bool(),
                         [](const auto& each) { return each.param ? "Serial" : "Unit"; });

}  // namespace
}  // namespace hitpipe::sim::core_failures_test
