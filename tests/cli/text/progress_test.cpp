// Progress is shown only on a terminal, in its own line, and leaves nothing behind.
#include "cli/text/progress.hpp"

#include <chrono>
#include <cstdio>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

namespace hitpipe::cli {
namespace {

using testing::HasSubstr;

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

TEST(Progress, IsSilentWhereThereIsNoTerminal) {
  const CapturedError error(CapturedError::Kind::pipe);
  {
    Progress progress("working");
    std::this_thread::sleep_for(std::chrono::milliseconds(2050));
    progress.show(0.5);
  }
  EXPECT_EQ(error.text(), "");
}

TEST(Progress, ShowsItsWorkThenABarAndLeavesAnEmptyLine) {
  const CapturedError error(CapturedError::Kind::terminal);
  {
    Progress progress("working");
    EXPECT_EQ(error.text(), "working ...");
    progress.show(0.1);
    EXPECT_EQ(error.text(), "") << "two seconds are not over";
    std::this_thread::sleep_for(std::chrono::milliseconds(2050));
    progress.show(0.5);
    EXPECT_EQ(error.text(), clear_line + std::string("working [===============               ]  50 %"));
    progress.show(0.4);
    EXPECT_EQ(error.text(), "") << "it went back";
    progress.show(1.0);
    EXPECT_EQ(error.text(), clear_line + std::string("working [==============================] 100 %"));
  }
  EXPECT_EQ(error.text(), clear_line);
}

}  // namespace
}  // namespace hitpipe::cli
