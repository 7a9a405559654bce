// Beats of a memory bus that has one identifier (docs/core.md): answers come in the order of the requests, a
// block in one or more beats. This machine remembers who asked, and gives the core whole blocks.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {

/// The format "dDiI", for example d64i5.
struct BeatBits {
  int data = 256;  ///< D: bits of a beat: 64, 128, 256, 512
  int ray = 5;     ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {{"d", "D", 64, 512}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "D a power of two";

  constexpr int rays() const { return power_of_two(ray); }
  constexpr int id() const { return ray + 1; }
  constexpr int words() const { return data / 64; }
  /// Of a block.
  constexpr int beats() const { return max(1, 256 / data); }
  constexpr bool several() const { return beats() > 1; }
  /// Of a number of beats.
  constexpr int count() const { return data == 64 ? 2 : 1; }
  /// A beat has two blocks. One of them is wanted.
  constexpr bool halves() const { return data == 512; }
  /// The identifier, and above it the half.
  constexpr int asker() const { return halves() ? id() + 1 : id(); }
  constexpr bool valid() const { return (data & (data - 1)) == 0; }
  friend constexpr bool operator==(const BeatBits&, const BeatBits&) = default;
};

namespace beats {

using namespace channels;

constexpr DataIf<"request_upper", 1, &BeatBits::halves> request_upper;  // the block is in the upper half
using Queue = IdQueue<>;                                                // who asked
constexpr ControlIf<"count", &BeatBits::count, &BeatBits::several>
    count;                             // beats of the oldest block that have come
constexpr Control<"there_1"> there_1;  // a whole block
struct WholeBlock : Join<List<read_id>, BlockWords> {};

constexpr Block<"askers", &BeatBits::rays, &BeatBits::asker> askers;  // the queue

struct Beats {
  static constexpr const char* name = "beats";
  static constexpr const char* summary = "makes blocks of a memory bus's beats, which come in order";
  using Bits = BeatBits;
  using BuiltIn = FormatList<Fixed<BeatBits{64, 5}>>;
  struct In : Join<List<request_valid, request_ready, request_id, request_upper>, Beat> {};
  struct Out : Join<Beat::Back, BlockRead> {};
  struct State : Join<Queue::State, List<count, there_1>, Held<WholeBlock>> {};
  struct Memory : List<askers> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
    out[beat_ready] = now[Queue::there];
    out[read_valid] = now[there_1];
    out.from_held(now, WholeBlock());
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const BeatBits bits = f;
    const auto halves = 0_w < number_in<&BeatBits::halves>(f);
    const Bit enters = as("enters", in[request_valid] & in[request_ready]);
    const auto asker =
        change_if(halves, in[request_id], [&](const auto& id) { return cat(in[request_upper], id); });
    memory[askers].write(enters, as("place", Queue::place(now)), asker);

    const Bit taken = as("taken", in[beat_valid] & now[Queue::there]);
    Bit last = taken;
    if (bits.several()) {
      last = taken & is<D>(now[count], bits.beats() - 1);
      next[count] = plus(now[count], taken);
    }
    next[there_1] = as("last_beat", last);
    memory[askers].ask(Queue::step<D>(now, next, enters, last));

    const auto asked = memory[askers].word();
    next[held<read_id>] = slice(asked, width_of(in[request_id]) - 1_w, 0_w);
    // The words of a beat come in above, and those of the beats before move down; or a half of them comes in.
    using Part = std::remove_cvref_t<decltype(in[beat_0])>;
    const Part words[] = {now[held<read_word_0>], now[held<read_word_1>], now[held<read_word_2>],
                          now[held<read_word_3>]};
    const Part came[] = {in[beat_0], in[beat_1], in[beat_2], in[beat_3],
                         in[beat_4], in[beat_5], in[beat_6], in[beat_7]};
    const auto part = [&](int k) -> Part {
      return either(
          halves, asked, [&](const auto& word) { return select(Bit(sign(word)), came[k + 4], came[k]); },
          [&](const auto&) {
            const int from = k + bits.words();
            return select(taken, from < 4 ? words[from] : came[from - 4], words[k]);
          });
    };
    Bit goes_on = D::lit(0, 1_w);
    if (bits.several()) goes_on = any<D>(now[count]);
    next[held<read_error>] =
        select(taken, Bit(in[beat_error] | (goes_on & now[held<read_error>])), now[held<read_error>]);
    next[held<read_word_0>] = part(0);
    next[held<read_word_1>] = part(1);
    next[held<read_word_2>] = part(2);
    next[held<read_word_3>] = part(3);
  }
};

}  // namespace beats

using beats::Beats;

}  // namespace hitpipe::hls
