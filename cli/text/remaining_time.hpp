// How much longer work takes whose finished share is known from time to time.
#pragma once

#include <chrono>
#include <deque>
#include <optional>

namespace hitpipe::cli {

/// Later work may be slower than earlier work, as the larger rows of a sweep are. So only the last third of
/// the time counts.
class RemainingTime {
 public:
  using Duration = std::chrono::duration<double>;

  /// The share, 0..1, that is finished this long after the beginning. Neither falls from call to call.
  void add(Duration elapsed, double share);
  /// Nothing as long as nothing is finished, and when the last third of the time brought nothing.
  [[nodiscard]] std::optional<Duration> left() const;

 private:
  struct Sample {
    Duration elapsed;
    double share;
  };
  std::deque<Sample> samples_{{Duration{0}, 0.0}};  ///< the first is the last that is older than a third
};

}  // namespace hitpipe::cli
