// A signal, as of Ctrl-C, ends the program: what can be resumed says how, and no temporary folder is left.
#include <csignal>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::stopped_test {
namespace {

namespace fs = std::filesystem;

/// A tool sends the signal while it works, and then works for ever.
class Stopped : public testing::TestWithParam<int> {
 protected:
  Stopped() { fs::create_directory(scratch()); }

  /// Where the program puts temporary folders.
  [[nodiscard]] fs::path scratch() const { return folder_ / "scratch"; }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }

  [[nodiscard]] Outcome stopped(const std::string& words, int number) const {
    const std::string tool = folder_
                                 .write_program("tool", fmt::format(R"(#!/bin/sh
case "$1" in --version | -V | --getenv) echo stand-in; exit;; esac
kill -{} $PPID
exec sleep 1000
)",
                                                                    number))
                                 .string();
    return hitpipe(words, {{"TMPDIR", scratch().string()},
                           {"HITPIPE_CACHE", file("cache")},
                           {"VERILATOR", tool},
                           {"YOSYS", tool}});
  }

  const sim::TemporaryFolder folder_;
};

TEST_P(Stopped, SweepSaysThatItGoesOn) {
  const Outcome outcome =
      stopped("sweep int_slabs --bits 6/6 --scene spheres --width 8 --height 8 --out " + file("rows.csv"),
              GetParam());
  EXPECT_EQ(outcome.exit_code, -1);
  EXPECT_EQ(outcome.err,
            "hitpipe: stopped; the same command goes on with the rows of " + file("rows.csv") + "\n");
  for (const fs::directory_entry& each : fs::directory_iterator(file("cache")))
    EXPECT_FALSE(each.path().filename().string().starts_with("building-")) << each.path();
}

TEST_P(Stopped, ImplementLeavesNoTemporaryFolder) {
  const Outcome outcome =
      stopped("implement int_slabs --bits 6/6 --target xc7 --out " + file("out"), GetParam());
  EXPECT_EQ(outcome.exit_code, -1);
  EXPECT_EQ(outcome.err, "") << "it begins again";
  EXPECT_TRUE(fs::is_empty(scratch()));
}

INSTANTIATE_TEST_SUITE_P(Signals, Stopped, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& number) { return std::string(sigabbrev_np(number.param)); });

using StoppedOnce = Stopped;

TEST_P(StoppedOnce, PieceOfASweepKeepsItsRows) {
  const Outcome outcome =
      stopped("sweep int_slabs --bits 6/6,7/7 --scene spheres --width 8 --height 8 --piece 2/2 --out " +
                  file("2.csv"),
              GetParam());
  EXPECT_EQ(outcome.err,
            "hitpipe: stopped; the same command goes on with the rows of " + file("2.csv.part") + "\n");
}

TEST_P(StoppedOnce, OtherPieceBeginsAgain) {
  const Outcome outcome =
      stopped("core trace --scene spheres --width 8 --height 8 --rays-in-flight 2,4 --piece 2/2 --out " +
                  file("2.json"),
              GetParam());
  EXPECT_EQ(outcome.exit_code, -1);
  EXPECT_EQ(outcome.err, "hitpipe: stopped; the same command begins piece 2 of 2 again\n");
}

TEST_P(StoppedOnce, ReportSaysThatItGoesOn) {
  const Outcome outcome = stopped(
      "report int_slabs --bits 6/6 --scene spheres --width 8 --height 8 --out " + file("out"), GetParam());
  EXPECT_EQ(outcome.exit_code, -1);
  EXPECT_EQ(outcome.err,
            "hitpipe: stopped; the same command goes on with the rows of " + file("out/rows.csv") +
                "\nhitpipe: stopped; the same command keeps what is done in " + file("out") + "\n");
}

INSTANTIATE_TEST_SUITE_P(Signal, StoppedOnce, testing::Values(SIGINT),
                         [](const auto& number) { return std::string(sigabbrev_np(number.param)); });

/// Nothing of the program runs after SIGKILL.
TEST_P(StoppedOnce, FolderOfAKilledImplementIsRemovedByTheNext) {
  const std::string words = "implement int_slabs --bits 6/6 --target xc7 --out " + file("out");
  EXPECT_EQ(stopped(words, SIGKILL).exit_code, -1);
  EXPECT_FALSE(fs::is_empty(scratch()));
  EXPECT_EQ(stopped(words, GetParam()).exit_code, -1);
  EXPECT_TRUE(fs::is_empty(scratch()));
}

}  // namespace
}  // namespace hitpipe::cli::stopped_test
