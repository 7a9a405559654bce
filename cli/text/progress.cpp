#include "cli/text/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "host/talk.hpp"

namespace hitpipe::cli {

namespace {

std::chrono::seconds whole_seconds(std::chrono::steady_clock::duration elapsed) {
  return std::chrono::duration_cast<std::chrono::seconds>(elapsed);
}

}  // namespace

std::string duration_text(std::chrono::seconds duration) {
  const auto seconds = duration.count();
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{} min {} s", seconds / 60, seconds % 60);
  return fmt::format("{} h {} min", seconds / 3600, seconds % 3600 / 60);
}

Progress::Progress(std::string what, const Pace& pace)
    : what_(std::move(what)),
      pace_(pace),
      terminal_(isatty(STDERR_FILENO) != 0 && host::talk() == host::Talk::usual),
      start_(Clock::now()) {
  if (host::talk() == host::Talk::quiet) return;
  host::note_step(what_);
  if (terminal_) fmt::print(stderr, "{} ...", what_);
  writer_ = std::thread([this] { write_until_the_end(); });
}

Progress::~Progress() {
  {
    const std::scoped_lock lock(state_);
    ended_ = true;
  }
  end_.notify_one();
  if (writer_.joinable()) writer_.join();
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(double share) {
  const std::scoped_lock lock(state_);
  share_ = std::max(share_, share);  // another thread may have reported more
}

void Progress::write_until_the_end() {
  std::unique_lock lock(state_);
  auto next = start_ + (terminal_ ? pace_.first_bar : pace_.line);
  while (!end_.wait_until(lock, next, [this] { return ended_; })) {
    const auto elapsed = Clock::now() - start_;
    remaining_.add(elapsed, share_);
    if (terminal_) {
      write_bar(elapsed);
    } else {
      write_line(elapsed);
    }
    next += terminal_ ? pace_.bar : pace_.line;
  }
}

/// ", 3 min 20 s left". Empty when nobody knows.
std::string Progress::time_left() const {
  const std::optional<RemainingTime::Duration> left = remaining_.left();
  if (!left) return "";
  return fmt::format(", {} left", duration_text(std::chrono::ceil<std::chrono::seconds>(*left)));
}

void Progress::write_bar(Clock::duration elapsed) const {
  if (share_ <= 0) {
    fmt::print(stderr, "\r\x1b[K{} ... {}", what_, duration_text(whole_seconds(elapsed)));
    return;
  }
  constexpr int width = 20;
  const int filled = static_cast<int>(std::clamp(share_, 0.0, 1.0) * width);
  fmt::print(stderr, "\r\x1b[K{} [{:=<{}}{: <{}}] {:3.0f} %{}", what_, "", filled, "", width - filled,
             100 * share_, time_left());
}

void Progress::write_line(Clock::duration elapsed) const {
  const std::string share = share_ > 0 ? fmt::format(", {:.0f} %", 100 * share_) : "";
  fmt::print(stderr, "hitpipe: {}: {}{}{}\n", what_, duration_text(whole_seconds(elapsed)), share,
             time_left());
}

}  // namespace hitpipe::cli
