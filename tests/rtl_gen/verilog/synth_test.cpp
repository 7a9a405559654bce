// Yosys synthesises every design: no cell without gates, no latch, no wire without a driver.
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::synth_test {
namespace {

class Synth : public testing::TestWithParam<DesignFormat> {};

// Without ABC, which only makes it smaller. bench/synth.sh runs the whole synthesis.
TEST_P(Synth, YosysMapsItToGates) {
  const std::string design = GetParam().module();
  const ScratchFolder folder;
  host::write_files(folder.path(), GetParam().emitted().files());
  const ToolResult result = run_tool(folder.path(), "yosys", "yosys",
                                     "-q -p 'read_verilog " + design + ".v; synth -noabc -top " + design +
                                         "; check -assert; select -assert-none t:$* t:$_* %d; "
                                         "select -assert-none t:$_DLATCH*; select -assert-any t:$_DFF*'");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.output, "");
}

INSTANTIATE_TEST_SUITE_P(Designs, Synth, testing::ValuesIn(every_small_design()), design_suffix);

}  // namespace
}  // namespace hitpipe::rtl::synth_test
