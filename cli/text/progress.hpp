// Shows on standard error what is being done, how much of it is finished and how long the rest takes. On a
// terminal that is one line, which disappears at the end. Elsewhere it is a line every ten seconds. A program that is
// quiet shows nothing, and one that is verbose has a line at the begin.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "cli/text/remaining_time.hpp"

namespace hitpipe::cli {

class Progress {
 public:
  /// How often it writes. The first bar on a terminal comes after `first_bar`.
  struct Pace {
    std::chrono::milliseconds first_bar{2000};
    std::chrono::milliseconds bar{500};
    std::chrono::milliseconds line{10'000};
  };

  /// On a terminal it shows `what` at once.
  explicit Progress(std::string what) : Progress(std::move(what), Pace{}) {}
  Progress(std::string what, const Pace& pace);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the finished share, 0..1. Any thread may call it. It is not called for work whose share is unknown.
  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;

  void write_until_the_end();
  [[nodiscard]] std::string time_left() const;
  void write_bar(Clock::duration elapsed) const;
  void write_line(Clock::duration elapsed) const;

  const std::string what_;
  const Pace pace_;
  const bool terminal_;
  const Clock::time_point start_;
  std::mutex state_;  // guards the members below up to ended_
  double share_ = 0;
  RemainingTime remaining_;
  bool ended_ = false;
  std::condition_variable end_;
  std::thread writer_;
};

/// "45 s", "3 min 20 s" or "2 h 5 min".
[[nodiscard]] std::string duration_text(std::chrono::seconds duration);

}  // namespace hitpipe::cli
