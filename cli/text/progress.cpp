#include "cli/text/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace hitpipe::cli {

Progress::Progress(std::string what)
    : what_(std::move(what)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {
  if (terminal_) fmt::print(stderr, "{} ...", what_);
}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(double share) {
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  if (!terminal_ || elapsed < std::chrono::seconds(2)) return;
  const std::scoped_lock lock(drawing_);
  if (share < shown_) return;  // another thread has reported more
  shown_ = share;
  constexpr int width = 30;
  const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
  fmt::print(stderr, "\r\x1b[K{} [{:=<{}}{: <{}}] {:3.0f} %", what_, "", filled, "", width - filled,
             100 * share);
}

}  // namespace hitpipe::cli
