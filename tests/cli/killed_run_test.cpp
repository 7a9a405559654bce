// A run killed at any moment (SIGKILL, so none of its code runs any more) leaves whole files or none. The
// next run into the same folder makes all of them and removes the temporary files.
#include <array>
#include <chrono>
#include <random>
#include <regex>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::killed_run_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Makes, renames and closings of files in a folder.
class FolderEvents {
 public:
  explicit FolderEvents(const fs::path& folder) : descriptor_(inotify_init1(IN_CLOEXEC)) {
    constexpr std::uint32_t kinds = IN_CREATE | IN_MODIFY | IN_CLOSE_WRITE | IN_MOVED_TO;
    EXPECT_GE(inotify_add_watch(descriptor_, folder.c_str(), kinds), 0);
  }
  ~FolderEvents() { close(descriptor_); }
  FolderEvents(const FolderEvents&) = delete;
  FolderEvents& operator=(const FolderEvents&) = delete;

  /// Waits for `count` events of files with `word` in their name, but at most for `most`.
  void wait_for(std::size_t count, std::string_view word, Clock::duration most) const {
    const Clock::time_point end = Clock::now() + most;
    std::size_t seen = 0;
    while (seen < count && Clock::now() < end) {
      pollfd ready{descriptor_, POLLIN, 0};
      if (poll(&ready, 1, 1) <= 0) continue;
      alignas(inotify_event) std::array<char, 1 << 14> buffer{};
      const ssize_t got = read(descriptor_, buffer.data(), buffer.size());
      for (ssize_t at = 0; at < got;) {
        const auto* const event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
        at += static_cast<ssize_t>(sizeof(inotify_event)) + event->len;
        if (event->len > 0 && std::string_view(event->name).find(word) != std::string_view::npos) ++seen;
      }
    }
  }

 private:
  int descriptor_;
};

bool is_temporary(const std::string& file) {
  static const std::regex pattern(R"((.*/)?\..*\.hitpipe-[0-9a-f-]+)");
  return std::regex_match(file, pattern);
}

class KilledRun : public testing::Test {
 protected:
  /// The command with its --out, run to its end, to compare killed runs with. The first run may have to fill
  /// the cache of models. The second shows how long one takes.
  void run_whole(const std::vector<std::string>& command) {
    command_ = command;
    for (int run = 0; run < 2; ++run) {
      const Clock::time_point begin = Clock::now();
      const Outcome outcome = run_hitpipe(into(whole_));
      length_ = Clock::now() - begin;
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
  }

  [[nodiscard]] std::vector<std::string> into(const fs::path& folder) const {
    const std::vector<std::string> arguments = with(command_, {"--out", folder.string()});
    return arguments;
  }

  /// Each file in the folder under its final name is what the whole run wrote. Returns how many files there
  /// are.
  std::size_t expect_whole_files(const fs::path& folder, const std::string& moment) const {
    std::size_t files = 0;
    for (const std::string& file : files_below(folder)) {
      if (is_temporary(file)) continue;
      ++files;
      EXPECT_TRUE(contents_of(folder / file) == contents_of(whole_ / file))
          << file << " is not whole; killed " << moment;
    }
    return files;
  }

  /// Kills runs into one folder after more and more events of files with `word` in their name, in the
  /// subfolder `below`, until a run reaches its end.
  void kill_at_events(std::string_view word, std::size_t step, const fs::path& below = "") {
    const fs::path folder = folder_.path() / "events";
    fs::create_directories(folder / below);
    std::size_t killed = 0;
    const std::size_t last = 12 * step;
    int late = 0;  // on a busy machine a run can end before the kill
    for (std::size_t count = 1; count <= last; count += step) {
      const FolderEvents events(folder / below);
      const pid_t child = start_hitpipe(into(folder));
      events.wait_for(count, word, 4 * length_);
      if (!kill_and_wait(child)) {
        if (killed > 0 || ++late == 30) break;
        count -= step;
        continue;
      }
      ++killed;
      expect_whole_files(folder, fmt::format("after event {}", count));
    }
    fmt::print("{} runs killed at an event in their folder\n", killed);
    EXPECT_GE(killed, 1U);
    expect_next_run_whole(folder);
  }

  void kill_at_random_moments(unsigned seed, int runs) {
    const fs::path folder = folder_.path() / "moments";
    fs::create_directory(folder);
    std::mt19937 random(seed);
    int killed = 0;
    for (int run = 0; run < runs; ++run) {
      const auto moment = length_ * static_cast<int>(random() % 1000) / 1000;
      const pid_t child = start_hitpipe(into(folder));
      std::this_thread::sleep_for(moment);
      killed += kill_and_wait(child) ? 1 : 0;
      const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(moment).count();
      expect_whole_files(folder, fmt::format("after {} us", microseconds));
    }
    fmt::print("{} of {} runs killed at random moments of {} ms, seed {}\n", killed, runs,
               std::chrono::duration_cast<std::chrono::milliseconds>(length_).count(), seed);
    EXPECT_GE(killed, runs / 2);
    expect_next_run_whole(folder);
  }

  void expect_next_run_whole(const fs::path& folder) const {
    EXPECT_EQ(run_hitpipe(into(folder)).exit_code, 0);
    EXPECT_EQ(expect_whole_files(folder, "before"), files_below(whole_).size());
    EXPECT_EQ(files_below(folder), files_below(whole_)) << "a temporary file is left";
  }

 private:
  const sim::TemporaryFolder folder_;
  const fs::path whole_ = folder_.path() / "whole";
  std::vector<std::string> command_;
  Clock::duration length_{};
};

TEST_F(KilledRun, OfRtlLeavesOnlyWholeFiles) {
  ASSERT_NO_FATAL_FAILURE(run_whole({"rtl", "int_slabs"}));
  kill_at_events("int_slabs", 4);  // about as many as a file has
  kill_at_random_moments(1, 8);
}

TEST_F(KilledRun, OfCosimLeavesOnlyWholeFiles) {
  ASSERT_NO_FATAL_FAILURE(
      run_whole({"cosim", "int_slabs", "--scene", "spheres", "--width", "32", "--height", "32"}));
  kill_at_events("spheres", 1);
  kill_at_random_moments(2, 8);
}

TEST_F(KilledRun, OfFitLeavesOnlyWholeFiles) {
  ASSERT_NO_FATAL_FAILURE(
      run_whole({"fit", "--scene", "spheres", "--no-shadows", "--width", "8", "--height", "8", "int_slabs",
                 "--keep-bits", "--bits", "12/12", "--vectors", "1000"}));
  kill_at_events("int_slabs", 8, "int_slabs");
  kill_at_random_moments(6, 5);
}

}  // namespace
}  // namespace hitpipe::cli::killed_run_test
