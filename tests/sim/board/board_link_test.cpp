// The top module answers on its serial line as the C++ does, byte for byte; lost bytes cost a test sent
// again; and what is wrong is found: damaged Verilog, another unit, a board that is silent.
#include "sim/board/board_link.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/board/board_tests.hpp"
#include "sim/board/frame.hpp"
#include "sim/cosim/counts.hpp"
#include "tests/message_of.hpp"
#include "tests/pseudo_terminal.hpp"
#include "tests/sim/board/served_board.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::board_link_test {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t test_count = 200;
constexpr std::uint64_t board_seed = 5;

const rtl::Design& slabs_design() {
  return rtl::find_design("int_slabs");
}
Format small_format() {
  return hls::IntBits{6, 6};
}

BoardCounts run_tests(BoardLink& link, BoardTests& tests, std::size_t count) {
  std::uint64_t number = 0;
  return link.run([&]() -> std::optional<NumberedTest> {
    if (number == count) return std::nullopt;
    auto test = tests.next();
    if (!test) return std::nullopt;
    return NumberedTest{number++, *std::move(test)};
  });
}

BoardCounts counts_of(const ServedBoard& board, const rtl::Design& design = slabs_design(),
                      const Format& format = small_format(),
                      milliseconds silence = std::chrono::seconds(10)) {
  host::SerialPort port = host::SerialPort::open(board.port(), 1'000'000);
  BoardLink link(port, design, format, board.patience(silence));
  link.require_same_unit();
  return run_tests(link, *drawn_tests(design, format, test_count, board_seed), test_count);
}

/// Minutes: only for a board that does not answer.
constexpr int most_exchanges = 60'000;

/// What the board answers to these bytes.
std::string answer_to(host::SerialPort& port, std::string bytes, std::size_t length) {
  std::string answer;
  for (int tries = 0; tries < most_exchanges && answer.size() < length; ++tries)
    answer += port.exchange(bytes, milliseconds{10});
  return answer;
}

TEST(SimulatedBoard, AnswersByteForByte) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const ServedBoard board;
  host::SerialPort port = host::SerialPort::open(board.port(), 1'000'000);
  const std::string who = to_frame("I?" + rtl::board_identity(slabs_design(), small_format()));
  EXPECT_EQ(answer_to(port, "\x7eI?MW\x7e", who.size()), who);
  // Noise before a frame, and a frame whose check sequence is wrong, get no answer.
  EXPECT_EQ(answer_to(port, "noise\x7eI?MX\x7e\x7eI?MW\x7e", who.size()), who);

  const std::vector<rtl::Port> ports = slabs_design().ports(small_format());
  const auto tests = drawn_tests(slabs_design(), small_format(), test_count, board_seed);
  std::string sent;
  std::string expected;
  // The tags of flag and escape are escaped too.
  for (const char tag : {'\x00', '\x01', '\x7d', '\x7e', '\x7f', '\xff'}) {
    const rtl::Vector test = *tests->next();
    sent += to_frame(std::string{'T', tag} + pack(ports, test.operands));
    expected += to_frame(std::string{'T', tag, static_cast<char>(test.results[0])});
  }
  EXPECT_EQ(answer_to(port, sent, expected.size()), expected);
}

TEST(SimulatedBoard, AnswersAsTheCpp) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const BoardCounts counts = counts_of(ServedBoard());
  EXPECT_EQ(counts.tests, test_count);
  EXPECT_EQ(counts.mismatches, 0U);
  EXPECT_EQ(counts.resent, 0U);
  EXPECT_GT(counts.hits, test_count / 5);
  EXPECT_LT(counts.hits, test_count * 4 / 5);
}

TEST(SimulatedBoard, AnswersForTwoBoxesToo) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const rtl::Design& pair = rtl::find_design("int_major_pair");
  const Format format = pair.parse_format("6+0/4");
  const BoardCounts counts =
      counts_of(ServedBoard({.design = "int_major_pair", .bits = "6+0/4"}), pair, format);
  EXPECT_EQ(counts.tests, test_count);
  EXPECT_EQ(counts.mismatches, 0U);
}

TEST(SimulatedBoard, WaitsForAUnitThatTakesATestEveryFewCycles) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  for (const int interval : {3, 64}) {
    const BoardCounts counts = counts_of(ServedBoard({.interval = interval}));
    EXPECT_EQ(counts.tests, test_count);
    EXPECT_EQ(counts.mismatches, 0U);
    EXPECT_EQ(counts.resent, 0U);
  }
}

