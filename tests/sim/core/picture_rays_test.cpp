// Which answers of a core are software's. The rays keep the scene that judges them.
#include "sim/core/picture_rays.hpp"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "rays/world/int_ray.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::picture_rays_test {
namespace {

const hls::WorldBits world{12, 0, 12};

/// Right answers to all rays of a picture, whose scene nobody else keeps.
class Answers : public testing::Test {
 protected:
  Answers() {
    for (std::size_t i = 0; i < rays_.jobs.size(); ++i) {
      CoreAnswer& answer = answers_.emplace_back();
      const ref::IntRay ray = ref::int_ray(rays_.jobs[i].ray, world);
      answer.hit = {rays_.triangles[i], ray.length};
      if (!answer.hit.found()) continue;
      const auto crossing = ref::int_crossing(ray, mesh_.triangles[answer.hit.triangle], world).value();
      answer.hit.t = crossing.t;
      answer.weights = CoreWeights{crossing.det, crossing.e[1], -crossing.e[2]};
    }
  }
  static PictureRays made() {
    const auto scene = std::make_shared<const ref::IntScene>(
        ref::int_scene(hills(), world, {.build = ref::surface_area_build}));
    return picture_rays(scene, ref::core_image(*scene), {.world = world, .boxes = {12, 0, 7, 0, 12}},
                        {.width = 24, .height = 24});
  }
  /// The first answer to such a ray.
  CoreAnswer& first(bool any, bool hit) {
    for (std::size_t i = 0; i < answers_.size(); ++i)
      if (rays_.jobs[i].any == any && answers_[i].hit.found() == hit) return answers_[i];
    throw std::logic_error("the picture has no such ray");
  }
  [[nodiscard]] std::uint64_t wrong() const { return rays_.wrong(answers_); }

  PictureRays rays_ = made();
  ref::IntMesh mesh_ = ref::int_mesh(hills().mesh, world.coord);
  std::vector<CoreAnswer> answers_;
};

TEST_F(Answers, OfSoftwareAreRight) {
  EXPECT_GT(answers_.size(), 500U);
  EXPECT_EQ(wrong(), 0U);
}

TEST_F(Answers, ToANearestRayHaveItsTriangleAndT) {
  ++first(false, true).hit.t;
  EXPECT_EQ(wrong(), 1U);
  --first(false, false).hit.t;
  EXPECT_EQ(wrong(), 2U) << "without a hit T is the length";
  first(false, true).hit = {};
  EXPECT_EQ(wrong(), 2U);
}

TEST_F(Answers, ToARayForAnyHitHaveATriangleThatItMeets) {
  CoreAnswer& hit = first(true, true);
  ++hit.hit.t;
  EXPECT_EQ(wrong(), 0U) << "T is not promised";
  hit.hit.triangle = static_cast<std::uint32_t>(mesh_.triangles.size());
  EXPECT_EQ(wrong(), 1U) << "there is no such triangle";
  hit.hit.triangle = 0;
  EXPECT_EQ(wrong(), 1U) << "the ray does not meet it";
  hit.hit.triangle = ref::IntHit::none;
  EXPECT_EQ(wrong(), 1U);
}

TEST_F(Answers, HaveTheWeightsOfTheirTriangle) {
  for (const bool any : {false, true}) ++first(any, true).weights->u;
  EXPECT_EQ(wrong(), 2U);
  first(false, true).weights.reset();
  EXPECT_EQ(wrong(), 1U) << "not every core gives them";
}

}  // namespace
}  // namespace hitpipe::sim::picture_rays_test
