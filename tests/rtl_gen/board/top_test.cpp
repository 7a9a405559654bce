// The top module of a board is plain Verilog-2001 for all tools, and says what unit it has.
#include "rtl_gen/board/top.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::top_test {
namespace {

/// Ports that need no padding, results of a byte and of several, one result bit alone.
TEST(BoardTop, LintIsSilent) {
  for (const DesignFormat& d :
       {DesignFormat{"int_slabs", "16/16"}, DesignFormat{"int_slabs", "12/12"},
        DesignFormat{"int_major", "20+1/13"}, DesignFormat{"int_major_pair", "16+0/8"}}) {
    for (const int interval : {1, 3}) {
      SCOPED_TRACE(testing::PrintToString(d) + fmt::format(" every {}", interval));
      const Pipeline pipeline =
          make_pipeline(d.found().trace(d.parsed()), Library::thesis(), std::nullopt, interval);
      const ScratchFolder folder;
      write_text(folder / "unit.v",
                 to_verilog(pipeline, Library::thesis(), {.module_name = d.module(), .bits = d.format}));
      write_text(folder / "top.v", board_top(board_unit(d.found(), d.parsed(), d.module(), pipeline), 12));
      const std::string top = board_module(d.module());
      expect_silence(folder.path(), "verilator",
                     fmt::format("--lint-only -Wall --top-module {} -Wno-DECLFILENAME top.v unit.v", top));
      expect_silence(
          folder.path(), "yosys",
          fmt::format("-q -p 'read_verilog top.v unit.v; hierarchy -check -top {}; proc; check -assert'",
                      top));
      expect_silence(folder.path(), "iverilog", "-g2001 -Wall -o design top.v unit.v");
    }
  }
}

TEST(BoardIdentity, TellsDesignsAndFormatsApart) {
  const auto identity = [](const char* design, const char* format) {
    return board_identity(find_design(design), find_design(design).parse_format(format));
  };
  EXPECT_THAT(identity("int_slabs", "16/16"),
              testing::MatchesRegex("hitpipe 1 int_slabs 16/16 [0-9a-f]{16}"));
  const auto print = [&](const char* design, const char* format) {
    const std::string whole = identity(design, format);
    return whole.substr(whole.rfind(' '));
  };
  EXPECT_EQ(print("int_slabs", "16/16"), print("int_slabs", "16/16"));
  EXPECT_NE(print("int_slabs", "16/16"), print("int_slabs", "16/15"));
  EXPECT_NE(print("int_slabs", "16/16"), print("int_plucker", "16/16"));
  // The same ports: only what they answer differs.
  EXPECT_NE(print("int_plucker", "16/16"), print("int_plucker", "16/12"));
}

}  // namespace
}  // namespace hitpipe::rtl::top_test
