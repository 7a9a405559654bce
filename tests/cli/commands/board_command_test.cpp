// `hitpipe board` against the top module behind a pseudo-terminal: counts, exit codes, and one line for each
// thing that can be wrong.
#include <csignal>
#include <cstdio>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/pseudo_terminal.hpp"
#include "tests/sim/board/served_board.hpp"

namespace hitpipe::cli::board_command_test {
namespace {

using sim::ServedBoard;

Outcome board(const std::string& port, const std::vector<std::string>& more = {},
              const std::string& bits = "6/6") {
  return run_hitpipe(with({"board", "int_slabs", "--bits", bits, "--port", port}, more));
}

void rejected(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
}

TEST(BoardCommand, StreamsVectorsAndScenes) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const ServedBoard served;
  const Outcome vectors = board(served.port(), {"--tests", "100", "--format", "json"});
  EXPECT_EQ(vectors.exit_code, 0);
  EXPECT_EQ(vectors.err, "");
  const auto json = nlohmann::json::parse(vectors.out);
  EXPECT_EQ(json["tests"], 100);
  EXPECT_EQ(json["mismatches"], 0);
  EXPECT_EQ(json["tests_from"], "vectors");
  EXPECT_GT(json["hits"], 0);

  const Outcome scene =
      board(served.port(), {"--scene", "waves", "--triangles", "1000", "--tests", "150", "--format", "json"});
  EXPECT_EQ(scene.exit_code, 0) << scene.err;
  EXPECT_EQ(nlohmann::json::parse(scene.out)["tests"], 150);
  EXPECT_EQ(nlohmann::json::parse(scene.out)["mismatches"], 0);

  const Outcome one = board(served.port(), {"--tests", "100", "--only", "7", "--format", "csv"});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_THAT(one.out, testing::HasSubstr(",vectors,1,1,"));
}

TEST(BoardCommand, MismatchesAreFoundAndCanBeSentAlone) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const ServedBoard served({.good = " - ", .bad = " + "});
  const Outcome outcome = board(served.port(), {"--tests", "100"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, testing::MatchesRegex(
                               "hitpipe: test [0-9]+: the board says hit=0x[01], the C\\+\\+ hit=0x[01], "
                               "for irx=0x.* izmax=0x[0-9a-f]+; `--only [0-9]+` sends it alone\n"));
  const std::size_t at = outcome.err.find("--only ") + 7;
  const Outcome alone = board(
      served.port(), {"--tests", "100", "--only", outcome.err.substr(at, outcome.err.find('`', at) - at)});
  EXPECT_EQ(alone.exit_code, 1);
  EXPECT_EQ(alone.err, outcome.err);
}

TEST(BoardCommand, WhatIsWrongIsOneLine) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  rejected(board("/dev/no_such_port"),
           "/dev/no_such_port: cannot be opened as a serial port: No such file or directory");
  const ServedBoard served;
  const Outcome other = board(served.port(), {}, "6/7");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, testing::StartsWith("hitpipe: " + served.port() +
                                             ": the board has \"hitpipe 1 int_slabs 6/6 "));
  rejected(board(served.port(), {"--tests", "10", "--only", "10"}),
           "--only 10: allowed is 0 to 9, below --tests");
  rejected(board(served.port(), {"--board", "arty"}), "board arty: unknown; there are: icebreaker");
}

/// The program as a board in a process of its own, which tells its number and then its port.
TEST(BoardCommand, SimulatesABoard) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  struct Close {
    void operator()(std::FILE* file) const { pclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> program(popen(
      "echo $$; exec " HITPIPE_PROGRAM " board int_slabs --bits 6/6 --simulate --format csv 2>/dev/null",
      "r"));
  ASSERT_TRUE(program);
  std::vector<std::string> lines;
  std::array<char, 512> line{};
  while (lines.size() < 3 && std::fgets(line.data(), line.size(), program.get()) != nullptr)
    lines.emplace_back(line.data());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[2], testing::StartsWith("int_slabs,6/6,/dev/pts/"));
  const std::size_t at = lines[2].find("/dev/pts/");
  const Outcome outcome = board(lines[2].substr(at, lines[2].find(',', at) - at), {"--tests", "50"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  kill(std::stoi(lines[0]), SIGTERM);
}

}  // namespace
}  // namespace hitpipe::cli::board_command_test
