// Fitted units are smaller and give the answers of the whole units. Rays and operands outside their demands
// are refused.
#include "sim/fit/fit.hpp"

#include <map>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "hls/box/fp_format.hpp"
#include "hls/box/major_format.hpp"
#include "host/files.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/cosim/generic_tracer.hpp"
#include "sim/software/software.hpp"
#include "sim/unit/unit_set_up.hpp"
#include "sim/unit/verilated_design.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::sim::fit_test {
namespace {

using testing::HasSubstr;

const rtl::Library& library() {
  return rtl::Library::thesis();
}

/// The image of every test. It is so small that compiling the Verilog takes most of the time.
struct World {
  explicit World(ref::Scene made)
      : scene(std::move(made)),
        bvh(ref::build_bvh(scene.mesh)),
        demands(ref::scene_demands(scene, bvh, {width, height})) {}

  static constexpr int width = 40;
  static constexpr int height = 30;
  ref::Scene scene;
  ref::Bvh bvh;
  ref::SceneDemands demands;
};

std::map<std::string, std::string> by_name(const rtl::EmittedDesign& emitted) {
  std::map<std::string, std::string> found;
  for (const rtl::File& file : emitted.files()) found[file.name] = file.contents;
  return found;
}

CosimResult run(const FittedUnit& unit, const World& world, const World& fitted_to) {
  return cosimulate(VerilatedDesign(unit), world.scene, world.bvh,
                    {.width = World::width,
                     .height = World::height,
                     .threads = 2,
                     .referee = true,
                     .scene_demands = &fitted_to.demands});
}

struct Case {
  const char* design;
  ref::Scene (*scene)();
  ref::CoarseAxes coarse;  ///< that the scene leaves room for
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.design;
}

/// A demand that makes two operations unlike keeps them from sharing a component.
TEST(FittedRate, UsesNoDemandThatMakesTheUnitLarger) {
  const World world(hills());
  const rtl::Design& design = rtl::find_design("int_slabs");
  const hls::IntBits format{12, 12};
  for (const int interval : {2, 3, 6}) {
    const FittedUnit unit =
        fit(design, format, std::nullopt, world.demands, library(), {.interval = interval});
    EXPECT_EQ(unit.price.interval, interval);
    EXPECT_LE(unit.price.area_um2,
              area::price(design, format, library(), area::Account::built, rtl::FlowControl::stall, interval)
                  .area_um2);
    for (const LeftOut& left : unit.left_out) EXPECT_GE(left.area_um2, 0) << left.what;
    const CosimResult image = run(unit, world, world);
    EXPECT_EQ(image.unit.rtl_mismatches, 0U);
    EXPECT_EQ(image.unit.false_misses, 0U);
  }
}

/// The ranges of ports hold only with the low bits that are dropped.
TEST(FittedRate, KeepsTheLowBitsDropped) {
  const World world(ref::flat_hills());
  const Precision coarse{.format = hls::IntBits{12, 12}, .coarse = {{0, 3, 1}}};
  for (const int interval : {1, 3, 6, 12}) {
    const FittedUnit unit = fit(rtl::find_design("int_slabs"), coarse.format, coarse, world.demands,
                                library(), {.interval = interval});
    EXPECT_EQ(coarse_axes(unit).dropped, coarse.coarse.dropped) << interval;
  }
}

TEST(FittedRate, TakesTheSmallestUnitThatReachesIt) {
  const World world(hills());
  const rtl::Design& design = rtl::find_design("int_slabs");
  const hls::IntBits format{12, 12};
  const auto at = [&](FitRate rate) {
    return fit(design, format, std::nullopt, world.demands, library(), rate);
  };
  const auto full = static_cast<double>(at({}).price.boxes_per_second());
  EXPECT_EQ(at({.boxes_per_second = full}).price.interval, 1);
  const FittedUnit sixth = at({.boxes_per_second = full / 6.5});
  EXPECT_GE(static_cast<double>(sixth.price.boxes_per_second()), full / 6.5);
  for (const int interval : {1, 2, 3, 4, 5, 6})
    EXPECT_LE(sixth.price.area_um2, at({.interval = interval}).price.area_um2) << interval;
  const Precision coarse{.format = format};
  EXPECT_FALSE(price_of_fit(design, coarse, world.demands, library(), {.boxes_per_second = 2 * full}));
  EXPECT_TRUE(price_of_fit(design, coarse, world.demands, library(), {.boxes_per_second = full / 2}));
}

class Fitted : public testing::TestWithParam<Case> {};

TEST_P(Fitted, IsSmallerAndMissesNothing) {
  const World world(GetParam().scene());
  const rtl::Design& design = rtl::find_design(GetParam().design);
  const Format format = !design.conservative ? Format(hls::Binary32{}) : Format(hls::IntBits{12, 12});
  const FittedUnit unit = fit(design, format, std::nullopt, world.demands, library());
  EXPECT_GT(unit.saved_um2(), 0);
  EXPECT_FALSE(unit.demands.empty());
  EXPECT_FALSE(unit.left_out.empty());
  for (const LeftOut& left : unit.left_out) EXPECT_GE(left.area_um2, 0) << left.what;

  const CosimResult result = run(unit, world, world);
  EXPECT_EQ(result.rays_primary, std::uint64_t{World::width} * World::height);
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.different_triangles, 0U);
  if (design.conservative) {
    EXPECT_EQ(result.unit.false_misses, 0U);
  }
  EXPECT_GT(result.unit.hits, 0U);
}

