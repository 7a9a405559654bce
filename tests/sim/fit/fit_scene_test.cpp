// A fit from scene to check, as a program without the command line would call it.
#include "sim/fit/fit_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/emit/read_unit.hpp"
#include "sim/unit/unit_set_up.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::fit_scene_test {
namespace {

class FitToScene : public testing::Test {
 protected:
  [[nodiscard]] FitOptions options() {
    return {.width = 24,
            .height = 16,
            .threads = 2,
            .keep_bits = true,
            .vectors = 500,
            .folder = folder_.path(),
            .progress = [this](const std::string& step, double share) { told(step, share); }};
  }
  void told(const std::string& step, double share) {
    const std::scoped_lock lock(telling_);
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    if (steps_.empty() || steps_.back() != step) {
      EXPECT_EQ(share, 0.0) << step;
      steps_.push_back(step);
    }
  }

  const TemporaryFolder folder_;
  std::mutex telling_;
  std::vector<std::string> steps_;
};

TEST_F(FitToScene, ProvesTheUnitAndWritesItsFiles) {
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::Design& design = rtl::find_design("int_slabs");
  const FitScene scene = prepare_fit(hills(), options());
  EXPECT_GT(scene.rays.counts.total().rays, 24U * 16U);
  const FitResult result = fit_to_scene(design, hls::IntBits{12, 12}, scene, options(), library);
  EXPECT_TRUE(result.verified());
  EXPECT_EQ(result.vectors.vectors, 500U);
  EXPECT_EQ(result.image.rays_primary, 24U * 16U);
  EXPECT_EQ(result.image.unit.false_misses, 0U);
  EXPECT_GT(result.unit.saved_um2(), 0);
  for (std::size_t i = 1; i < result.unit.left_out.size(); ++i)
    EXPECT_GE(result.unit.left_out[i - 1].area_um2, result.unit.left_out[i].area_um2);
  const rtl::Unit read = rtl::read_unit(folder_.path() / "int_slabs", design, library);
  EXPECT_EQ(read.verilog, rtl::with_licence({"u.v", result.unit.verilog}).contents);
  EXPECT_EQ(read.demands, result.unit.demands);
  EXPECT_EQ(steps_, (std::vector<std::string>{"building the hierarchy", "tracing the scene's rays",
                                              "int_slabs: looking for the fewest bits",
                                              "int_slabs: compiling the Verilog",
                                              "int_slabs: sending vectors", "int_slabs: co-simulating"}));
}

/// The longest interval whose unit traces so many rays, and it is verified as any other.
TEST_F(FitToScene, MakesTheSmallestUnitThatTracesSoManyRays) {
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::Design& design = rtl::find_design("int_slabs");
  FitOptions asked = options();
  const FitScene scene = prepare_fit(hills(), asked);
  const FitResult fastest = fit_to_scene(design, hls::IntBits{12, 12}, scene, asked, library);
  asked.rays_per_second = fastest.rays_per_second / 3.5;
  const FitResult result = fit_to_scene(design, hls::IntBits{12, 12}, scene, asked, library);
  EXPECT_EQ(result.unit.price.interval, 3);
  EXPECT_GE(result.rays_per_second, asked.rays_per_second);
  EXPECT_TRUE(result.verified());
  EXPECT_EQ(result.image.unit.hits, fastest.image.unit.hits);
  EXPECT_LT(result.unit.price.area_um2, fastest.unit.price.area_um2);
  const auto rate = std::ranges::find(result.unit.left_out, "rate: a test every 3 cycles", &LeftOut::what);
  ASSERT_NE(rate, result.unit.left_out.end());
  EXPECT_GT(rate->area_um2, 0);
  EXPECT_EQ(rtl::read_unit(folder_.path() / "int_slabs", design, library).interval(), 3);
  asked.rays_per_second = 2 * fastest.rays_per_second;
  EXPECT_THAT(message_of([&] {
                (void)fit_to_scene(design, hls::IntBits{12, 12}, scene, asked, library);
              }),
              testing::MatchesRegex("int_slabs 12/12: .* million boxes a second are asked for; it takes .* "
                                    "million at most"));
}

/// The area of the smallest fitted int_slabs of up to 10/10 at this rate, or with `rays` at the rate that so
/// many rays a second need. No unit has more extra box tests than `limit_pct`.
std::int64_t smallest_of_all(const FitScene& scene, FitRate rate, double rays, double limit_pct) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const PrecisionSearch search{.design = &design,
                               .scene = &scene.scene,
                               .bvh = &scene.bvh,
                               .demands = &scene.demands,
                               .rays = &scene.rays,
                               .most = hls::IntBits{10, 10}};
  const double tests_per_ray = static_cast<double>(scene.rays.counts.total().box_tests) /
                               static_cast<double>(scene.rays.counts.total().rays);
  std::int64_t smallest = std::numeric_limits<std::int64_t>::max();
  for (int n = hls::IntBits::min_coord; n <= 10; ++n) {
    for (int t = hls::IntBits::min_interval; t <= std::min(10, 2 * n - 1); ++t) {
      const hls::IntBits format{n, t};
      const double extra_pct = extra_box_tests_pct(search, format);
      if (extra_pct > limit_pct) continue;
      if (rays > 0) rate.boxes_per_second = rays * tests_per_ray * (1 + extra_pct / 100);
      const auto price =
          price_of_fit(design, {.format = format}, scene.demands, rtl::Library::thesis(), rate);
      if (price) smallest = std::min(smallest, price->area_um2);
    }
  }
  return smallest;
}

