// A core that is fitted to scenes, as a program without the command line would call it.
#include "sim/fit/core_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/core/feature.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/native_core.hpp"
#include "sim/fit/world_search.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::core_fit_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CoreFitOptions small() {
  CoreFitOptions options;
  options.width = options.height = 16;
  options.memory = memory_port("dram");
  return options;
}

rtl::CoreOptions with_rays(int rays, int interval) {
  rtl::CoreOptions core;
  core.rays = rays;
  rtl::core_option("--triangle-ii").set(core, interval);
  return core;
}

/// Answers of the fitted core that are not software's, in all scenes.
std::uint64_t wrong(const CoreFit& fit, const CoreFitOptions& options, const rtl::Library& library) {
  const rtl::Core core = rtl::make_core(fit.core, library);
  std::uint64_t count = 0;
  for (const CoreFitScene& scene : fit.scenes) {
    NativeCore machine(core);
    const PictureRays rays = picture_rays(
        scene.scene, scene.image,
        {.world = fit.core.bits.world(), .boxes = fit.core.bits.boxes(), .places = 1 << fit.core.stack_bits},
        {.width = options.width, .height = options.height});
    const CoreTrace trace =
        trace_core(core, machine, scene.image, rays, memory_behind(options.memory, fit.core));
    count += trace.wrong + (trace.same_reads ? 0 : 1);
  }
  return count;
}

TEST(CoreFit, IsSmallerThanTheDefaultCoreAndRight) {
  const rtl::Library& library = rtl::Library::thesis();
  const CoreFitOptions options = small();
  const CoreFit fit = fit_core({hills()}, options, library);
  EXPECT_LT(size_of(fit.price.all, library), size_of(fit.price_before.all, library));
  EXPECT_EQ(wrong(fit, options, library), 0U);
  ASSERT_FALSE(fit.tried.empty());
  for (const TriedWorld& each : fit.tried) {
    if (each.taken) {
      EXPECT_LE(each.worst().percent_interval().high, options.error_pct);
      EXPECT_GE(each.worst().whole, rays_that_tell(options.error_pct))
          << "a picture of 16 x 16 tells nothing";
    }
  }
}

TEST(CoreFit, ComparesAsManyRaysAsTheErrorNeeds) {
  for (const double error_pct : {0.01, 0.05, 1.0, 50.0}) {
    const std::uint64_t rays = rays_that_tell(error_pct).value();
    const auto half = static_cast<std::uint64_t>(error_pct / 200 * static_cast<double>(rays));
    const ref::Share differ{half, rays};
    EXPECT_NEAR(differ.percent_interval().high / error_pct, 1, 0.12) << error_pct;
  }
  EXPECT_FALSE(rays_that_tell(0)) << "no number of rays tells that none differs";
}

TEST(CoreFit, WidthsAreTheLeastThatHoldTheImages) {
  CoreFitOptions options = small();
  options.fixed.world = options.fixed.boxes = options.fixed.rays = options.fixed.triangles = true;
  options.core.bits = {12, 0, 8, 0, 12, 0};
  const CoreFit fit = fit_core({hills()}, options, rtl::Library::thesis());
  const ref::CoreHeader& header = fit.scenes.front().image.header;
  EXPECT_EQ(fit.core.bits, options.core.bits);
  EXPECT_EQ(fit.core.levels, header.levels);
  // All ones is no triangle, and a record.
  EXPECT_LT(header.in_source(), std::uint64_t{1} << fit.core.number_bits);
  EXPECT_GE(header.in_source(), std::uint64_t{1} << (fit.core.number_bits - 1));
  EXPECT_LT(header.most_in_leaf, (1 << fit.core.leaf_bits) - 1);
  EXPECT_LE(fit.scenes.front().image.blocks.size(), std::size_t{1} << fit.core.address_bits);
  EXPECT_GT(fit.scenes.front().image.blocks.size(), std::size_t{1} << (fit.core.address_bits - 1));
  EXPECT_EQ(wrong(fit, options, rtl::Library::thesis()), 0U);
}

TEST(CoreFit, EachCutSaysWhatTheCoreWouldTakeWithoutIt) {
  CoreFitOptions options = small();
  options.fixed.world = options.fixed.rays = options.fixed.triangles = true;
  options.core.bits = {12, 0, 11, 0, 12, 0};
  const rtl::Library& library = rtl::Library::thesis();
  const CoreFit fit = fit_core({hills()}, options, library);
  ASSERT_FALSE(fit.cuts.empty());
  for (const CoreCut& cut : fit.cuts) {
    EXPECT_FALSE(cut.why.empty()) << cut.what;
    const area::CorePrice price = area::price(rtl::make_core(cut.before, library), library);
    EXPECT_EQ(size_of(cut.without, library), size_of(price.all, library)) << cut.what;
  }
  EXPECT_THAT(fit.cuts.front().what, HasSubstr("12+0s12 of 20+1s20"));
}

TEST(CoreFit, ReachesTheRateWithTheLeastSize) {
  CoreFitOptions options = small();
  options.fixed.world = options.fixed.boxes = true;
  options.core.bits = {12, 0, 8, 0, 12, 0};
  const rtl::Library& library = rtl::Library::thesis();
  const CoreFit least = fit_core({hills()}, options, library);
  options.rays_per_second = 4 * least.rate.rays_per_second();
  const CoreFit faster = fit_core({hills()}, options, library);
  EXPECT_GE(faster.rate.rays_per_second(), options.rays_per_second);
  EXPECT_GT(size_of(faster.price.all, library), size_of(least.price.all, library));
  EXPECT_EQ(wrong(faster, options, library), 0U);
}

TEST(CoreFit, ForTheRateIsNoWorseThanTheDefaultCore) {
  CoreFitOptions options = small();
  options.goal = CoreGoal::rate;
  options.fixed.triangles = true;
  const rtl::Library& library = rtl::Library::thesis();
  const CoreFit fit = fit_core({hills()}, options, library);
  const auto gain = [&](const CoreRate& rate, const area::CorePrice& price) {
    return rate.rays_per_second() / static_cast<double>(size_of(price.all, library));
  };
  EXPECT_GE(gain(fit.rate, fit.price), gain(fit.rate_before, fit.price_before));
}

TEST(CoreFit, RefusesWhatNoCoreReaches) {
  const rtl::Library& library = rtl::Library::thesis();
  CoreFitOptions options = small();
  options.fixed.world = options.fixed.boxes = true;
  options.core.bits = {12, 0, 8, 0, 12, 0};
  options.core.levels = 3;
  options.fixed.levels = true;
  EXPECT_THAT(message_of([&] { (void)fit_core({hills()}, options, library); }),
              AllOf(HasSubstr("--levels 3"), HasSubstr("the scenes need")));
  options.fixed.levels = false;
  options.core = with_rays(2, 4);
  options.core.bits = {12, 0, 8, 0, 12, 0};
  options.fixed.rays = options.fixed.triangles = true;
  options.rays_per_second = 1e12;
  EXPECT_THAT(message_of([&] { (void)fit_core({hills()}, options, library); }),
              AllOf(HasSubstr("--rate-rays"), HasSubstr("no core reaches it")));
}

}  // namespace
}  // namespace hitpipe::sim::core_fit_test
