// The time that one kind of work takes among others. The work is done millions of times, and each piece is
// about as short as one reading of a clock. One piece in 61 is timed, and the sum is scaled up. Before each
// timed piece an empty interval is timed and subtracted: it is the cost of reading the clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace hitpipe::sim {

/// The steady clock costs tens of nanoseconds. A thread's own clock costs hundreds, because it asks the
/// system. Tests use a clock of their own.
template <class Clock = std::chrono::steady_clock>
class SampledTime {
 public:
  template <class Work>
  void run(const Work& work) {
    ++pieces_;
    if (--until_timed_ > 0) {
      work();
      return;
    }
    until_timed_ = stride;
    const auto empty = Clock::now();
    const auto start = Clock::now();
    work();
    const auto stop = Clock::now();
    if (stop - empty > longest) return;
    timed_ += (stop - start) - (start - empty);
    ++timed_pieces_;
  }

  /// For all pieces. 0 when none was timed, which is so when there were fewer than `first`.
  [[nodiscard]] double seconds() const {
    if (timed_pieces_ == 0) return 0.0;
    const double each = std::chrono::duration<double>(timed_).count() / static_cast<double>(timed_pieces_);
    return each > 0.0 ? each * static_cast<double>(pieces_) : 0.0;
  }

 private:
  /// A prime, so that samples do not keep step with the number of rays in flight.
  static constexpr int stride = 61;
  /// The first pieces are slow because caches are cold.
  static constexpr int first = 8;
  /// A piece that takes longer was interrupted by another process and is not counted.
  static constexpr std::chrono::microseconds longest{50};

  int until_timed_ = first;
  std::uint64_t pieces_ = 0;
  std::uint64_t timed_pieces_ = 0;
  typename Clock::duration timed_{};
};

}  // namespace hitpipe::sim
