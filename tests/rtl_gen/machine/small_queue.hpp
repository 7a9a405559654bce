// A machine for tests: a queue of rays' numbers with a place for each, in a lookup memory.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/memory.hpp"
#include "hls/world/core_format.hpp"
#include "rtl_gen/machine/machine_of.hpp"

namespace hitpipe::hls::small_queue {

constexpr Data<"push"> push;
constexpr Data<"pop"> pop;
constexpr Data<"ray", &CoreBits::ray> ray;
constexpr Data<"some"> some;
constexpr Data<"first", &CoreBits::ray> first;
constexpr Control<"used", ray_count_bits> used;
constexpr Control<"oldest", &CoreBits::ray, 1> oldest;
constexpr Lookup<"rays", &CoreBits::rays, &CoreBits::ray> rays;

struct SmallQueue {
  static constexpr const char* name = "small_queue";
  static constexpr const char* summary = "a queue for tests";
  using Bits = CoreBits;
  using BuiltIn = FormatList<Fixed<CoreBits{{8, 0, 8, 0, 0}, 3}>>;
  struct In : List<push, pop, ray> {};
  struct Out : List<some, first> {};
  struct State : List<used, oldest> {};
  struct Memory : List<rays> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[some] = any<D>(now[used]);
    out[first] = memory[rays].read(now[oldest]);
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    const auto place = as("place", plus(now[oldest], slice(now[used], width_of(now[oldest]) - 1_w, 0_w)));
    memory[rays].write(in[push], place, in[ray]);
    const typename D::bit taken = as("taken", any<D>(now[used]) & in[pop]);
    next[used] = minus(plus(now[used], in[push]), taken);
    next[oldest] = plus(now[oldest], taken);
  }
};

}  // namespace hitpipe::hls::small_queue

namespace hitpipe::rtl {

inline const hls::CoreBits small_queue_bits{{8, 0, 8, 0, 0}, 3};
inline Machine small_queue() {
  return machine_of<hls::small_queue::SmallQueue>();
}

}  // namespace hitpipe::rtl