TEST(SimulatedBoard, LostBytesCostTestsSentAgain) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const auto every_150th = [](std::uint64_t byte) { return byte % 150 == 149; };
  const BoardCounts counts =
      counts_of(ServedBoard({.loses = every_150th}), slabs_design(), small_format(), milliseconds{400});
  EXPECT_EQ(counts.tests, test_count);
  EXPECT_EQ(counts.mismatches, 0U);
  EXPECT_GT(counts.resent, test_count * 15 / 150 / 2);
}

TEST(SimulatedBoard, DamagedUnitGivesMismatches) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const BoardCounts counts = counts_of(ServedBoard({.good = " - ", .bad = " + "}));
  EXPECT_EQ(counts.tests, test_count);
  EXPECT_GT(counts.mismatches, 0U);
  ASSERT_TRUE(counts.first_wrong);
  EXPECT_NE(counts.first_wrong->results, counts.first_wrong->test.results);
  const auto tests = drawn_tests(slabs_design(), small_format(), test_count, board_seed);
  for (std::uint64_t i = 0; i < counts.first_wrong->number; ++i) (void)tests->next();
  EXPECT_EQ(tests->next()->operands, counts.first_wrong->test.operands);
}

TEST(SimulatedBoard, OtherUnitIsRefused) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const ServedBoard board;
  host::SerialPort port = host::SerialPort::open(board.port(), 1'000'000);
  const Format other = hls::IntBits{6, 7};
  BoardLink link(port, slabs_design(), other, board.patience());
  EXPECT_EQ(message_of<std::runtime_error>([&] { link.require_same_unit(); }),
            fmt::format("{}: the board has \"{}\", and the tests are for \"{}\"", board.port(),
                        rtl::board_identity(slabs_design(), small_format()),
                        rtl::board_identity(slabs_design(), other)));
}

TEST(BoardLink, SilenceIsReported) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const host::SerialPort nobody = host::SerialPort::pseudo_terminal();
  host::SerialPort port = host::SerialPort::open(nobody.name(), 1'000'000);
  BoardLink link(port, slabs_design(), small_format(), {milliseconds{20}, 2});
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)link.identity(); }),
            nobody.name() + ": no answer; is this the board's port, and has it been programmed?");
}

TEST(BoardLink, BoardThatFallsSilentIsReported) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const ServedBoard board({.loses = [](std::uint64_t byte) { return byte > 1000; }});
  host::SerialPort port = host::SerialPort::open(board.port(), 1'000'000);
  BoardLink link(port, slabs_design(), small_format(), board.patience(milliseconds{200}, 3));
  link.require_same_unit();
  const auto tests = drawn_tests(slabs_design(), small_format(), test_count, board_seed);
  EXPECT_THAT(message_of<WrongHardware>([&] { (void)run_tests(link, *tests, test_count); }),
              testing::MatchesRegex(board.port() +
                                    ": the board does not answer any more; [1-9][0-9]* tests were answered"));
}

TEST(SceneTests, AreThoseOfTraversals) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const auto first = [&](std::uint64_t seed) {
    return scene_tests(slabs_design(), small_format(), scene, bvh, {.width = 16, .height = 16, .seed = seed});
  };
  const auto one = first(1);
  const auto same = first(1);
  const auto other = first(2);
  const rtl::Evaluate evaluate = slabs_design().evaluate(small_format());
  int hits = 0;
  bool differs = false;
  for (int i = 0; i < 500; ++i) {
    const rtl::Vector test = *one->next();
    EXPECT_EQ(same->next()->operands, test.operands);
    differs = differs || other->next()->operands != test.operands;
    EXPECT_EQ(evaluate(test.operands.data()), test.results[0] != 0);
    hits += test.results[0] != 0 ? 1 : 0;
  }
  EXPECT_TRUE(differs);
  EXPECT_GT(hits, 50);
  EXPECT_LT(hits, 490);
}

TEST(SimulatedBoard, AnswersTheTestsOfAScene) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const ServedBoard board;
  host::SerialPort port = host::SerialPort::open(board.port(), 1'000'000);
  BoardLink link(port, slabs_design(), small_format(), board.patience());
  const BoardCounts counts = run_tests(
      link, *scene_tests(slabs_design(), small_format(), scene, bvh, {.width = 16, .height = 16}), 300);
  EXPECT_EQ(counts.tests, 300U);
  EXPECT_EQ(counts.mismatches, 0U);
  EXPECT_GT(counts.hits, 0U);
}

}  // namespace
}  // namespace hitpipe::sim::board_link_test
