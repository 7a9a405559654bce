// The number of the present epoch of a core's bus. A hard reset may come while reads are on their way. What they give
// has the epoch before, and is dropped. So no reset sets it: each one counts it on.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/record.hpp"

namespace hitpipe::hls {

/// The format "eE", for example e2.
struct EpochBits {
  int epoch = 2;  ///< E: bits of the number. Few resets come while a read is on its way

  static constexpr FormatField fields[] = {{"e", "E", 1, 8}};
  friend constexpr bool operator==(const EpochBits&, const EpochBits&) = default;
};

namespace epoch {

constexpr Data<"resetting"> resetting;  // a hard reset
constexpr Data<"present", &EpochBits::epoch> present;
constexpr Counting<"epoch_r", &EpochBits::epoch> number_r;
constexpr Control<"was_resetting", 1, 1> was_resetting;  // in the cycle before

struct Epoch {
  static constexpr const char* name = "epoch";
  static constexpr const char* summary = "counts the hard resets of a core, so that old reads are known";
  using Bits = EpochBits;
  using BuiltIn = FormatList<Fixed<EpochBits{2}>>;
  struct In : List<resetting> {};
  struct Out : List<present> {};
  struct State : List<number_r, was_resetting> {};
  struct Memory : List<> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
    out[present] = now[number_r];
  }
  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& /*memory*/,
                             const auto& next) {
    const typename D::bit begins = as("begins", in[resetting] & ~now[was_resetting]);
    next[number_r] = plus(now[number_r], begins);
    next[was_resetting] = in[resetting];
  }
};

}  // namespace epoch

using epoch::Epoch;

}  // namespace hitpipe::hls
