// A machine for tests: a queue of rays' numbers with a place for each, in a lookup memory.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"
#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::hls::small_queue {

template <class D, class F>
struct State {
  static constexpr F widths{};
  Word<D, decltype(widths.ray + 1_w)> used;
  Word<D, decltype(widths.ray + 0_w)> oldest;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    visit(control_field("used", bits.ray + 1), self.used);
    visit(control_field("oldest", bits.ray, 1), self.oldest);
  }
};

template <class D, class F>
struct Inputs {
  static constexpr F widths{};
  typename D::bit push, pop;
  Word<D, decltype(widths.ray + 0_w)> ray;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    visit(data_field("push", 1), self.push);
    visit(data_field("pop", 1), self.pop);
    visit(data_field("ray", CoreBits(format).ray), self.ray);
  }
};

template <class D, class F>
struct Outputs {
  static constexpr F widths{};
  typename D::bit some;
  Word<D, decltype(widths.ray + 0_w)> first;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    visit(data_field("some", 1), self.some);
    visit(data_field("first", CoreBits(format).ray), self.first);
  }
};

template <class Memory>
struct Memories {
  Memory rays;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    visit(MemoryShape{"rays", bits.rays(), bits.ray, MemoryKind::lookup}, self.rays);
  }
};

struct SmallQueue {
  static constexpr const char* name = "small_queue";
  static constexpr const char* summary = "a queue for tests";
  using Bits = CoreBits;
  using BuiltIn = FormatList<CoreFormat<8, 0, 8, 0, 0, 3>>;
  template <class D, class F>
  using State = small_queue::State<D, F>;
  template <class D, class F>
  using Inputs = small_queue::Inputs<D, F>;
  template <class D, class F>
  using Outputs = small_queue::Outputs<D, F>;
  template <class Memory>
  using Memories = small_queue::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    return {any<D>(state.used), memories.rays.read(state.oldest, format.ray)};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto place =
        as("place", resize(state.oldest + slice(state.used, format.ray - 1_w, 0_w), format.ray));
    memories.rays.write(in.push, place, in.ray);
    const Bit taken = as("taken", any<D>(state.used) & in.pop);
    state.used = as_unsigned(resize(state.used + in.push - taken, format.ray + 1_w));
    state.oldest = resize(state.oldest + taken, format.ray);
  }
};

}  // namespace hitpipe::hls::small_queue

namespace hitpipe::rtl {

inline const hls::CoreBits small_queue_bits{{8, 0, 8, 0, 0}, 3};
inline Machine small_queue() {
  return machine_of<hls::small_queue::SmallQueue>();
}

}  // namespace hitpipe::rtl
