// The ranges of ports hold for every ray and box that the scene's demands allow.
#include "sim/fit/port_demands.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "rays/world/int_box.hpp"
#include "rtl_gen/emit/unit.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/prune/facts.hpp"
#include "sim/designs/port_ranges.hpp"
#include "sim/software/software.hpp"
#include "sim/unit/unit_set_up.hpp"
#include "sw_ref/quantise/float_ray.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/message_of.hpp"
#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::sim::port_demands_test {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t seed = 20070707;

ref::SceneDemands demands_of(const ref::Scene& scene) {
  return ref::scene_demands(scene, ref::build_bvh(scene.mesh), {64, 48});
}

bool holds(const rtl::Interval& range, std::int64_t number) {
  return number >= range.low && number <= range.high;
}

/// A family with directions in a random box: some far from 0, some across 0, some stiff.
ref::RayFamily random_family(std::mt19937_64& random) {
  std::uniform_real_distribution<float> part(-1.0F, 1.0F);
  std::uniform_int_distribution<int> exponent(-24, 0);
  ref::RayFamily family;
  for (int axis = 0; axis < 3; ++axis) {
    float a = std::ldexp(part(random), exponent(random));
    float b = random() % 2 == 0 ? a * (1.0F + std::abs(part(random))) : part(random);
    if (a > b) std::swap(a, b);
    family.direction.min[axis] = a;
    family.direction.max[axis] = b;
    family.origin.min[axis] = family.origin.max[axis] = part(random);
  }
  return family;
}

glm::vec3 random_direction(const ref::RayFamily& family, std::mt19937_64& random) {
  glm::vec3 direction(0.0F);
  for (int axis = 0; axis < 3; ++axis) {
    const float low = family.direction.min[axis];
    const float high = family.direction.max[axis];
    std::uniform_real_distribution<float> within(low, high);
    const auto kind = random() % 4;
    direction[axis] = kind == 0 ? low : kind == 1 ? high : std::clamp(within(random), low, high);
  }
  return direction;
}

