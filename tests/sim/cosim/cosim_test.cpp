// Co-simulation of whole images: the Verilog finds what software finds, and the counts hide nothing.
#include "sim/cosim/cosim.hpp"

#include <cmath>
#include <cstring>
#include <mutex>

#include <gtest/gtest.h>

#include "sim/cosim/ray_source.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::cosim_test {
namespace {

constexpr hls::IntBits usual{20, 24};

bool same_bits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec3)) == 0;
}

/// All counts that must not depend on how the work was done.
void expect_same_work(const CosimResult& a, const CosimResult& b) {
  EXPECT_EQ(a.rays_primary, b.rays_primary);
  EXPECT_EQ(a.rays_secondary, b.rays_secondary);
  EXPECT_EQ(a.rays_shadow, b.rays_shadow);
  EXPECT_EQ(a.rejected, b.rejected);
  EXPECT_EQ(a.different_triangles, b.different_triangles);
  UnitCounts unit = b.unit;
  unit.cycles = a.unit.cycles;
  EXPECT_EQ(a.unit, unit);
  EXPECT_EQ(a.reference, b.reference);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_TRUE(same_bits(a.image, b.image));
}

struct Case {
  const char* scene;
  hls::IntBits bits;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.scene << ' ' << c.bits.coord << '/' << c.bits.interval;
}

/// Hills of glass that mirror and scatter a little: rays of all kinds, most of them secondary.
ref::Scene glass_hills() {
  ref::Scene scene = hills();
  scene.materials = {{glm::vec3(0.2F), glm::vec3(0.3F, 0.2F, 0.1F), glm::vec3(0.5F), 1.4F}};
  return scene;
}

class CosimOfScene {
 public:
  explicit CosimOfScene(const std::string& name)
      : CosimOfScene(name == "hills"   ? hills()
                     : name == "glass" ? glass_hills()
                                       : ref::load_scene(name)) {}
  explicit CosimOfScene(ref::Scene scene) : scene_(std::move(scene)) {}

  [[nodiscard]] CosimResult run(hls::IntBits bits, const CosimOptions& options,
                                const rtl::Design& design = int_slabs()) const {
    if (&design == &int_slabs()) return cosimulate(verilated(bits), scene_, bvh_, options);
    return cosimulate(VerilatedDesign(rtl::make_unit(design, bits, rtl::Library::thesis())), scene_, bvh_,
                      options);
  }
  [[nodiscard]] ref::RenderResult software(int width, int height) const {
    return ref::render(scene_, *ref::make_tracer(scene_.mesh, bvh_, {}),
                       {.width = width, .height = height, .threads = 2});
  }
  [[nodiscard]] const ref::Scene& scene() const { return scene_; }

 private:
  ref::Scene scene_;
  ref::Bvh bvh_ = ref::build_bvh(scene_.mesh);
};

class Cosim : public testing::TestWithParam<Case> {};

