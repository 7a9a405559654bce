// A unit and its wrappers without tags: TAG_BITS = 0.
#include <string>

#include <gtest/gtest.h>

#include "rtl_gen/emit/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::tag_bits_test {
namespace {

/// The tag then has one bit, which nobody needs to connect.
TEST(TagBits, OfZeroAreAcceptedByEveryTool) {
  const ScratchFolder folder;
  const DesignFormat d{"int_slabs", "12/12"};
  const auto write = [&](const UnitOptions& of_unit, const EmitOptions& options) {
    host::write_files(folder.path(), d.emitted(options, of_unit).files());
  };
  write({.module = "unit"}, {.axi_stream = true});
  write({.module = "still", .flow_control = FlowControl::none}, {.fifo = true});
  const auto accepted = [&](const std::string& top, const std::string& files) {
    const auto silent = [&](const std::string& program, const std::string& arguments) {
      const ToolResult result = run_tool(folder.path(), program, program, arguments);
      EXPECT_EQ(result.status, 0) << program << " " << top;
      EXPECT_EQ(result.output, "") << program << " " << top;
    };
    silent("verilator", "--lint-only -Wall -GTAG_BITS=0 --top-module " + top + " " + files);
    silent("iverilog", "-g2001 -Wall -P" + top + ".TAG_BITS=0 -s " + top + " -o tags.vvp " + files);
  };
  accepted("unit", "unit.v");
  accepted("unit_axis", "unit_axis.v unit.v");
  accepted("still_fifo", "still_fifo.v still.v");
}

}  // namespace
}  // namespace hitpipe::rtl::tag_bits_test
