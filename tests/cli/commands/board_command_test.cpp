// `hitpipe board` against the top module behind a pseudo-terminal: counts, exit codes, and one line for each
// thing that can be wrong.
#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/pseudo_terminal.hpp"
#include "tests/sim/board/served_board.hpp"
#include "tests/sim/temporary_folder.hpp"

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
class Process {
 public:
  explicit Process(const std::string& arguments)
      : program_(popen(
            ("echo $$; exec " HITPIPE_PROGRAM " " + arguments + " --format csv 2>/dev/null").c_str(), "r")) {
    std::array<char, 512> line{};
    while (lines_.size() < 3 && program_ != nullptr &&
           std::fgets(line.data(), line.size(), program_.get()) != nullptr)
      lines_.emplace_back(line.data());
  }
  ~Process() {
    if (!lines_.empty()) kill(std::stoi(lines_[0]), SIGTERM);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] std::string said() const { return lines_.size() < 3 ? "" : lines_[2]; }
  [[nodiscard]] std::string port() const {
    const std::size_t at = said().find("/dev/pts/");
    return at == std::string::npos ? "" : said().substr(at, said().find(',', at) - at);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { pclose(file); }
  };
  std::unique_ptr<std::FILE, Close> program_;
  std::vector<std::string> lines_;
};

TEST(BoardCommand, SimulatesABoard) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const Process program("board int_slabs --bits 6/6 --simulate");
  EXPECT_THAT(program.said(), testing::StartsWith("int_slabs,n6/6,/dev/pts/"));
  const Outcome outcome = board(program.port(), {"--tests", "50"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST(BoardCommand, TracesAPictureByACore) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const Process program("core board --bits 8+0/5s8 --simulate");
  EXPECT_THAT(program.said(), testing::StartsWith("hitpipe_core_8p0_5s8,8+0/5s8,/dev/pts/"));
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "picture").string();
  const auto trace = [&](const std::vector<std::string>& more) {
    return run_hitpipe(with({"core", "board", "--port", program.port(), "--scene", "waves", "--width", "8",
                             "--height", "8", "--format", "json"},
                            more));
  };
  const Outcome outcome = trace({"--bits", "8+0/5s8", "--triangles", "1000", "--out", out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["wrong"], 0);
  EXPECT_GT(json["hits"], 10);
  EXPECT_TRUE(std::filesystem::exists(out + "/waves.png"));

  const std::string image = (folder.path() / "waves.bin").string();
  EXPECT_EQ(run_hitpipe({"core", "image", "--scene", "waves", "--bits", "8+0s8", "--triangles", "1000",
                         "--out", image})
                .exit_code,
            0);
  const std::vector<std::string> of_image{"core",     "board", "--port",   program.port(),
                                          "--image",  image,   "--width",  "8",
                                          "--height", "8",     "--format", "json"};
  const Outcome again = run_hitpipe(with(of_image, {"--bits", "8+0/5s8"}));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const auto row = nlohmann::json::parse(again.out);
  EXPECT_EQ(row["wrong"], 0);
  EXPECT_GT(row["hits"], 10);
  EXPECT_EQ(row["image"], image);
  EXPECT_EQ(row["blocks"], json["blocks"]);

  const Outcome large = trace({"--bits", "8+0/5s8", "--triangles", "20000"});
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_THAT(large.err,
              testing::MatchesRegex("hitpipe: waves: [^\n]+ lose their area at 8 bits[^\n]+\nhitpipe: the "
                                    "scene's image has [0-9]+ blocks of 32 bytes, and "
                                    "the memory of the board's chip has room for 4096\n"));
  const Outcome other = trace({});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, testing::StartsWith("hitpipe: " + program.port() +
                                             ": the board has \"hitpipe 1 core 8+0/5s8 "));
}

}  // namespace
}  // namespace hitpipe::cli::board_command_test
