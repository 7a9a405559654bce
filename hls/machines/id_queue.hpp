// A queue of rays with a place for each. A ray is in one queue at a time, so the queue cannot overflow, and
// needs no sign that it is full. The words are in block memories of the machine. Those of the oldest ray are
// asked for all the time, and `there` says that the memories give them in this cycle.
#pragma once

#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// Registers. F is a format with the width `ray`.
template <class D, class F>
struct IdQueue {
  static constexpr F widths{};
  using Place = Word<D, decltype(widths.ray + 0_w)>;

  Word<D, decltype(widths.ray + 1_w)> used;  ///< rays in it
  Place oldest;                              ///< the place of the oldest of them
  typename D::bit there;                     ///< the memories give its words

  struct Names {
    const char *used, *oldest, *there;
  };
  template <class Self, class Visit>
  static constexpr void for_each(const Names& names, int ray, Self& self, Visit&& visit) {
    visit(control_field(names.used, ray + 1), self.used);
    visit(control_field(names.oldest, ray), self.oldest);
    visit(control_field(names.there, 1), self.there);
  }

  /// Where a word is written if one enters in this cycle.
  template <class W>
  [[nodiscard]] constexpr auto place(const W& ray) const {
    return resize(oldest + slice(used, ray - 1_w, 0_w), ray);
  }
  /// One cycle: the oldest leaves, and one enters. Only one that is there may leave. Gives the place whose
  /// words are to be asked for.
  template <class W>
  constexpr auto step(const W& ray, const typename D::bit& enters, const typename D::bit& leaves) {
    oldest = resize(oldest + leaves, ray);
    const auto rest = as_unsigned(resize(used - leaves, ray + 1_w));
    there = any<D>(rest);
    used = as_unsigned(resize(rest + enters, ray + 1_w));
    return oldest;
  }
};

}  // namespace hls
}  // namespace hitpipe
