// Beats of a memory bus that has one identifier (docs/core.md): answers come in the order of the requests, a
// block in one or more beats. This machine remembers who asked, and gives the core whole blocks.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// The format "dDiI", for example d64i5.
///   D  bits of a beat: 64, 128, 256, 512;  I  bits of a ray's number
struct BeatBits {
  int data = 256;  ///< D
  int ray = 5;     ///< I

  static constexpr FormatField fields[] = {{"d", "D", 64, 512}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "D a power of two";
  static constexpr const char* type = "BeatFormat";

  constexpr int rays() const { return power_of_two(ray); }
  constexpr int words() const { return data / 64; }
  /// Of a block; a beat of 512 bits has one half of its words.
  constexpr int beats() const { return max(1, 256 / data); }
  /// Of a number of beats.
  constexpr int count() const { return data == 64 ? 2 : 1; }
  constexpr bool valid() const { return (data & (data - 1)) == 0; }
  friend constexpr bool operator==(const BeatBits& a, const BeatBits& b) {
    return a.data == b.data && a.ray == b.ray;
  }
};
template <int Data, int Ray>
struct BeatFormat {
  static constexpr BeatBits bits{Data, Ray};
  static_assert(bits.valid(), "there is no such format dDiI");
  Width<Ray> ray{};
  constexpr Width<bits.count()> count() const { return {}; }
  constexpr operator BeatBits() const { return bits; }
};

namespace beats {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  using Id = decltype(format.ray + 1_w);
  using Count = decltype(format.count());
  using Part = decltype(format.ray * 0_w + 64_w);
};

template <class D, class F>
struct State {
  using bit = typename D::bit;
  using Part = Word<D, typename Widths<F>::Part>;

  IdQueue<D, F> queue;                       ///< who asked
  Word<D, typename Widths<F>::Count> count;  ///< beats of the oldest block that have come
  bit there;                                 ///< a whole block
  Word<D, typename Widths<F>::Id> id;
  Part words[4];

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BeatBits bits = format;
    IdQueue<D, F>::for_each({"used", "oldest", "there"}, bits.ray, self.queue, visit);
    if (bits.beats() > 1) visit(control_field("count", bits.count()), self.count);
    visit(control_field("there_1", 1), self.there);
    visit(data_field("id_1", bits.ray + 1), self.id);
    constexpr const char* names[] = {"word_0_1", "word_1_1", "word_2_1", "word_3_1"};
    for (int i = 0; i < 4; ++i) visit(data_field(names[i], 64), self.words[i]);
  }
};

template <class D, class F>
struct Inputs {
  using bit = typename D::bit;
  using Part = Word<D, typename Widths<F>::Part>;

  bit asks, granted;  ///< both are 1: a block is asked for
  Word<D, typename Widths<F>::Id> asker;
  bit upper;  ///< the block is in the upper half of a beat of 512 bits
  bit valid;  ///< a beat; it is taken if `beat_ready` is 1
  Part words[8];

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BeatBits bits = format;
    visit(data_field("request_valid", 1), self.asks);
    visit(data_field("request_ready", 1), self.granted);
    visit(data_field("request_id", bits.ray + 1), self.asker);
    if (bits.data == 512) visit(data_field("request_upper", 1), self.upper);
    visit(data_field("beat_valid", 1), self.valid);
    constexpr const char* names[] = {"beat_0", "beat_1", "beat_2", "beat_3",
                                     "beat_4", "beat_5", "beat_6", "beat_7"};
    for (int i = 0; i < bits.words(); ++i) visit(data_field(names[i], 64), self.words[i]);
  }
};

template <class D, class F>
struct Outputs {
  using bit = typename D::bit;
  using Part = Word<D, typename Widths<F>::Part>;

  bit ready;
  bit there;  ///< a block, which the core takes at once
  Word<D, typename Widths<F>::Id> id;
  Part words[4];

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BeatBits bits = format;
    visit(data_field("beat_ready", 1), self.ready);
    visit(data_field("read_valid", 1), self.there);
    visit(data_field("read_id", bits.ray + 1), self.id);
    constexpr const char* names[] = {"read_word_0", "read_word_1", "read_word_2", "read_word_3"};
    for (int i = 0; i < 4; ++i) visit(data_field(names[i], 64), self.words[i]);
  }
};

template <class Memory>
struct Memories {
  Memory askers;  ///< the queue

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BeatBits bits = format;
    visit(MemoryShape{"askers", bits.rays(), asker_bits(bits), MemoryKind::block}, self.askers);
  }
  /// The identifier, and above it the half.
  static constexpr int asker_bits(const BeatBits& bits) { return bits.ray + (bits.data == 512 ? 2 : 1); }
};

struct Beats {
  static constexpr const char* name = "beats";
  static constexpr const char* summary = "makes blocks of a memory bus's beats, which come in order";
  static constexpr const char* header = __FILE__;
  using Bits = BeatBits;
  using BuiltIn = FormatList<BeatFormat<64, 5>>;
  template <class D, class F>
  using State = beats::State<D, F>;
  template <class D, class F>
  using Inputs = beats::Inputs<D, F>;
  template <class D, class F>
  using Outputs = beats::Outputs<D, F>;
  template <class Memory>
  using Memories = beats::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& /*format*/, const State<D, F>& state, Memories<Memory>&) {
    return {state.queue.there,
            state.there,
            state.id,
            {state.words[0], state.words[1], state.words[2], state.words[3]}};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const BeatBits bits = format;
    const auto i = format.ray;
    const Bit enters = as("enters", in.asks & in.granted);
    const auto place = as("place", state.queue.place(i));
    const Bit taken = as("taken", in.valid & state.queue.there);
    Bit last = taken;
    if (bits.data == 512) {
      memories.askers.write(enters, place, cat(in.upper, in.asker));
      const auto word = memories.askers.word(i + 2_w);
      for (int k = 0; k < 4; ++k)
        state.words[k] = select(Bit(bit_at(word, i + 1_w)), in.words[k + 4], in.words[k]);
      state.id = slice(word, i, 0_w);
    } else {
      memories.askers.write(enters, place, in.asker);
      state.id = memories.askers.word(i + 1_w);
      // The words of a beat come in above, and those of the beats before move down.
      for (int k = 0; k < 4; ++k) {
        const int from = k + bits.words();
        state.words[k] = select(taken, from < 4 ? state.words[from] : in.words[from - 4], state.words[k]);
      }
    }
    if (bits.beats() > 1) {
      last = taken & Bit(state.count == D::lit(bits.beats() - 1, format.count()));
      state.count = as_unsigned(resize(state.count + taken, format.count()));
    }
    state.there = as("last_beat", last);
    memories.askers.ask(state.queue.step(i, enters, last));
  }
};

}  // namespace beats

using beats::Beats;

}  // namespace hls
}  // namespace hitpipe
