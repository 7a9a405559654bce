// Co-simulation of a unit from its files: whole units run on any scene, fitted units on scenes that meet
// their demands.
#include <stdexcept>

#include <gtest/gtest.h>

#include "host/files.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/fit/fit.hpp"
#include "sim/unit/verilated_design.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"
#include "tests/sw_ref/quantise/demand_scenes.hpp"

namespace hitpipe::sim::unit_cosim_test {
namespace {

const rtl::Design& design() {
  return rtl::find_design("int_slabs");
}

CosimResult run(const Unit& unit, const ref::Scene& scene) {
  return cosimulate(VerilatedDesign(unit), scene, ref::build_bvh(scene.mesh),
                    {.width = 24, .height = 16, .referee = true});
}

/// The unit fitted to the hills, as the files of the fit state it.
Unit fitted_to(const ref::Scene& scene) {
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
  const Unit unit = make_unit(design(), hls::IntBits{12, 12}, library);
  EXPECT_TRUE(unit.demands.empty());
  EXPECT_TRUE(unit.ends);
  EXPECT_FALSE(unit.coarse.any());
  const TemporaryFolder folder;
  host::write_files(folder.path(),
                    rtl::emit(design(), hls::IntBits{12, 12}, library,
                              rtl::make_pipeline(design().trace(hls::IntBits{12, 12}), library))
                        .files());
  const Unit read = read_unit(folder.path(), design(), library);
  EXPECT_EQ(read.verilog, unit.verilog);
  EXPECT_EQ(read.pipeline.latency(), unit.pipeline.latency());
}

TEST(UnitCosim, OfACutUnitChecksEveryOperand) {
  const ref::Scene flat = ref::flat_hills();
  const Unit unit = fitted_to(flat);
  EXPECT_FALSE(unit.demands.empty());
  EXPECT_TRUE(run(unit, flat).verified(true));
  EXPECT_THROW((void)run(unit, hills()), std::out_of_range);
}

}  // namespace
}  // namespace hitpipe::sim::unit_cosim_test
