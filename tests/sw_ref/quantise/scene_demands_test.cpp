// What a scene demands: its rays and boxes meet the demands, and a scene with less demands less.
#include "sw_ref/quantise/scene_demands.hpp"

#include <bit>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "rays/trace/child_order.hpp"
#include "sw_ref/quantise/guard.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::ref::scene_demands_test {
namespace {

Scene glass_hills() {
  Scene scene = sim::hills();
  scene.materials = {{glm::vec3(0.2F), glm::vec3(0.3F, 0.2F, 0.1F), glm::vec3(0.5F), 1.4F}};
  return scene;
}

SceneDemands demands_of(const Scene& scene, const ViewOptions& view = {64, 48}) {
  return scene_demands(scene, build_bvh(scene.mesh), view);
}

struct NamedScene {
  const char* name;
  Scene (*make)();
};
void PrintTo(const NamedScene& scene, std::ostream* out) {
  *out << scene.name;
}

class Demanded : public testing::TestWithParam<NamedScene> {};

TEST_P(Demanded, AreAllRaysOfTheImage) {
  const Scene scene = GetParam().make();
  const Bvh bvh = build_bvh(scene.mesh);
  const SceneDemands demands = scene_demands(scene, bvh, {64, 48});
  const auto tracer = make_tracer(scene.mesh, bvh, {});
  RenderOptions options{.width = 64, .height = 48};
  std::uint64_t checked = 0;
  options.traced = [&](RayKind kind, const TraceJob& job) {
    for (const Ray& ray : job.rays) {
      EXPECT_NO_THROW(check_ray_against(demands, kind, ray))
          << std::hexfloat << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z;
      EXPECT_NE(demands.classes() >> direction_class(ray.direction) & 1U, 0U);
      ++checked;
    }
  };
  const RenderCounts counts = render(scene, *tracer, options).counts;
  EXPECT_EQ(checked, counts.total().rays);
  EXPECT_GE(checked, 64U * 48U);
  EXPECT_EQ(demands.has(RayKind::shadow), counts.shadow.rays > 0);
  EXPECT_EQ(demands.has(RayKind::secondary), counts.secondary.rays > 0);
}

TEST_P(Demanded, AreAllBoxes) {
  const Scene scene = GetParam().make();
  const Bvh bvh = build_bvh(scene.mesh);
  const SceneDemands demands = scene_demands(scene, bvh, {});
  for (const BvhNode& node : bvh.nodes) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(node.box.min[axis], demands.boxes.min[axis]);
      EXPECT_LE(node.box.max[axis], demands.boxes.max[axis]);
      EXPECT_GE(node.box.max[axis] - node.box.min[axis], demands.smallest_extent[axis]);
    }
    EXPECT_LE(node.count, demands.most_in_leaf);
  }
  EXPECT_EQ(demands.deepest, bvh.depth);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Demanded,
                         testing::Values(NamedScene{"hills", sim::hills}, NamedScene{"glass", glass_hills},
                                         NamedScene{"unlit", unlit_hills}, NamedScene{"table", table_top},
                                         NamedScene{"flat", flat_hills},
                                         NamedScene{"stairs", stairs_along_one_class},
                                         NamedScene{"octahedron", demanding_octahedron},
                                         NamedScene{"plan", plan_of_hills},
                                         NamedScene{"slanted", slanted_hills}),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(RayKinds, FollowFromLightsMaterialsAndBounces) {
  EXPECT_FALSE(demands_of(unlit_hills()).has(RayKind::shadow));
  EXPECT_TRUE(demands_of(sim::hills()).has(RayKind::shadow));
  EXPECT_FALSE(demands_of(sim::hills()).has(RayKind::secondary));
  EXPECT_TRUE(demands_of(glass_hills()).has(RayKind::secondary));
  EXPECT_FALSE(demands_of(glass_hills(), {64, 48, {.bounces = 0}}).has(RayKind::secondary));

  Scene dark = sim::hills();
  for (Light& light : dark.lights) light.intensity = glm::vec3(0.0F);
  EXPECT_FALSE(demands_of(dark).has(RayKind::shadow));

  Scene unused = sim::hills();
  unused.materials.push_back({glm::vec3(0.0F), glm::vec3(1.0F), glm::vec3(0.0F), 1.0F});
  unused.mesh.materials.assign(unused.mesh.triangles.size(), 0);
  EXPECT_FALSE(demands_of(unused).has(RayKind::secondary));
  unused.mesh.materials.back() = 1;
  EXPECT_TRUE(demands_of(unused).has(RayKind::secondary));
}

