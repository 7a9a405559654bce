// `hitpipe implement --board` ends in a bitstream on the board's pins, and says in one line why there is
// none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::implement_board_test {
namespace {

TEST(ImplementBoard, EndsInABitstream) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const Outcome outcome =
      run_hitpipe({"implement", "int_slabs", "--bits", "6/6", "--target", "ice40_up5k", "--board",
                   "icebreaker", "--seeds", "1", "--format", "json", "--out", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["module"], "int_slabs_6_6_board");
  EXPECT_GT(json["luts"], 100);
  EXPECT_GT(json["fmax_mhz"], 12);
  EXPECT_EQ(json["clock_mhz"], 12);
  // All bitstreams of this chip are of one size; they begin with the preamble.
  const std::string bitstream = contents_of(json["bitstream"].get<std::string>());
  EXPECT_EQ(bitstream.size(), 104'090U);
  EXPECT_EQ(json["bitstream_bytes"], bitstream.size());
  EXPECT_THAT(bitstream, testing::HasSubstr("\x7e\xaa\x99\x7e"));
  EXPECT_THAT(contents_of(out + "/ice40_up5k/int_slabs_6_6_board.pcf"), testing::HasSubstr("set_io tx 9\n"));
  EXPECT_THAT(contents_of(out + "/ice40_up5k/int_slabs_6_6_board.v"),
              testing::HasSubstr("CLOCKS_PER_BIT = 16'd12"));
}

TEST(ImplementBoard, WhatIsWrongIsOneLine) {
  const sim::TemporaryFolder folder;
  const auto rejected = [&](std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), "implement");
    arguments.insert(arguments.end(), {"--out", (folder / "out").string()});
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  };
  rejected({"--board", "arty"}, "board arty: unknown; there are: icebreaker");
  rejected({"--board", "icebreaker", "--target", "xc7"},
           "--target xc7: the chip on icebreaker is ice40_up5k");
  rejected({"--board", "icebreaker", "--baud", "5000000"},
           "5000000 baud: the clock of icebreaker (12000000 Hz) must be 4 to 65535 times as fast and a whole "
           "multiple within 2 %; 1000000 is usual");
  rejected({"int_slabs"}, "implement: name a design and a --target, or a --board");
  rejected({"--target", "ice40_up5k"}, "implement: name a design and a --target, or a --board");
}

}  // namespace
}  // namespace hitpipe::cli::implement_board_test