INSTANTIATE_TEST_SUITE_P(Units, Fitted,
                         testing::Values(Case{"int_slabs", ref::flat_hills, {{0, 3, 1}}},
                                         Case{"int_plucker", ref::stairs_along_one_class, {{1, 0, 1}}}),
                         [](const auto& parameter) { return std::string(parameter.param.design); });

TEST_P(Fitted, OnCoarseAxesIsSmallerStillAndMissesNothing) {
  const World world(GetParam().scene());
  const rtl::Design& design = rtl::find_design(GetParam().design);
  const Format format = hls::IntBits{12, 12};
  const Precision precision{.format = format, .coarse = GetParam().coarse};
  const FittedUnit fine = fit(design, format, std::nullopt, world.demands, library());
  const FittedUnit unit = fit(design, format, precision, world.demands, library());
  EXPECT_LT(unit.price.area_um2, fine.price.area_um2);
  int dropped = 0;
  for (const LeftOut& left : unit.left_out) {
    EXPECT_GE(left.area_um2, 0) << left.what;
    if (!left.what.starts_with("low bits of ")) continue;
    EXPECT_GT(left.area_um2, 0) << left.what;
    ++dropped;
  }
  EXPECT_EQ(dropped, 2);

  const CosimResult result = run(unit, world, world);
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.different_triangles, 0U);
  EXPECT_EQ(result.unit.false_misses, 0U);
  EXPECT_GT(result.unit.hits, 0U);
}

std::string what_of(const FittedUnit& unit) {
  std::string text;
  for (const LeftOut& left : unit.left_out) text += left.what + '\n';
  return text;
}

TEST(FittedFloats, LoseSignsExponentBitsAndMirrors) {
  const World world(ref::stairs_along_one_class());
  const rtl::Design& design = rtl::find_design("fp_slabs_safe");
  const FittedUnit unit = fit(design, design.parse_format("e4m5"), std::nullopt, world.demands, library());
  EXPECT_GT(unit.saved_um2(), 0);
  for (const LeftOut& left : unit.left_out) EXPECT_GE(left.area_um2, 0) << left.what;
  EXPECT_THAT(what_of(unit), HasSubstr("numbers of back_x that never come\n"));
  EXPECT_THAT(what_of(unit), HasSubstr("2 bits after the sign of rx, rx_up\n"));
  EXPECT_THAT(what_of(unit), HasSubstr("the sign and 2 bits after it of ymin, ymax\n"));
  for (const rtl::Port& port : rtl::input_ports(unit.pipeline->graph))
    EXPECT_THAT(port.name, testing::Not(testing::StartsWith("back_")));

  const CosimResult result = run(unit, world, world);
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.different_triangles, 0U);
  EXPECT_EQ(result.unit.false_misses, 0U);
  EXPECT_GT(result.unit.hits, 0U);
}

