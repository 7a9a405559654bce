// Progress on a terminal has a line of its own and leaves nothing behind; elsewhere it is a line now and
// then.
#include "cli/text/progress.hpp"

#include <chrono>
#include <cstdio>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/pseudo_terminal.hpp"

namespace hitpipe::cli::progress_test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* clear_line = "\r\x1b[K";

/// Redirects standard error to itself as long as it exists, so that what was written can be read.
class CapturedError {
 public:
  enum class Kind { terminal, pipe };
  explicit CapturedError(Kind kind) : before_(dup(STDERR_FILENO)) {
    int writing = -1;
    if (kind == Kind::terminal) {
      reading_ = posix_openpt(O_RDWR | O_NOCTTY);
      grantpt(reading_);
      unlockpt(reading_);
      writing = open(ptsname(reading_), O_RDWR | O_NOCTTY);
    } else {
      int ends[2];
      EXPECT_EQ(pipe(ends), 0);
      reading_ = ends[0];
      writing = ends[1];
    }
    fcntl(reading_, F_SETFL, O_NONBLOCK);
    std::fflush(stderr);
    dup2(writing, STDERR_FILENO);
    close(writing);
  }
  ~CapturedError() {
    dup2(before_, STDERR_FILENO);
    close(before_);
    close(reading_);
  }
  CapturedError(const CapturedError&) = delete;
  CapturedError& operator=(const CapturedError&) = delete;

  /// What was written since the last call.
  [[nodiscard]] std::string text() const {
    std::fflush(stderr);
    std::string text;
    char buffer[4096];
    for (ssize_t got = 0; (got = read(reading_, buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(got));
    return text;
  }

 private:
  int before_;
  int reading_ = -1;
};

constexpr Progress::Pace quick{.first_bar = 40ms, .bar = 20ms, .line = 40ms};

/// What is written from now on, up to the first text that contains `part`; all of it if that does not come in
/// minutes.
std::string text_until(const CapturedError& error, const std::string& part) {
  std::string text;
  for (int i = 0; i < 60'000 && text.find(part) == std::string::npos; ++i) {
    text += error.text();
    std::this_thread::sleep_for(10ms);
  }
  return text;
}

TEST(Progress, WritesALineNowAndThenWhereThereIsNoTerminal) {
  const CapturedError error(CapturedError::Kind::pipe);
  Progress progress("working", quick);
  EXPECT_THAT(text_until(error, "\n"), ContainsRegex("^hitpipe: working: [0-9]+ s\n"));
  progress.show(0.5);
  EXPECT_THAT(text_until(error, "left\n"),
              ContainsRegex("hitpipe: working: [0-9]+ s, 50 %, [0-9]+ s left\n"));
}

TEST(Progress, OfShortWorkIsSilentWhereThereIsNoTerminal) {
  const CapturedError error(CapturedError::Kind::pipe);
  {
    Progress progress("working", {.first_bar = 1h, .bar = 1h, .line = 1h});
    progress.show(0.5);
  }
  EXPECT_EQ(error.text(), "");
}

TEST(Progress, ShowsItsWorkThenABarAndLeavesAnEmptyLine) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const CapturedError error(CapturedError::Kind::terminal);
  {
    Progress progress("working", quick);
    EXPECT_THAT(error.text(), StartsWith("working ..."));
    EXPECT_THAT(text_until(error, " s"), ContainsRegex("\r.\\[Kworking \\.\\.\\. [0-9]+ s"));
    progress.show(0.5);
    EXPECT_THAT(text_until(error, "left"),
                ContainsRegex("\r.\\[Kworking \\[==========          \\]  50 %, [0-9]+ s left"));
    progress.show(0.4);
    progress.show(1.0);
    EXPECT_THAT(text_until(error, "100"),
                AllOf(HasSubstr("working [====================] 100 %, 0 s left"), Not(HasSubstr("40 %"))));
  }
  EXPECT_THAT(text_until(error, clear_line), EndsWith(clear_line));
}

TEST(DurationText, HasTheTwoLargestUnits) {
  EXPECT_EQ(duration_text(0s), "0 s");
  EXPECT_EQ(duration_text(59s), "59 s");
  EXPECT_EQ(duration_text(200s), "3 min 20 s");
  EXPECT_EQ(duration_text(7500s), "2 h 5 min");
}

}  // namespace
}  // namespace hitpipe::cli::progress_test
