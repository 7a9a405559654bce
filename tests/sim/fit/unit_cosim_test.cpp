// Co-simulation of a unit from its files: whole units run on any scene, fitted ones on scenes that meet their
// demands.
#include "sim/fit/unit_cosim.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "host/files.hpp"
#include "sim/fit/fit.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"
#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::sim::unit_cosim_test {
namespace {

const rtl::Design& design() {
  return rtl::find_design("int_slabs");
}

CosimResult run(const WrittenUnit& unit, const ref::Scene& scene) {
  return cosimulate_unit(design(), unit, verilate(design(), unit), scene, ref::build_bvh(scene.mesh),
                         {.width = 24, .height = 16, .referee = true});
}

/// The unit fitted to the hills, as the files of the fit state it.
WrittenUnit fitted_to(const ref::Scene& scene) {
  const rtl::Library& library = rtl::Library::thesis();
  const ref::SceneDemands demands = ref::scene_demands(scene, ref::build_bvh(scene.mesh), {24, 16});
  const TemporaryFolder folder;
  host::write_files(
      folder.path(),
      fitted_files(fit(design(), hls::IntBits{12, 12}, std::nullopt, demands, library), library).files());
  return read_unit(folder.path(), design(), library);
}

TEST(WholeUnit, IsWhatIsWrittenOfTheDesign) {
  const rtl::Library& library = rtl::Library::thesis();
  const WrittenUnit unit = whole_unit(design(), hls::IntBits{12, 12}, library);
  EXPECT_TRUE(unit.demands.empty());
  EXPECT_TRUE(unit.ends());
  EXPECT_FALSE(unit.coarse().any());
  const TemporaryFolder folder;
  host::write_files(folder.path(),
                    rtl::emit(design(), hls::IntBits{12, 12}, library,
                              rtl::make_pipeline(design().trace(hls::IntBits{12, 12}), library))
                        .files());
  const WrittenUnit read = read_unit(folder.path(), design(), library);
  EXPECT_EQ(read.verilog, unit.verilog);
  EXPECT_EQ(read.pipeline.latency(), unit.pipeline.latency());
}

TEST(UnitCosim, OfAWholeUnitIsTheDesigns) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const VerilatedDesign verilated(design(), hls::IntBits{12, 12}, rtl::Library::thesis());
  const CosimResult of_design = cosimulate(design(), hls::IntBits{12, 12}, verilated, scene, bvh,
                                           {.width = 24, .height = 16, .referee = true});
  const CosimResult of_unit = run(whole_unit(design(), hls::IntBits{12, 12}, rtl::Library::thesis()), scene);
  EXPECT_EQ(of_unit.unit, of_design.unit);
  EXPECT_EQ(of_unit.triangles, of_design.triangles);
  EXPECT_TRUE(of_unit.verified(true));
}

TEST(UnitCosim, OfACutUnitChecksEveryOperand) {
  const ref::Scene flat = ref::flat_hills();
  const WrittenUnit unit = fitted_to(flat);
  EXPECT_FALSE(unit.demands.empty());
  EXPECT_TRUE(run(unit, flat).verified(true));
  EXPECT_THROW((void)run(unit, hills()), std::out_of_range);
}

}  // namespace
}  // namespace hitpipe::sim::unit_cosim_test