class Endless : public testing::TestWithParam<const char*> {};

TEST_P(Endless, UnitIsSmallerAndTracesTheSame) {
  const World world(sim::hills());
  const rtl::Design& design = rtl::find_design(GetParam());
  const Format format = !design.conservative ? Format(hls::Binary32{}) : Format(hls::IntBits{12, 12});
  const FittedUnit with_ends = fit(design, format, std::nullopt, world.demands, library());
  const FittedUnit unit =
      fit(design, format, Precision{.format = format, .ends = false}, world.demands, library());
  EXPECT_LT(unit.price.area_um2, with_ends.price.area_um2);
  for (const rtl::Port& port : rtl::input_ports(unit.pipeline->graph)) {
    EXPECT_NE(port.name, "rinf");
    EXPECT_NE(port.name, "irlen");
    EXPECT_NE(port.name, "rex");
  }
  EXPECT_TRUE(std::any_of(unit.left_out.begin(), unit.left_out.end(), [](const LeftOut& left) {
    return left.what == "the ends of rays" && left.area_um2 > 0;
  }));

  const CosimResult result = run(unit, world, world);
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.different_triangles, 0U);
  EXPECT_GT(result.extra_box_tests_pct(), 0.0);
  EXPECT_GT(result.unit.hits, 0U);
}