TEST(RayKinds, OfRandomDirectionsAreBounded) {
  const ViewOptions view{64, 48, {.bounces = 2, .diffuse = 1, .occlusion = 2}};
  const Scene scene = unlit_hills();
  const Bvh bvh = build_bvh(scene.mesh);
  const SceneDemands demands = scene_demands(scene, bvh, view);
  EXPECT_TRUE(demands.has(RayKind::secondary));
  EXPECT_TRUE(demands.has(RayKind::shadow));
  EXPECT_EQ(demands.classes(), 255U);
  EXPECT_THAT(demands.evidence().at(1).why,
              testing::HasSubstr("; shadow rays to what is near end beyond it"));
  RenderOptions options{.width = 64, .height = 48, .light = view.light};
  options.traced = [&](RayKind kind, const TraceJob& job) {
    for (const Ray& ray : job.rays) EXPECT_NO_THROW(check_ray_against(demands, kind, ray));
  };
  const RenderCounts counts = render(scene, *make_tracer(scene.mesh, bvh, {}), options).counts;
  EXPECT_GT(counts.secondary.rays, 0U);
  EXPECT_GT(counts.shadow.rays, 0U);
}

TEST(DirectionClasses, OfStairsSeenAndLitAlongOne) {
  const SceneDemands demands = demands_of(stairs_along_one_class());
  ASSERT_TRUE(demands.has(RayKind::shadow));
  EXPECT_EQ(demands.classes(), 1U << 4U);  // +x, +y, -z
  for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(demands.can_be_zero(axis));
  EXPECT_TRUE(std::isfinite(demands.spread()));
}

TEST(DirectionClasses, OfWavesIsOneAndTheyShadeEachOther) {
  const Scene scene = load_scene("waves");
  const Bvh bvh = build_bvh(scene.mesh);
  const SceneDemands demands = scene_demands(scene, bvh, {});
  EXPECT_EQ(demands.classes(), 1U << 4U);  // +x, +y, -z
  for (int axis = 0; axis < 3; ++axis) EXPECT_FALSE(demands.can_be_zero(axis));
  EXPECT_FALSE(demands.has(RayKind::secondary));
  RenderOptions options{.width = 64, .height = 64};
  std::size_t rays = 0;
  std::size_t shaded = 0;
  options.traced = [&](RayKind kind, const TraceJob& job) {
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      EXPECT_NO_THROW(check_ray_against(demands, kind, job.rays[i]));
      if (kind != RayKind::shadow) continue;
      ++rays;
      shaded += job.triangles[i] != Hit::none ? 1 : 0;
    }
  };
  (void)render(scene, *make_tracer(scene.mesh, bvh, {}), options);
  EXPECT_GT(shaded, rays / 10) << rays;
  EXPECT_LT(shaded, rays * 9 / 10) << rays;
}

TEST(DirectionClasses, OfAnOrthographicCameraIsItsOwn) {
  Scene scene = slanted_hills();
  scene.lights.clear();
  ASSERT_GT(std::popcount(demands_of(unlit_hills()).classes()), 1);
  const SceneDemands demands = demands_of(scene);
  EXPECT_EQ(demands.classes(), 1U << direction_class(glm::vec3(scene.camera.forward)));
  ASSERT_EQ(demands.rays.size(), 1U);
  EXPECT_EQ(demands.rays[0].direction.min, glm::vec3(scene.camera.forward));
  EXPECT_EQ(demands.rays[0].direction.max, glm::vec3(scene.camera.forward));
}

