// The top module of a core on a board is plain Verilog-2001 for all tools, and says what core it has.
#include "rtl_gen/board/core_top.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/format.hpp"
#include "rtl_gen/board/board.hpp"
#include "rtl_gen/board/top.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::core_top_test {
namespace {

CoreOptions at(const char* bits, int rays = 2) {
  CoreOptions options = *find_board("icebreaker").core;
  options.bits = parse_bits<hls::RayBits>(bits);
  options.rays = rays;
  return options;
}

/// A ray with more bytes than a word of the image, and one with fewer.
TEST(CoreBoardTop, LintIsSilent) {
  for (const char* bits : {"12+0/7s12", "8+0/5s8"}) {
    for (const int rays : {1, 4}) {
      SCOPED_TRACE(fmt::format("{} {}", bits, rays));
      const Core core = make_core(at(bits, rays), Library::thesis(), "core");
      const ScratchFolder folder;
      write_text(folder / "core.v", to_verilog(core, Library::thesis()));
      write_text(folder / "top.v", core_board_top(core, 12));
      expect_silence(folder.path(), "verilator",
                     "--lint-only -Wall --top-module core_board -Wno-DECLFILENAME top.v core.v");
      expect_silence(folder.path(), "iverilog", "-g2001 -Wall -o design top.v core.v");
    }
  }
}

TEST(CoreBoardTop, YosysFindsNothingWrong) {
  const Core core = make_core(at("8+0/5s8"), Library::thesis(), "core");
  const ScratchFolder folder;
  write_text(folder / "core.v", to_verilog(core, Library::thesis()));
  write_text(folder / "top.v", core_board_top(core, 12));
  expect_silence(folder.path(), "yosys",
                 "-q -p 'read_verilog top.v core.v; hierarchy -check -top core_board; proc; check -assert'");
}

TEST(CoreBoardTop, OtherCoresAreRefused) {
  CoreOptions options = at("8+0/5s8");
  options.tag_bits = 16;
  const Core core = make_core(options, Library::thesis());
  EXPECT_THROW((void)core_board_top(core, 12), std::logic_error);
}

TEST(CoreIdentity, TellsCoresApart) {
  const auto identity = [](const CoreOptions& options) {
    return core_identity(make_core(options, Library::thesis()));
  };
  const std::string usual = identity(at("12+0/7s12"));
  EXPECT_THAT(usual, testing::MatchesRegex("hitpipe 1 core 12\\+0/7s12 [0-9a-f]{16}"));
  EXPECT_EQ(identity(at("12+0/7s12")), usual);
  EXPECT_NE(identity(at("12+0/6s12")), usual);
  // The same fields: only what the core has room for differs.
  CoreOptions deeper = at("12+0/7s12");
  ++deeper.levels;
  EXPECT_NE(identity(deeper), usual);
}

}  // namespace
}  // namespace hitpipe::rtl::core_top_test
