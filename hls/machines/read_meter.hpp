// How long memory takes (docs/machines.md): it watches the requests of a core and the blocks that come back,
// and adds up the cycles between them. No core needs it; it shows how a machine is written.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "iIcCnN", for example i5c16n40.
struct MeterBits {
  int ray = 5;       ///< I: bits of a ray's number; an identifier has one more
  int cycle = 16;    ///< C: bits of a number of cycles; no read may take 2^C or more
  int counter = 40;  ///< N: bits of a counter

  static constexpr FormatField fields[] = {{"i", "I", 1, 8}, {"c", "C", 1, 32}, {"n", "N", 1, 64}};

  constexpr int ids() const { return 2 * power_of_two(ray); }
  friend constexpr bool operator==(const MeterBits&, const MeterBits&) = default;
};

namespace read_meter {

using namespace channels;

constexpr Data<"reads", &MeterBits::counter> reads;    // blocks that have come
constexpr Data<"waited", &MeterBits::counter> waited;  // cycles that they took, added up
constexpr Data<"longest", &MeterBits::cycle> longest;  // the most that one of them took

constexpr Control<"now", &MeterBits::cycle> cycle_now;  // the number of this cycle
constexpr Control<"came"> came;                         // a block came in the last cycle
constexpr Control<"count", &MeterBits::counter> count;
constexpr Control<"sum", &MeterBits::counter> sum;
constexpr Control<"most", &MeterBits::cycle> most;

constexpr Block<"asked_at", &MeterBits::ids, &MeterBits::cycle> asked_at;  // by identifier

struct ReadMeter {
  static constexpr const char* name = "read_meter";
  static constexpr const char* summary = "counts the cycles that memory takes for its blocks";
  using Bits = MeterBits;
  using BuiltIn = FormatList<Fixed<MeterBits{5, 16, 40}>>;
  struct In : List<request_valid, request_ready, request_id, read_valid, read_id> {};
  struct Out : List<reads, waited, longest> {};
  struct State : List<cycle_now, came, count, sum, most> {};
  struct Memory : List<asked_at> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
    out[reads] = now[count];
    out[waited] = now[sum];
    out[longest] = now[most];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto later = plus(now[cycle_now], D::lit(1, 1_w));
    next[cycle_now] = later;

    // A request leaves: the memory keeps the cycle that follows. A block comes: that cycle is asked for.
    const Bit leaves = as("leaves", in[request_valid] & in[request_ready]);
    memory[asked_at].write(leaves, in[request_id], later);
    memory[asked_at].ask(in[read_id]);
    next[came] = in[read_valid];

    // One cycle later the memory gives it.
    const auto latency = as("latency", minus(now[cycle_now], memory[asked_at].word()));
    const Bit is_longer = as("is_longer", now[came] & Bit(now[most] < latency));
    next[count] = plus(now[count], now[came]);
    next[sum] = plus(now[sum], only(now[came], latency));
    next.where(is_longer)[most] = latency;
  }
};

}  // namespace read_meter

using read_meter::ReadMeter;

}  // namespace hitpipe::hls
