// A fit from scene to check, as a program without the command line would call it.
#include "sim/fit/fit_scene.hpp"

#include <mutex>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_EQ(result.unit.verilog, fitted_files(result.unit, library).verilog.contents);
  EXPECT_EQ(read_unit(folder_.path() / "int_slabs", design, library).verilog, result.unit.verilog);
  EXPECT_EQ(steps_, (std::vector<std::string>{"building the hierarchy", "tracing the scene's rays",
                                              "int_slabs: looking for the fewest bits",
                                              "int_slabs: compiling the Verilog",
                                              "int_slabs: sending vectors", "int_slabs: co-simulating"}));
}

TEST_F(FitToScene, WritesNothingWithoutAFolder) {
  FitOptions nowhere = options();
  nowhere.folder.clear();
  const FitScene scene = prepare_fit(hills(), nowhere);
  EXPECT_TRUE(fit_to_scene(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, scene, nowhere,
                           rtl::Library::thesis())
                  .verified());
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(FitToScene, OfASceneThatNoRayMeetsIsRefused) {
  ref::Scene away = hills();
  away.camera.forward = -away.camera.forward;
  try {
    (void)prepare_fit(std::move(away), options());
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::EndsWith(": no ray of the image meets a triangle; a unit fitted to it "
                                                "would be of no use"));
  }
}

TEST_F(FitToScene, IsVerifiedByRightVectorsAndAPictureThatARefereeJudged) {
  const FitScene scene = prepare_fit(hills(), options());
  FitResult result = fit_to_scene(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, scene, options(),
                                  rtl::Library::thesis());
  EXPECT_TRUE(result.verified());
  result.vectors.mismatches = 1;
  EXPECT_FALSE(result.verified());
  result.vectors.mismatches = 0;
  result.image.unit.false_misses = 1;
  EXPECT_FALSE(result.verified());
  result.image.unit.false_misses.reset();  // nobody looked
  EXPECT_FALSE(result.verified());
}

}  // namespace
}  // namespace hitpipe::sim::fit_scene_test