TEST(DirectionClasses, OfASunIsItsOwn) {
  const SceneDemands demands = demands_of(plan_of_hills());
  ASSERT_EQ(demands.rays.size(), 2U);
  EXPECT_EQ(demands.rays[0].direction.min, glm::vec3(0.0F, -1.0F, 0.0F));
  EXPECT_EQ(demands.rays[0].direction.max, glm::vec3(0.0F, -1.0F, 0.0F));
  EXPECT_EQ(demands.rays[1].kind, RayKind::shadow);
  EXPECT_EQ(demands.rays[1].direction.min, glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(demands.rays[1].direction.max, glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_TRUE(demands.can_be_zero(0));
  EXPECT_FALSE(demands.can_be_zero(1));
  EXPECT_TRUE(demands.can_be_zero(2));
}

TEST(DirectionClasses, AreAllWithMirrors) {
  EXPECT_EQ(demands_of(demanding_octahedron()).classes(), 0xFFU);
}

TEST(Origins, AreTheEyeOfPrimaryRaysAlone) {
  const Scene scene = unlit_hills();
  const Aabb origins = demands_of(scene).origins();
  EXPECT_EQ(origins.min, scene.camera.eye);
  EXPECT_EQ(origins.max, scene.camera.eye);
}

TEST(Origins, OfAnOrthographicCameraAreTheRectangleOfItsImage) {
  Scene scene = plan_of_hills();
  scene.lights.clear();
  const Aabb origins = demands_of(scene, {64, 48}).origins();
  EXPECT_EQ(origins.min.y, 0.9F);
  EXPECT_EQ(origins.max.y, 0.9F);
  constexpr float rounding = 1e-6F;
  EXPECT_NEAR(origins.max.x, 0.4F * 64 / 48, rounding);
  EXPECT_NEAR(origins.min.x, -0.4F * 64 / 48, rounding);
  EXPECT_NEAR(origins.max.z, 0.4F, rounding);
  EXPECT_NEAR(origins.min.z, -0.4F, rounding);
}

TEST(Origins, OfAnImageThatIsLargerThanTheCubeAreAllOfIt) {
  Scene scene = plan_of_hills();
  scene.lights.clear();
  const Aabb origins = demands_of(scene, {128, 48}).origins();
  EXPECT_EQ(origins.min, glm::vec3(-1.0F));
  EXPECT_EQ(origins.max, glm::vec3(1.0F));
}

TEST(EvidenceOfDemands, SaysWhereRaysEnd) {
  const auto ends = [](const Scene& scene) { return demands_of(scene).evidence().at(1).why; };
  const std::string primary = "primary rays start without an end and end at the nearest hit so far";
  const std::string point = "; shadow rays end at their light";
  const std::string sun = "; shadow rays to a sun have no end";
  EXPECT_EQ(ends(unlit_hills()), primary);
  EXPECT_EQ(ends(sim::hills()), primary + point);
  EXPECT_EQ(ends(plan_of_hills()), primary + sun);
  EXPECT_EQ(ends(slanted_hills()), primary + point + sun);
}

TEST(EvidenceOfDemands, SaysWhatSendsRays) {
  const auto sources = [](const Scene& scene) {
    std::string why;
    for (const Evidence& each : demands_of(scene).evidence())
      if (each.demand.starts_with("origins: ")) why = each.why;
    return why;
  };
  EXPECT_EQ(sources(unlit_hills()), "the eye alone sends rays");
  EXPECT_EQ(sources(sim::hills()), "the eye, and surfaces with the offset of rays that leave them");
  EXPECT_EQ(sources(slanted_hills()),
            "the image of the camera, and surfaces with the offset of rays that leave them");
  Scene unlit = plan_of_hills();
  unlit.lights.clear();
  EXPECT_EQ(sources(unlit), "the image of the camera alone sends rays");
}

TEST(EvidenceOfDemands, SaysWhyOfEach) {
  const std::vector<Evidence> evidence = demands_of(sim::hills()).evidence();
  EXPECT_EQ(evidence.size(), 12U);
  EXPECT_EQ(evidence.front().demand, "rays: primary, shadow");
  for (const Evidence& each : evidence) EXPECT_FALSE(each.why.empty()) << each.demand;
}

TEST(EvidenceOfDemands, SaysWhatIsKeptWhole) {
  const auto kept = [](const Scene& scene) {
    std::vector<std::string> words;
    for (const Evidence& each : demands_of(scene).evidence())
      if (!each.bounds) words.push_back(each.demand);
    return words;
  };
  EXPECT_EQ(kept(stairs_along_one_class()),
            (std::vector<std::string>{"rays with and without an end", "lengths and endpoints of rays",
                                      "signs of float coordinates along xz",
                                      "range of integer coordinates along xz"}));
  EXPECT_EQ(kept(demanding_octahedron()),
            (std::vector<std::string>{
                "rays with and without an end", "lengths and endpoints of rays",
                "direction classes +++ -++ +-+ --+ ++- -+- +-- ---",
                "direction components that may be 0: xyz", "spread of direction components not bounded",
                "signs of float coordinates along xyz", "range of integer coordinates along xyz"}));
}

}  // namespace
}  // namespace hitpipe::ref::scene_demands_test
