// The boards of the program are whole. Wrong boards and wrong rates are refused with one line.
#include "rtl_gen/board/board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::board_test {
namespace {

TEST(Board, IcebreakerHasItsPins) {
  const Board board = find_board("icebreaker");
  EXPECT_EQ(board.target, "ice40_up5k");
  EXPECT_NO_THROW((void)find_design(board.design).parse_format(board.bits));
  EXPECT_EQ(board.clock_hz, 12'000'000);
  ASSERT_EQ(board.pins.size(), 6U);
  EXPECT_EQ(board.pins[0].port, "clk");
  EXPECT_EQ(board.pins[0].pin, "35");
}

TEST(Board, ClockGivesOnlyRatesWithinTwoPercent) {
  const Board board = find_board("icebreaker");
  EXPECT_EQ(board.clocks_per_bit(board.baud), 12);
  EXPECT_EQ(board.clocks_per_bit(3'000'000), 4);
  EXPECT_EQ(board.clocks_per_bit(115'200), 104);
  EXPECT_EQ(board.clocks_per_bit(921'600), 13);
  const auto refused = [&](int baud) { return message_of([&] { return board.clocks_per_bit(baud); }); };
  EXPECT_EQ(
      refused(5'000'000),
      "5000000 baud: the clock of icebreaker (12000000 Hz) must be 4 to 65535 times as fast and a whole "
      "multiple within 2 %; 1000000 is usual");
  EXPECT_NE(refused(2'300'000), "");  // 5.2 clocks
  EXPECT_NE(refused(100), "");
  EXPECT_NE(refused(0), "");
}

TEST(Board, UnitHasThreeQuartersOfTheClockPeriod) {
  EXPECT_EQ(find_board("icebreaker").unit_clock_ps(), 62'500);
}

TEST(Board, UnknownNameIsRefused) {
  EXPECT_EQ(message_of([] { return find_board("arty"); }), "board arty: unknown; there are: icebreaker");
}

TEST(Board, DamagedFileIsRefused) {
  const auto refused = [](std::string_view json) {
    return message_of([&] { return parse_board({"mine", json}); });
  };
  EXPECT_THAT(refused("{"), testing::StartsWith("board mine: "));
  EXPECT_THAT(refused(R"({"description": "x"})"), testing::HasSubstr("source"));
  EXPECT_EQ(refused(R"({"description": "x", "source": "y", "target": "ice40_hx", "design": "int_slabs",
                        "bits": "12/12", "clock_hz": 0, "baud": 115200, "pins": {}})"),
            "board mine: clock_hz 0 must be above 0");
  EXPECT_EQ(refused(R"({"description": "x", "source": "y", "target": "ice40_hx", "design": "int_slabs",
                        "bits": "12/12", "clock_hz": 12000000, "baud": 115200, "pins": {"clk": "J3", "rx": "B10", "tx": "B12", "button_n": 1,
                        "led_red_n": "C3"}})"),
            "board mine: port led_green_n has no pin");
}

}  // namespace
}  // namespace hitpipe::rtl::board_test
