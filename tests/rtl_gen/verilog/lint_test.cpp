// Verilator, Yosys and Icarus accept every design's Verilog without a warning.
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::lint_test {
namespace {

TEST(Lint, EveryDesignIsSilent) {
  const ScratchFolder folder;
  std::vector<std::vector<std::string>> modules;
  std::string benches;
  for (const DesignFormat& d : every_design()) {
    host::write_files(folder.path(), d.emitted().files());
    modules.push_back({d.module()});
    benches += " tb/" + d.module() + "_tb.sv " + d.module() + ".v";
  }
  expect_silent_tools(folder.path(), modules);
  const ToolResult verilator =
      run_tool(folder.path(), "verilator", "verilator", "--lint-only --timing -Wall -Wno-MULTITOP" + benches);
  EXPECT_EQ(verilator.output, "");
  const ToolResult icarus =
      run_tool(folder.path(), "iverilog", "iverilog", "-g2012 -Wall -o testbench" + benches);
  EXPECT_EQ(icarus.output, "");
}

/// A design with one line replaced.
class LintOfADamagedDesign : public testing::Test {
 protected:
  void damage(const std::string& good, const std::string& bad) {
    const Pipeline pipeline = int_slabs_pipeline(hls::IntBits{6, 6});
    std::string text =
        emit(make_unit(find_design("int_slabs"), hls::IntBits{6, 6}, Library::thesis(), pipeline))
            .verilog.contents;
    const std::size_t at = text.find(good);
    ASSERT_NE(at, std::string::npos);
    write_text(folder / "int_slabs_6_6.v", text.replace(at, good.size(), bad));
  }
  ScratchFolder folder;
};

TEST_F(LintOfADamagedDesign, VerilatorSeesAWidth) {
  damage("wire [5:0] d0_x", "wire [6:0] d0_x");
  const ToolResult result =
      run_tool(folder.path(), "verilator", "verilator", "--lint-only -Wall int_slabs_6_6.v");
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.output.find("%Warning-WIDTH"), std::string::npos) << result.output;
}

TEST_F(LintOfADamagedDesign, YosysSeesAWireWithoutDriver) {
  damage("wire [5:0] d0_x = ixmin_s0 - irx_s0;", "wire [5:0] d0_x;");
  const ToolResult result = run_tool(
      folder.path(), "yosys", "yosys",
      "-q -p 'read_verilog int_slabs_6_6.v; hierarchy -check -top int_slabs_6_6; proc; check -assert'");
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.output.find("d0_x"), std::string::npos) << result.output;
}

TEST_F(LintOfADamagedDesign, IcarusSeesAnUnknownName) {
  damage("wire [5:0] d0_x", "wire [5:0] d0_w");
  const ToolResult result =
      run_tool(folder.path(), "iverilog", "iverilog", "-g2001 -Wall -o design int_slabs_6_6.v");
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.output.find("d0_x"), std::string::npos) << result.output;
}

TEST(RunTool, AMissingProgramIsToldItsPackage) {
  const ScratchFolder folder;
  EXPECT_EQ(message_of<std::runtime_error>(
                [&] { run_tool(folder.path(), "some-package", "hitpipe-no-such-program", ""); }),
            "hitpipe-no-such-program was not found; install the package some-package");
}

}  // namespace
}  // namespace hitpipe::rtl::lint_test