INSTANTIATE_TEST_SUITE_P(Designs, Endless, testing::Values("int_slabs", "int_plucker", "fp_slabs"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(FittedFiles, AreTheWholeDesignsWhereTheSceneNeedsEverything) {
  const World world(ref::demanding_octahedron());
  for (const rtl::Design& design : rtl::designs()) {
    if (software_of(design).demand == nullptr) {
      EXPECT_THROW(
          static_cast<void>(fit(design, design.default_format, std::nullopt, world.demands, library())),
          std::runtime_error);
      continue;
    }
    const Format format = software_of(design).fit_from.value_or(design.default_format);
    const FittedUnit unit = fit(design, format, std::nullopt, world.demands, library());
    const auto whole = by_name(rtl::emit(rtl::make_unit(design, format, library())));
    if (format.is<hls::FpBits>()) {  // no scene needs the top exponent bits of coordinates
      for (const LeftOut& left : unit.left_out)
        EXPECT_THAT(left.what, testing::StartsWith("1 bit after the sign"));
      EXPECT_EQ(unit.left_out.size(), 6U);
      continue;
    }
    EXPECT_EQ(by_name(rtl::emit(unit)), whole) << design.name;
    EXPECT_EQ(unit.saved_um2(), 0) << design.name;
    EXPECT_TRUE(unit.left_out.empty()) << design.name;
  }
}

/// Also in the testbench, which passes in Icarus.
TEST(FittedFiles, ListTheDemandsAndCheckThem) {
  const World world(ref::flat_hills());
  const Precision precision{.format = hls::IntBits{12, 12}, .coarse = {{0, 3, 1}}};
  const FittedUnit unit =
      fit(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, precision, world.demands, library());
  const rtl::EmittedDesign emitted = rtl::emit(unit);
  EXPECT_EQ(rtl::demands_of_manifest(emitted.manifest->dump()), unit.demands);
  EXPECT_THAT(emitted.verilog.contents, HasSubstr("`ifdef HITPIPE_CHECK"));
  ASSERT_TRUE(emitted.check_module.has_value());
  EXPECT_EQ(emitted.check_module->name, "int_slabs_12_12_check.v");
  for (const rtl::PortDemand& demand : unit.demands.ports)
    EXPECT_THAT(emitted.check_module->contents, HasSubstr(demand.port));

  const host::ScratchFolder folder;
  host::write_files(folder.path(), emitted.files());
  const rtl::ToolResult compiled =
      rtl::run_tool(folder / "tb", "iverilog", "iverilog",
                    "-g2012 -Wall -DHITPIPE_CHECK -o tb int_slabs_12_12_tb.sv ../int_slabs_12_12.v "
                    "../int_slabs_12_12_check.v");
  ASSERT_EQ(compiled.status, 0) << compiled.output;
  EXPECT_THAT(rtl::run_tool(folder / "tb", "iverilog", "vvp", "tb").output, HasSubstr("PASS 1000 vectors"));
}

TEST(FittedUnit, RefusesAnotherScene) {
  const World flat(ref::flat_hills());
  const World hills(sim::hills());
  const FittedUnit unit =
      fit(rtl::find_design("int_slabs"), hls::IntBits{12, 12}, std::nullopt, flat.demands, library());
  EXPECT_THROW(run(unit, hills, flat), std::out_of_range);   // its rays
  EXPECT_THROW(run(unit, hills, hills), std::out_of_range);  // its operands
}

TEST(BytesPerNode, AreThoseOfTable61) {
  EXPECT_EQ(bytes_per_node(rtl::find_design("fp_slabs"), hls::Binary32{}), 32U);
  const rtl::Design& slabs = rtl::find_design("int_slabs");
  EXPECT_EQ(bytes_per_node(slabs, hls::IntBits{24, 24}), 26U);
  EXPECT_EQ(bytes_per_node(slabs, hls::IntBits{16, 24}), 20U);
  EXPECT_EQ(bytes_per_node(rtl::find_design("int_major"), hls::MajorBits{20, 1, 13}), 23U);
  EXPECT_EQ(bytes_per_node(rtl::find_design("int_major_pair"), hls::MajorBits{20, 1, 13}), 16U);
  EXPECT_EQ(bytes_per_node(slabs, hls::IntBits{16, 24}, {{0, 3, 1}}), 19U);
}

/// One more dropped bit on any axis exceeds the limit or leaves the grid.
bool no_further_bit(const PrecisionSearch& search, const Precision& found) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ref::CoarseAxes coarser = found.coarse;
    ++coarser.dropped[axis];
    try {
      if (extra_box_tests_pct(search, found.format, coarser) <= search.overhead_pct) return false;
    } catch (const std::out_of_range&) {
      continue;
    }
  }
  return true;
}

class PrecisionOf : public testing::TestWithParam<const char*> {};

TEST_P(PrecisionOf, HillsIsTheFewestBitsWithinTheLimit) {
  const World world(sim::hills());
  const ref::Recording rays =
      ref::record_rays(world.scene, *ref::make_tracer(world.scene.mesh, world.bvh, {}),
                       {.width = World::width, .height = World::height});
  EXPECT_GT(rays.counts.total().rays, std::uint64_t{World::width} * World::height);
  const rtl::Design& design = rtl::find_design(GetParam());
  PrecisionSearch search{.design = &design,
                         .scene = &world.scene,
                         .bvh = &world.bvh,
                         .demands = &world.demands,
                         .rays = &rays,
                         .most = hls::IntBits{24, 24},
                         .overhead_pct = 3.0};
  const auto found = fewest_bits(search);
  ASSERT_TRUE(found.has_value());
  EXPECT_LE(found->extra_box_tests_pct, search.overhead_pct);
  EXPECT_EQ(found->extra_box_tests_pct, extra_box_tests_pct(search, found->format));
  // Every narrower format of the program exceeds the limit.
  int narrower = 0;
  const auto bits = found->format.as<hls::IntBits>();
  for (int n = hls::IntBits::min_coord; n <= bits.coord; ++n) {
    for (int t = hls::IntBits::min_interval; t <= std::min(24, 2 * n - 1); ++t) {
      if (n == bits.coord && t >= bits.interval) continue;
      EXPECT_GT(extra_box_tests_pct(search, hls::IntBits{n, t}), search.overhead_pct) << n << '/' << t;
      ++narrower;
    }
  }
  EXPECT_GT(narrower, 0);

  // Dropped bits stay within the limit.
  EXPECT_LE(found->coarse_extra_box_tests_pct, search.overhead_pct);
  EXPECT_EQ(found->coarse_extra_box_tests_pct, extra_box_tests_pct(search, found->format, found->coarse));
  EXPECT_TRUE(no_further_bit(search, *found));

  // Without a limit only the bits that the grid needs are left. With an impossible limit there is no result.
  search.overhead_pct = 1e9;
  const auto coarsest = fewest_bits(search);
  EXPECT_EQ(coarsest->format, Format(hls::IntBits{6, 6}));
  EXPECT_TRUE(coarsest->coarse.any());
  EXPECT_TRUE(no_further_bit(search, *coarsest));
  EXPECT_TRUE(found->ends);
  EXPECT_FALSE(coarsest->ends);
  search.overhead_pct = -50.0;
  EXPECT_FALSE(fewest_bits(search).has_value());
}

