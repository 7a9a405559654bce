// A run killed at any moment (SIGKILL, so none of its code runs any more) leaves whole files or none. The
// next run into the same folder makes all of them and removes the temporary files.
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/killed_at_call.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::killed_run_test {
namespace {

namespace fs = std::filesystem;

bool is_temporary(const std::string& file) {
  static const std::regex pattern(R"((.*/)?\..*\.hitpipe-[0-9a-f-]+)");
  return std::regex_match(file, pattern);
}

class KilledRun : public testing::Test {
 protected:
  /// Kills runs of the command into one folder, each `step` calls later among those that change files, until
  /// a run reaches its end. Between two such calls the files stay as they are.
  void kill_at_calls(const std::vector<std::string>& command, int step) const {
    const auto into = [&](const fs::path& folder) { return with(command, {"--out", folder.string()}); };
    const Outcome outcome = run_hitpipe(into(whole_));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<std::string> all = files_below(whole_);
    const fs::path folder = folder_.path() / "killed";
    fs::create_directory(folder);
    int killed = 0;
    bool left_some = false;
    bool left_temporary = false;
    for (int call = 1;; call += step) {
      const int ended = run_hitpipe(into(folder), killed_at_call(call)).exit_code;
      const std::size_t whole = whole_files(folder, call);
      if (ended != -1) {
        EXPECT_EQ(ended, 0);
        break;
      }
      ++killed;
      left_some = left_some || (whole > 0 && whole < all.size());
      left_temporary = left_temporary || files_below(folder).size() > whole;
    }
    fmt::print("{} runs killed\n", killed);
    EXPECT_GE(killed, 10);
    EXPECT_TRUE(left_temporary);
    EXPECT_TRUE(left_some);
    EXPECT_EQ(files_below(folder), all) << "a temporary file is left";
  }

 private:
  /// Each file in the folder under its final name is what the whole run wrote. Returns how many there are.
  [[nodiscard]] std::size_t whole_files(const fs::path& folder, int call) const {
    std::size_t files = 0;
    for (const std::string& file : files_below(folder)) {
      if (is_temporary(file)) continue;
      ++files;
      EXPECT_TRUE(contents_of(folder / file) == contents_of(whole_ / file))
          << file << " is not whole; killed at call " << call;
    }
    return files;
  }

  const sim::TemporaryFolder folder_;
  const fs::path whole_ = folder_.path() / "whole";
};

TEST_F(KilledRun, OfRtlLeavesOnlyWholeFiles) {
  kill_at_calls({"rtl", "int_slabs"}, 3);
}

TEST_F(KilledRun, OfCosimLeavesOnlyWholeFiles) {
  kill_at_calls({"cosim", "int_slabs", "--scene", "spheres", "--width", "32", "--height", "32"}, 2);
}

TEST_F(KilledRun, OfFitLeavesOnlyWholeFiles) {
  kill_at_calls({"fit", "--scene", "spheres", "--no-shadows", "--width", "8", "--height", "8", "int_slabs",
                 "--keep-bits", "--bits", "12/12", "--vectors", "1000"},
                5);
}

}  // namespace
}  // namespace hitpipe::cli::killed_run_test
