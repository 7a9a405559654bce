// A queue of rays with a place for each. A ray is in one queue at a time, so the queue cannot overflow, and
// needs no sign that it is full. The words are in block memories of the machine. Those of the oldest ray are
// asked for all the time, and `there` says that the memories give them in this cycle.
#pragma once

#include "hls/machines/record.hpp"

namespace hitpipe::hls {

/// Bits of a ray's number, and of a number of rays.
inline constexpr auto ray_bits = [](const auto& format) { return format.ray; };
inline constexpr auto ray_count_bits = [](const auto& format) { return format.ray + 1; };

/// Registers whose names begin with the prefix. The format has `ray`, the bits of a ray's number.
template <Name Prefix = "">
struct IdQueue {
  static constexpr Control<Prefix + Name("used"), ray_count_bits> used{};
  static constexpr Control<Prefix + Name("oldest"), ray_bits> oldest{};
  static constexpr Control<Prefix + Name("there")> there{};
  using State = List<used, oldest, there>;

  /// Where a word is written if one enters in this cycle.
  static constexpr auto place(const auto& now) {
    return plus(now[oldest], slice(now[used], width_of(now[oldest]) - 1_w, 0_w));
  }
  /// One cycle: the oldest leaves, and one enters. Only one that is there may leave. Gives the place whose
  /// words are to be asked for.
  template <class D>
  static constexpr auto step(const auto& now, const auto& next, const auto& enters, const auto& leaves) {
    const auto first = plus(now[oldest], leaves);
    const auto rest = minus(now[used], leaves);
    next[oldest] = first;
    next[there] = any<D>(rest);
    next[used] = plus(rest, enters);
    return first;
  }
};

}  // namespace hitpipe::hls