/// Of all formats, and not the one of the least whole cost.
TEST_F(FitToScene, ARateTakesTheSmallestUnitOfAnyFormat) {
  FitOptions asked = options();
  asked.keep_bits = false;
  asked.folder.clear();
  asked.vectors = 0;
  asked.cost = [](const PricedTests& unit) {
    return static_cast<double>(unit.price.area_um2) * static_cast<double>(unit.tests.box_tests);
  };
  const FitScene scene = prepare_fit(hills(), asked);
  const auto fitted = [&] {
    return fit_to_scene(rtl::find_design("int_slabs"), hls::IntBits{10, 10}, scene, asked,
                        rtl::Library::thesis());
  };
  asked.rays_per_second = 1'000'000;
  const FitResult of_rays = fitted();
  EXPECT_GE(of_rays.rays_per_second, asked.rays_per_second);
  // A unit is not full all the time. Those with a tenth to spare are fast enough.
  EXPECT_LE(of_rays.unit.price.area_um2, smallest_of_all(scene, {}, asked.rays_per_second / 0.9, 1e9));
  asked.rays_per_second = 0;
  asked.rate.boxes_per_second = 100e6;
  asked.overhead_pct = 20;
  const FitResult of_boxes = fitted();
  EXPECT_GE(of_boxes.unit.price.boxes_per_second(), 100'000'000);
  ASSERT_TRUE(of_boxes.unit.precision) << "10/10 is within the limit";
  EXPECT_LE(of_boxes.unit.precision->coarse_extra_box_tests_pct, asked.overhead_pct);
  EXPECT_LE(of_boxes.unit.price.area_um2, smallest_of_all(scene, asked.rate, 0, asked.overhead_pct));
}

TEST_F(FitToScene, WritesNothingWithoutAFolderAndIsVerified) {
  FitOptions nowhere = options();
  nowhere.folder.clear();
  const FitScene scene = prepare_fit(hills(), nowhere);
  FitResult result = fit_to_scene(rtl::find_design("int_slabs"), hls::IntBits{10, 10}, scene, nowhere,
                                  rtl::Library::thesis());
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  // Vectors must be right, and a referee must have judged the picture.
  EXPECT_TRUE(result.verified());
  result.vectors.mismatches = 1;
  EXPECT_FALSE(result.verified());
  result.vectors.mismatches = 0;
  result.image.unit.false_misses = 1;
  EXPECT_FALSE(result.verified());
  result.image.unit.false_misses.reset();
  EXPECT_FALSE(result.verified());
}

TEST_F(FitToScene, OfASceneThatNoRayMeetsIsRefused) {
  ref::Scene away = hills();
  away.camera.forward = -away.camera.forward;
  EXPECT_THAT(
      message_of([&] { (void)prepare_fit(std::move(away), options()); }),
      testing::EndsWith(": no ray of the image meets a triangle; a unit fitted to it would be of no use"));
}

TEST(WholeUnit, IsWhatIsWrittenOfTheDesign) {
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Unit unit = rtl::make_unit(design, hls::IntBits{12, 12}, library);
  EXPECT_TRUE(unit.demands.empty());
  EXPECT_TRUE(takes_ends(unit));
  EXPECT_FALSE(coarse_axes(unit).any());
  const TemporaryFolder folder;
  host::write_files(folder.path(), rtl::emit(unit).files());
  const rtl::Unit read = rtl::read_unit(folder.path(), design, library);
  EXPECT_EQ(read.verilog, rtl::with_licence({"u.v", unit.verilog}).contents);
  EXPECT_EQ(read.pipeline->latency(), unit.pipeline->latency());
}

}  // namespace
}  // namespace hitpipe::sim::fit_scene_test