TEST_P(Cosim, FindsTheTrianglesAndTheImageOfSoftware) {
  const CosimOfScene cosim(GetParam().scene);
  const CosimResult result =
      cosim.run(GetParam().bits, {.width = 64, .height = 64, .threads = 2, .referee = true});
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.unit.false_misses, 0U);
  EXPECT_EQ(result.different_triangles, 0U);
  EXPECT_TRUE(result.verified(true));
  EXPECT_EQ(result.rejected, 0U);
  EXPECT_EQ(result.rays_primary, 64U * 64U);
  EXPECT_EQ(result.latency, verilated(GetParam().bits).latency());

  const ref::RenderResult software = cosim.software(64, 64);
  EXPECT_EQ(result.triangles, software.triangles);
  EXPECT_TRUE(same_bits(result.image, software.image));
  EXPECT_EQ(result.rays_primary, software.counts.primary.rays);
  EXPECT_EQ(result.rays_secondary, software.counts.secondary.rays);
  EXPECT_EQ(result.rays_shadow, software.counts.shadow.rays);
  EXPECT_EQ(result.reference.box_tests, software.counts.total().box_tests);
  EXPECT_EQ(result.reference.triangle_tests, software.counts.total().triangle_tests);

  // Boxes that are too large cost tests and never save any.
  EXPECT_GE(result.unit.box_tests, result.reference.box_tests);
  EXPECT_GE(result.unit.triangle_tests, result.reference.triangle_tests);
  EXPECT_GT(result.unit.box_tests, 10'000U);
  EXPECT_GT(result.unit.hits, result.unit.false_hits);
  EXPECT_GT(result.rays_shadow, 1000U);
  // The Verilog is a part of the loop. A sampled time may err a little.
  EXPECT_GT(result.rtl_seconds, 0.0);
  EXPECT_GT(result.loop_seconds, 0.0);
  EXPECT_GT(result.rtl_tests_per_s(), 0.0);
  EXPECT_GT(result.loop_tests_per_s(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(ScenesAndFormats, Cosim,
                         testing::Values(Case{"spheres", {24, 24}}, Case{"spheres", {20, 24}},
                                         Case{"spheres", {16, 16}}, Case{"spheres", {12, 12}},
                                         Case{"hills", {24, 24}}, Case{"hills", {20, 24}},
                                         Case{"hills", {16, 16}}, Case{"hills", {12, 12}},
                                         Case{"hills", {6, 6}}, Case{"hills", {32, 63}},
                                         Case{"glass", {20, 24}}, Case{"glass", {12, 12}}),
                         [](const auto& parameter) {
                           return std::string(parameter.param.scene) + "_" + test_name(parameter.param.bits);
                         });

TEST(CosimCounts, DoNotDependOnThreads) {
  const CosimOfScene cosim("spheres");
  // Not a multiple of a tile in either direction, so there are nine tiles.
  CosimOptions options{.width = 150, .height = 131, .threads = 1, .referee = true};
  const CosimResult one = cosim.run(usual, options);
  options.threads = 2;
  const CosimResult two = cosim.run(usual, options);
  expect_same_work(one, two);
  EXPECT_EQ(one.unit.cycles, two.unit.cycles);
  EXPECT_EQ(one.rays_primary, 150U * 131U);
  EXPECT_EQ(one.triangles, cosim.software(150, 131).triangles);
  options.threads = 1000;  // more than there are cores and tiles
  expect_same_work(one, cosim.run(usual, options));
}

TEST(CosimCounts, OnlyCyclesDependOnRaysInFlight) {
  const CosimOfScene cosim("glass");
  CosimOptions options{.width = 48, .height = 48, .rays_in_flight = 1, .referee = true};
  const CosimResult one = cosim.run(usual, options);
  options.rays_in_flight = 32;
  const CosimResult many = cosim.run(usual, options);
  expect_same_work(one, many);
  const auto wait = static_cast<std::uint64_t>(one.latency) + 2;  // as RayUnitOnHills derives it
  EXPECT_EQ(one.unit.cycles, one.unit.box_tests * wait);
  EXPECT_NEAR(one.occupancy_pct(), 100.0 / static_cast<double>(wait), 1e-9);
  EXPECT_GT(many.occupancy_pct(), 98.0);
  EXPECT_LE(many.occupancy_pct(), 100.0);
}

class CosimOfUnit : public testing::TestWithParam<TestedUnit> {};

/// A conservative unit finds the image of software. A float unit may miss a box that a ray grazes.
TEST_P(CosimOfUnit, IsVerifiedOnHills) {
  const TestedUnit& unit = GetParam();
  const ref::Scene scene = hills();
  const CosimResult result = cosimulate(verilated(unit), scene, ref::build_bvh(scene.mesh),
                                        {.width = 64, .height = 64, .threads = 2, .referee = true});
  std::printf("%llu box tests, %llu false hits, %llu false misses, %llu different triangles\n",
              static_cast<unsigned long long>(result.unit.box_tests),
              static_cast<unsigned long long>(result.unit.false_hits.value()),
              static_cast<unsigned long long>(result.unit.false_misses.value()),
              static_cast<unsigned long long>(result.different_triangles));
  EXPECT_EQ(result.rays_primary, 64U * 64U);
  EXPECT_GT(result.unit.box_tests, 4 * result.rays_primary);
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.different_triangles, 0U);
  EXPECT_TRUE(result.verified(unit.design().conservative));
}

INSTANTIATE_TEST_SUITE_P(Units, CosimOfUnit, testing::ValuesIn(units_of_boxes()),
                         [](const auto& parameter) { return test_name(parameter.param); });

/// The C++ datapath with its answer turned round.
void negated(const Format& format, const std::int64_t* operands, std::int64_t* results) {
  static const rtl::Evaluate right = int_slabs().evaluate(format);
  *results = right(operands) ? 0 : 1;
}

TEST(CosimCounts, WrongDatapathMismatchesOnEveryTest) {
  const CosimOfScene cosim("hills");
  const CosimOptions options{.width = 32, .height = 32};
  rtl::Design wrong = int_slabs();
  wrong.run_at = [](const Format&) -> rtl::Evaluate::Run { return negated; };
  const CosimResult result = cosim.run(usual, options, wrong);
  EXPECT_GT(result.unit.box_tests, 0U);
  EXPECT_EQ(result.unit.rtl_mismatches, result.unit.box_tests);
  EXPECT_FALSE(result.verified(true));
  // The image is the Verilog's.
  EXPECT_EQ(result.triangles, cosim.software(32, 32).triangles);
}

TEST(CosimCounts, RaysFromOutsideTheCubeAreRejectedAndHitNothing) {
  const CosimOfScene cosim(hills_from_outside());
  const CosimResult result = cosim.run(usual, {.width = 20, .height = 10, .referee = true});
  EXPECT_EQ(result.rays_primary, 200U);
  EXPECT_EQ(result.rejected, 200U);
  EXPECT_EQ(result.rays_secondary, 0U);
  EXPECT_EQ(result.rays_shadow, 0U);
  EXPECT_EQ(result.unit, UnitCounts::zeros(true));
  EXPECT_EQ(result.reference, ref::TraceCounts{});
  EXPECT_EQ(result.triangles, std::vector<std::uint32_t>(200, ref::Hit::none));
  EXPECT_EQ(result.occupancy_pct(), 0.0);
}

TEST(CosimCounts, BouncesLimitSecondaryRays) {
  const CosimOfScene cosim("glass");
  CosimOptions options{.width = 20, .height = 20};
  options.light.bounces = 0;
  EXPECT_EQ(cosim.run(usual, options).rays_secondary, 0U);
  options.light.bounces = 1;
  const CosimResult one = cosim.run(usual, options);
  EXPECT_GT(one.rays_secondary, 0U);
  EXPECT_LE(one.rays_secondary, 2 * one.rays_primary);
  options.light.bounces = 4;
  EXPECT_GT(cosim.run(usual, options).rays_secondary, one.rays_secondary);
}

TEST(CosimLight, RandomDirectionsAreThoseOfSoftware) {
  const CosimOfScene cosim("glass");
  CosimOptions options{.width = 70, .height = 33, .referee = true};
  options.light.bounces = 2;
  const CosimResult without = cosim.run(usual, options);
  options.light.diffuse = 1;
  options.light.occlusion = 2;
  const CosimResult result = cosim.run(usual, options);
  EXPECT_TRUE(result.verified(true));
  EXPECT_EQ(result.rejected, 0U);
  EXPECT_GT(result.rays_secondary, without.rays_secondary);
  EXPECT_GT(result.rays_shadow, without.rays_shadow);
  const ref::RenderResult software = ref::render(
      cosim.scene(), *ref::make_tracer(cosim.scene().mesh, ref::build_bvh(cosim.scene().mesh), {}),
      {.width = 70, .height = 33, .light = options.light});
  EXPECT_TRUE(same_bits(result.image, software.image));
  EXPECT_EQ(result.rays_secondary, software.counts.secondary.rays);
  EXPECT_EQ(result.rays_shadow, software.counts.shadow.rays);
  options.threads = 3;
  expect_same_work(cosim.run(usual, options), result);
}

/// The rays of a picture as a list: no picture, and the same tests.
TEST(CosimOfAList, TracesItsRaysInPlaceOfAPicture) {
  const CosimOfScene cosim("glass");
  std::vector<AskedRay> rays;
  std::vector<std::uint32_t> triangles;
  ref::RenderOptions recording{.width = 64, .height = 64};
  recording.traced = [&](ref::RayKind, const ref::TraceJob& job) {
    for (const ref::Ray& ray : job.rays) rays.push_back({ray, job.query});
    triangles.insert(triangles.end(), job.triangles.begin(), job.triangles.end());
  };
  (void)ref::render(cosim.scene(),
                    *ref::make_tracer(cosim.scene().mesh, ref::build_bvh(cosim.scene().mesh), {}), recording);
  ASSERT_GT(rays.size(), 2 * ListRays::most);
  const CosimResult picture = cosim.run(usual, {.width = 64, .height = 64, .referee = true});
  const CosimResult list = cosim.run(usual, {.width = 0, .height = 0, .referee = true, .rays = rays});
  EXPECT_TRUE(list.verified(true));
  EXPECT_TRUE(list.image.empty());
  EXPECT_EQ(list.rays_primary, picture.rays_primary + picture.rays_secondary);
  EXPECT_EQ(list.rays_secondary, 0U);
  EXPECT_EQ(list.rays_shadow, picture.rays_shadow);
  EXPECT_EQ(list.rejected, 0U);
  EXPECT_EQ(list.unit.box_tests, picture.unit.box_tests);
  EXPECT_EQ(list.unit.triangle_tests, picture.unit.triangle_tests);
  EXPECT_EQ(list.reference, picture.reference);
  ASSERT_EQ(list.triangles.size(), rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool any = rays[i].query == ref::Query::any;
    EXPECT_TRUE(any ? (list.triangles[i] == ref::Hit::none) == (triangles[i] == ref::Hit::none)
                    : list.triangles[i] == triangles[i])
        << i;
  }
  expect_same_work(cosim.run(usual, {.threads = 3, .referee = true, .rays = rays}), list);
}

TEST(CosimProgress, TellsEveryTileAndEndsAtOne) {
  const CosimOfScene cosim("hills");
  std::mutex telling;
  std::vector<double> shares;
  CosimOptions options{.width = 130, .height = 65, .threads = 2};
  options.progress = [&](double share) {
    const std::scoped_lock lock(telling);
    shares.push_back(share);
  };
  (void)cosim.run(usual, options);
  std::sort(shares.begin(), shares.end());
  ASSERT_EQ(shares.size(), 6U);
  for (std::size_t i = 0; i < shares.size(); ++i)
    EXPECT_DOUBLE_EQ(shares[i], static_cast<double>(i + 1) / 6.0);
}

TEST(CosimResultVerdict, NeedsNoMismatchNoDifferenceAndNoFalseMissOfAConservativeDesign) {
  CosimResult result;
  result.unit = UnitCounts::zeros(true);
  EXPECT_TRUE(result.verified(true));
  result.unit.false_hits = 1;  // allowed
  result.rejected = 1;
  EXPECT_TRUE(result.verified(true));
  result.unit.false_misses = 1;
  EXPECT_FALSE(result.verified(true));
  EXPECT_TRUE(result.verified(false));
  result.unit.rtl_mismatches = 1;
  EXPECT_FALSE(result.verified(false));
  result.unit.rtl_mismatches = 0;
  result.different_triangles = 1;
  EXPECT_FALSE(result.verified(false));
}

TEST(CosimResultVerdict, SaysNothingOfFalseMissesWithoutReferee) {
  const CosimOfScene cosim("hills");
  const CosimResult result = cosim.run(usual, {.width = 16, .height = 16});
  EXPECT_FALSE(result.unit.false_misses);
  EXPECT_FALSE(result.unit.false_hits);
  EXPECT_FALSE(result.without_false_miss());
  EXPECT_TRUE(result.same_as_software());
  EXPECT_TRUE(result.verified(false));
  EXPECT_FALSE(result.verified(true));
  const CosimResult judged = cosim.run(usual, {.width = 16, .height = 16, .referee = true});
  EXPECT_EQ(judged.without_false_miss(), true);
  EXPECT_TRUE(judged.verified(true));
}

TEST(Cosim, OfNoRaysOrNoPixelsIsRefused) {
  const CosimOfScene cosim("hills");
  for (const int rays : {0, -1, 65'537}) {
    EXPECT_EQ(message_of<std::invalid_argument>(
                  [&] { (void)cosim.run(usual, {.width = 8, .height = 8, .rays_in_flight = rays}); }),
              std::to_string(rays) + " rays in flight: allowed is 1 to 65536");
  }
  EXPECT_EQ(message_of<std::invalid_argument>([&] { (void)cosim.run(usual, {.width = 0, .height = 8}); }),
            "image of 0 x 8 pixels: allowed is 1 x 1 and more");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { (void)cosim.run(usual, {.width = 8, .height = 0}); }),
            "image of 8 x 0 pixels: allowed is 1 x 1 and more");
}

TEST(CosimResultShares, AreTheirDefinitions) {
  CosimResult result;
  EXPECT_EQ(result.occupancy_pct(), 0.0);
  EXPECT_EQ(result.extra_box_tests_pct(), 0.0);
  EXPECT_EQ(result.extra_triangle_tests_pct(), 0.0);
  EXPECT_EQ(result.rtl_tests_per_s(), 0.0);
  EXPECT_EQ(result.loop_tests_per_s(), 0.0);
  EXPECT_EQ(result.rtl_boxes_per_s(), 0.0);
  EXPECT_EQ(result.loop_boxes_per_s(), 0.0);
  result.unit.tests = 90;
  result.unit.box_tests = 150;
  result.unit.triangle_tests = 30;
  result.unit.cycles = 200;
  result.reference = {.box_tests = 120, .triangle_tests = 40};
  result.rtl_seconds = 0.5;
  result.loop_seconds = 1.5;
  EXPECT_DOUBLE_EQ(result.occupancy_pct(), 45.0) << "of tests, not of boxes";
  EXPECT_DOUBLE_EQ(result.extra_box_tests_pct(), 25.0);
  EXPECT_DOUBLE_EQ(result.extra_triangle_tests_pct(), -25.0);
  EXPECT_DOUBLE_EQ(result.rtl_tests_per_s(), 180.0);
  EXPECT_DOUBLE_EQ(result.loop_tests_per_s(), 60.0);
  EXPECT_DOUBLE_EQ(result.rtl_boxes_per_s(), 300.0);
  EXPECT_DOUBLE_EQ(result.loop_boxes_per_s(), 100.0);
}

}  // namespace
}  // namespace hitpipe::sim::cosim_test
