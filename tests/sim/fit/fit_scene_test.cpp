// A fit from scene to check, as a program without the command line would call it.
#include "sim/fit/fit_scene.hpp"

#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
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
  EXPECT_GT(scene.rays.count(), 24U * 16U);
  const FitResult result = fit_to_scene(design, hls::IntBits{12, 12}, scene, options(), library);
  EXPECT_TRUE(result.verified());
  EXPECT_EQ(result.vectors.vectors, 500U);
  EXPECT_EQ(result.image.rays_primary, 24U * 16U);
  EXPECT_EQ(result.image.unit.false_misses, 0U);
  EXPECT_GT(result.unit.saved_um2(), 0);
  for (std::size_t i = 1; i < result.unit.left_out.size(); ++i)
    EXPECT_GE(result.unit.left_out[i - 1].area_um2, result.unit.left_out[i].area_um2);
  const Unit read = read_unit(folder_.path() / "int_slabs", design, library);
  EXPECT_EQ(read.verilog, result.unit.verilog);
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
  EXPECT_EQ(read_unit(folder_.path() / "int_slabs", design, library).pipeline.interval(), 3);
  asked.rays_per_second = 2 * fastest.rays_per_second;
  EXPECT_THAT(message_of([&] {
                (void)fit_to_scene(design, hls::IntBits{12, 12}, scene, asked, library);
              }),
              testing::MatchesRegex("int_slabs 12/12: .* million boxes a second are asked for; it takes .* "
                                    "million at most"));
}

TEST_F(FitToScene, WritesNothingWithoutAFolderAndIsVerified) {
  FitOptions nowhere = options();
  nowhere.folder.clear();
  const FitScene scene = prepare_fit(hills(), nowhere);
  FitResult result = fit_to_scene(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, scene, nowhere,
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
  const Unit unit = make_unit(design, hls::IntBits{12, 12}, library);
  EXPECT_TRUE(unit.demands.empty());
  EXPECT_TRUE(unit.ends);
  EXPECT_FALSE(unit.coarse.any());
  const TemporaryFolder folder;
  host::write_files(folder.path(), rtl::emit(design, hls::IntBits{12, 12}, library,
                                             rtl::make_pipeline(design.trace(hls::IntBits{12, 12}), library))
                                       .files());
  const Unit read = read_unit(folder.path(), design, library);
  EXPECT_EQ(read.verilog, unit.verilog);
  EXPECT_EQ(read.pipeline.latency(), unit.pipeline.latency());
}

}  // namespace
}  // namespace hitpipe::sim::fit_scene_test