TEST(PrecisionOfFloats, IsWhetherRaysEnd) {
  const World world(sim::hills());
  const ref::Recording rays =
      ref::record_rays(world.scene, *ref::make_tracer(world.scene.mesh, world.bvh, {}),
                       {.width = World::width, .height = World::height});
  for (const char* const name : {"fp_slabs", "fp_plucker"}) {
    PrecisionSearch search{.design = &rtl::find_design(name),
                           .scene = &world.scene,
                           .bvh = &world.bvh,
                           .demands = &world.demands,
                           .rays = &rays,
                           .most = hls::Binary32{}};
    const auto found = fewest_bits(search);
    const double endless = extra_box_tests_pct(search, hls::Binary32{}, {}, false);
    EXPECT_GT(endless, search.overhead_pct) << name;
    EXPECT_EQ(found->endless_extra_box_tests_pct, endless) << name;
    EXPECT_TRUE(found->ends) << name;
    search.overhead_pct = endless;
    EXPECT_FALSE(fewest_bits(search)->ends) << name;
  }
}

TEST(PrecisionOfLeastCost, IsBetweenBitsAndTests) {
  const World world(sim::hills());
  const ref::Recording rays =
      ref::record_rays(world.scene, *ref::make_tracer(world.scene.mesh, world.bvh, {}),
                       {.width = World::width, .height = World::height});
  PrecisionSearch search{.design = &rtl::find_design("int_slabs"),
                         .scene = &world.scene,
                         .bvh = &world.bvh,
                         .demands = &world.demands,
                         .rays = &rays,
                         .most = hls::IntBits{20, 20}};
  const auto limited = fewest_bits(search)->format.as<hls::IntBits>();
  double test_price = 0;
  search.cost = [&](const Precision& precision, const ref::TraceCounts& tests) {
    const auto bits = precision.format.as<hls::IntBits>();
    return 100.0 * bits.coord + bits.interval + (precision.ends ? 0 : 1) +
           test_price * static_cast<double>(tests.triangle_tests);
  };
  const auto cheap = fewest_bits(search);
  EXPECT_EQ(cheap->format, Format(hls::IntBits{6, 6}));
  EXPECT_TRUE(cheap->ends);
  EXPECT_FALSE(cheap->coarse.any());

  test_price = 1e9;
  const auto careful = fewest_bits(search);
  EXPECT_GE(careful->format.as<hls::IntBits>().coord, limited.coord);
  EXPECT_LE(careful->extra_triangle_tests_pct, cheap->extra_triangle_tests_pct);
}

INSTANTIATE_TEST_SUITE_P(Designs, PrecisionOf, testing::Values("int_slabs", "int_plucker"),
                         [](const auto& parameter) { return std::string(parameter.param); });

}  // namespace
}  // namespace hitpipe::sim::fit_test