TEST(PortRanges, HoldRandomDirectionsThroughTheSetUp) {
  std::mt19937_64 random(seed);
  int checked = 0;
  for (int round = 0; round < 4000; ++round) {
    ref::SceneDemands scene;
    scene.rays = {random_family(random)};
    if (round % 3 == 0) scene.rays.push_back(random_family(random));
    const int n = 6 + static_cast<int>(random() % 27);
    const hls::IntBits bits{n, 2 * n - 1};
    for (const ref::RayFamily& family : scene.rays) {
      for (int i = 0; i < 8; ++i) {
        const ref::Ray ray{family.origin.min, random_direction(family, random), ref::Ray::infinite};
        if (ray.direction == glm::vec3(0.0F)) continue;
        const ref::IntSlabsRaySetup slabs(ray, bits);
        const ref::IntPluckerRaySetup plucker(ray, bits);
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          const std::string where =
              fmt::format("seed {} round {} n {} axis {} direction {:a} {:a} {:a}", seed, round, n, axis,
                          ray.direction.x, ray.direction.y, ray.direction.z);
          EXPECT_TRUE(holds(*int_origin(scene, axis, n), slabs.ray().origin[a])) << where;
          EXPECT_TRUE(holds(*int_direction(scene, axis, n), plucker.ray().direction[a])) << where;
          if (const auto irdvc = int_irdvc(scene, axis, n)) {
            EXPECT_TRUE(holds(irdvc->floor, slabs.ray().irdvc_floor[a])) << where;
            EXPECT_TRUE(holds(irdvc->ceil, slabs.ray().irdvc_ceil[a])) << where;
          }
          const auto bits_of = [](float x) { return std::int64_t{std::bit_cast<std::uint32_t>(x)}; };
          if (const Range range = float_direction(scene, axis)) {
            EXPECT_TRUE(holds(*range, bits_of(ray.direction[axis]))) << where;
          }
          if (const Range range = float_irdvc(scene, axis)) {
            EXPECT_TRUE(holds(*range, bits_of(ref::float_irdvc(ray.direction)[axis]))) << where;
          }
          ++checked;
        }
      }
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GE(checked, 96'000);
}

bool holds(const std::vector<rtl::Interval>& within, std::int64_t number) {
  return std::any_of(within.begin(), within.end(),
                     [&](const rtl::Interval& range) { return holds(range, number); });
}

TEST(FloatRanges, HoldRandomRaysAndBoxesThroughTheSetUp) {
  std::mt19937_64 random(seed + 2);
  int checked = 0;
  for (int round = 0; round < 4000; ++round) {
    ref::SceneDemands scene;
    scene.rays = {random_family(random)};
    if (round % 3 == 0) scene.rays.push_back(random_family(random));
    for (ref::RayFamily& family : scene.rays) {
      const ref::RayFamily other = random_family(random);
      if (round % 2 == 0) family.origin.grow(other.origin);
      scene.boxes.grow(family.origin);
    }
    const std::array formats{hls::FpBits{8, 23}, hls::FpBits{5, 10}, hls::FpBits{3, 2}};
    const hls::FpBits bits = formats[static_cast<std::size_t>(round) % formats.size()];
    const auto pattern = [&](float x) { return ref::fp_pattern(x, bits); };
    for (const ref::RayFamily& family : scene.rays) {
      for (int i = 0; i < 8; ++i) {
        ref::RayFamily origins;
        origins.direction = family.origin;
        const ref::Ray ray{random_direction(origins, random), random_direction(family, random),
                           ref::Ray::infinite};
        if (ray.direction == glm::vec3(0.0F)) continue;
        const ref::FpSlabsSafeRaySetup set_up(ray, bits);
        const ref::FpSlabsSafeRay& made = set_up.ray();
        const ref::Aabb box = ref::FpRounding(bits).outward({ray.origin, ray.origin});
        for (int axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          const std::string where = fmt::format(
              "round {} e{}m{} axis {} origin {:a} direction {:a} {:a} {:a}", round, bits.exponent,
              bits.fraction, axis, ray.origin[axis], ray.direction.x, ray.direction.y, ray.direction.z);
          EXPECT_TRUE(holds(backward(scene, axis), made.back[a] ? 1 : 0)) << where;
          EXPECT_TRUE(holds(mirrored_origin(scene, axis, bits, true), pattern(made.origin_low[a]))) << where;
          EXPECT_TRUE(holds(mirrored_origin(scene, axis, bits, false), pattern(made.origin_high[a])))
              << where;
          EXPECT_TRUE(holds(rounded_planes(scene, axis, bits, true), pattern(box.min[axis]))) << where;
          EXPECT_TRUE(holds(rounded_planes(scene, axis, bits, false), pattern(box.max[axis]))) << where;
          EXPECT_TRUE(holds(scaled_inverse(scene, axis, bits, true), made.inverse_low[a])) << where;
          EXPECT_TRUE(holds(scaled_inverse(scene, axis, bits, false), made.inverse_high[a])) << where;
          ++checked;
        }
      }
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GE(checked, 90'000);
}

TEST(FloatRanges, OfOneNumberOrOneSignAreOneInterval) {
  const hls::FpBits bits{5, 10};
  const auto within = [&](float low, float high) {
    FloatRange range(bits);
    range.add(low, high);
    return range.within();
  };
  using Intervals = std::vector<rtl::Interval>;
  EXPECT_EQ(within(0.25F, 0.5F), (Intervals{{0x3400, 0x3800}}));
  EXPECT_EQ(within(-0.5F, -0.25F), (Intervals{{0xb400, 0xb800}}));
  EXPECT_EQ(within(-0.5F, 0.25F), (Intervals{{0, 0x3400}, {0x8000, 0xb800}}));
  EXPECT_EQ(within(-0.0F, -0.0F), (Intervals{{0x8000, 0x8000}}));
  EXPECT_EQ(within(-0.0F, 0.0F), (Intervals{{0, 0}, {0x8000, 0x8000}}));
}

/// Coordinates are at most 1, so the top exponent bit of a float coordinate is 0 in every scene.
bool is_of_the_cube(const rtl::PortDemand& demand, const rtl::Port& port) {
  const rtl::Facts facts = rtl::facts_of(demand, port.width, port.is_signed);
  return port.kind == hls::Kind::real && facts.ones() == 0 &&
         facts.zeros() == std::uint64_t{1} << (port.width - 2);
}

TEST(PortDemands, AreNoneOfASceneThatNeedsEverything) {
  const ref::SceneDemands scene = demands_of(ref::demanding_octahedron());
  for (const rtl::Design& design : rtl::designs()) {
    if (software_of(design).demand == nullptr) {
      EXPECT_THROW(static_cast<void>(port_demands(design, design.default_format, scene)), std::runtime_error);
      continue;
    }
    const Format format = software_of(design).fit_from.value_or(design.default_format);
    const std::vector<rtl::Port> ports = design.ports(format);
    for (const DemandGroup& group : port_demands(design, format, scene)) {
      if (format.is<hls::FpBits>()) {
        for (const rtl::PortDemand& demand : group.demands.ports)
          EXPECT_TRUE(is_of_the_cube(demand, ports[rtl::index_of(ports, demand.port).value()]))
              << demand.port;
        continue;
      }
      ADD_FAILURE() << group.why;
    }
  }
}

TEST(PortDemands, OfOneDirectionClassGiveEverySign) {
  const ref::SceneDemands scene = demands_of(ref::stairs_along_one_class());
  const rtl::Demands slabs = all_of(port_demands(rtl::find_design("int_slabs"), hls::IntBits{24, 24}, scene));
  int signs = 0;
  for (const rtl::PortDemand& demand : slabs.ports)
    if (demand.port.ends_with("_floor"))
      signs += rtl::hull(demand).low >= 0 || rtl::hull(demand).high < 0 ? 1 : 0;
  EXPECT_EQ(signs, 3);
}

TEST(PortDemands, OfPrimaryRaysAloneFixTheOrigin) {
  const ref::SceneDemands scene = demands_of(ref::unlit_hills());
  for (const char* const name : {"int_slabs", "int_plucker", "fp_slabs", "fp_plucker"}) {
    const rtl::Design& design = rtl::find_design(name);
    int constants = 0;
    for (const rtl::PortDemand& demand : all_of(port_demands(design, design.default_format, scene)).ports)
      constants += rtl::hull(demand).low == rtl::hull(demand).high ? 1 : 0;
    EXPECT_EQ(constants, 3) << name;
  }
}

const rtl::PortDemand& of_port(const rtl::Demands& demands, const std::string& port) {
  const auto found = std::find_if(demands.ports.begin(), demands.ports.end(),
                                  [&](const rtl::PortDemand& demand) { return demand.port == port; });
  if (found == demands.ports.end()) throw std::runtime_error("no demand on " + port);
  return *found;
}

TEST(PortDemands, OfCoarseAxesAreLowZerosBesideTheRanges) {
  const ref::SceneDemands scene = demands_of(ref::flat_hills());
  Precision precision{
      .format = hls::IntBits{12, 12}, .coarse = {{0, 2, 1}}, .coarse_extra_box_tests_pct = 1.5};
  for (const char* const name : {"int_slabs", "int_plucker"}) {
    const rtl::Design& design = rtl::find_design(name);
    const auto groups = port_demands(design, hls::IntBits{12, 12}, scene, precision);
    const rtl::Demands all = all_of(groups);
    rtl::check_demands(all, design.ports(hls::IntBits{12, 12}));
    for (const char* const port : {"iry", "iymin", "iymax"}) {
      // y is narrow too, so one demand states both.
      EXPECT_EQ(of_port(all, port).low_zeros, 2) << port;
      EXPECT_LT(rtl::hull(of_port(all, port)).high, 1000) << port;
    }
    for (const char* const port : {"irz", "izmin", "izmax"})
      EXPECT_EQ(of_port(all, port).low_zeros, 1) << port;

    int low = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (groups[i].demands.ports.front().low_zeros == 0) continue;
      ++low;
      EXPECT_THAT(groups[i].why, HasSubstr("1.50 % extra box tests"));
      const rtl::Demands others = all_without(groups, i);
      EXPECT_EQ(others.ports.size(), low == 1 ? all.ports.size() : all.ports.size() - 3) << groups[i].why;
      if (low == 1) {
        EXPECT_EQ(of_port(others, "iry").low_zeros, 0);
        EXPECT_EQ(of_port(others, "irz").low_zeros, 1);
      }
    }
    EXPECT_EQ(low, 2) << name;
  }
}

TEST(PortRanges, HoldOriginsAndBoxesOnCoarseAxes) {
  std::mt19937_64 random(seed + 1);
  std::uniform_real_distribution<float> part(-0.5F, 0.5F);
  const auto point = [&] { return glm::vec3(part(random), part(random), part(random)); };
  int checked = 0;
  for (int round = 0; round < 3000; ++round) {
    const int n = 8 + static_cast<int>(random() % 25);
    const ref::CoarseAxes coarse{{static_cast<int>(random() % 6), 0, static_cast<int>(random() % 4)}};
    ref::SceneDemands scene;
    scene.rays.resize(1);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 4; ++i) points.push_back(point());
    for (const glm::vec3& p : points) {
      scene.rays[0].origin.grow({p, p});
      scene.boxes.grow({p, p});
    }
    for (const glm::vec3& p : points) {
      const ref::IntSlabsRay ray = ref::IntSlabsRaySetup({p, glm::vec3(1), 1.0F}, {n, 2 * n - 1}).ray();
      const ref::IntOrigin origin = ref::coarse_origin(ray.origin, coarse, n);
      const ref::IntBox box = ref::coarse_box(ref::quantise_box({p, p}, n), coarse, n);
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        ASSERT_TRUE(holds(*int_origin(scene, axis, n, coarse), origin[a])) << seed + 1 << " " << round;
        ASSERT_TRUE(holds(*int_box(scene, axis, n, coarse), box.min[a])) << seed + 1 << " " << round;
        ASSERT_TRUE(holds(*int_box(scene, axis, n, coarse), box.max[a])) << seed + 1 << " " << round;
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 36'000);
}

TEST(Guard, NamesPortNumberAndDemand) {
  const std::vector<rtl::Port> ports{{"a", 8, true}, {"b", 8, true}};
  const DemandGuard guard({{{"b", {{-9, -1}, {1, 9}}}, {"a", {{-128, 127}}, 1}}, {{"a", "b"}}}, ports);
  const auto said = [&](std::int64_t a, std::int64_t b) {
    const std::int64_t operands[] = {a, b};
    return message_of<std::out_of_range>([&] { guard(operands); });
  };
  EXPECT_EQ(said(-20, -9), "no exception");
  EXPECT_EQ(said(8, 9), "no exception");
  EXPECT_THAT(said(-20, 0), HasSubstr("fitted to: b = 0, demanded is b in [-9, -1] or [1, 9]"));
  EXPECT_THAT(said(-20, 10), HasSubstr("b = 10"));
  EXPECT_THAT(said(8, 7), HasSubstr("a = 8 and b = 7, demanded is a <= b"));
  EXPECT_THAT(said(-19, 7), HasSubstr("a = -19, demanded is a in [-128, 127], a multiple of 2"));
}

}  // namespace
}  // namespace hitpipe::sim::port_demands_test
