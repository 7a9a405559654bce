// Requests to memory, on their way out (docs/core.md). Two have room here, so a request can leave in every
// cycle although the reader is told a cycle before that one is granted.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "aAhHiI", for example a24h32i5.
struct RequestBits {
  int address = 24;  ///< A: bits of a block's number
  int bytes = 32;    ///< H: bits of an address, of bytes, at least A + 5
  int ray = 5;       ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {{"a", "A", 4, 32}, {"h", "H", 9, 64}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "H at least A+5";

  constexpr bool valid() const { return bytes >= address + 5; }
  friend constexpr bool operator==(const RequestBits&, const RequestBits&) = default;
};

namespace requests {

using namespace channels;

// Two requests; the first is asked for.
constexpr Control<"there_1"> there_1;
constexpr Data<"block_1", block_place_bits> block_1;
constexpr Data<"id_1", ray_count_bits> id_1;
constexpr Control<"there_2"> there_2;
constexpr Data<"block_2", block_place_bits> block_2;
constexpr Data<"id_2", ray_count_bits> id_2;

struct Requests {
  static constexpr const char* name = "requests";
  static constexpr const char* summary = "requests to memory, with their addresses";
  using Bits = RequestBits;
  using BuiltIn = FormatList<Fixed<RequestBits{24, 32, 5}>, Fixed<RequestBits{24, 32, 7}>>;
  struct In : Join<Asks, List<base>, Request::Back> {};
  struct Out : Join<Asks::Back, Request> {};
  struct State : List<there_1, block_1, id_1, there_2, block_2, id_2> {};
  struct Memory : List<> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
    out[granted] = ~now[there_2];
    out[request_valid] = now[there_1];
    out[request_address] = cat(now[block_1], D::lit(0, 5_w));
    out[request_id] = now[id_1];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& /*memory*/,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit second = now[there_2];
    const auto fresh_block = as("block", plus(cat(in[base], D::lit(0, 1_w)), in[asked_block]));
    // The request behind the first one.
    const Bit there = select(second, second, in[asks]);
    const auto block = select(second, now[block_2], fresh_block);
    const auto id = select(second, now[id_2], cat(in[triangle], in[asker]));
    const Bit holds = as("holds", now[there_1] & ~in[request_ready]);
    next[there_1] = select(holds, now[there_1], there);
    next[block_1] = select(holds, now[block_1], block);
    next[id_1] = select(holds, now[id_1], id);
    next[there_2] = as("waits", holds & there);
    next[block_2] = block;
    next[id_2] = id;
  }
};

}  // namespace requests

using requests::Requests;

}  // namespace hitpipe::hls
