// An image in a memory of the chip (docs/chips.md): one port of 64 bits reads blocks for a core, and takes
// the image's words from outside. A word from outside waits until a block that is being read is whole.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// The format "aAiI", for example a12i1.
///   A  bits of a block's number: the memory has 2^A blocks;  I  bits of a ray's number
struct SceneMemoryBits {
  int address = 12;  ///< A
  int ray = 1;       ///< I

  static constexpr FormatField fields[] = {{"a", "A", 4, 16}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "";
  static constexpr const char* type = "SceneMemoryFormat";

  constexpr int words() const { return 4 * power_of_two(address); }
  constexpr bool valid() const { return true; }
  friend constexpr bool operator==(const SceneMemoryBits& a, const SceneMemoryBits& b) {
    return a.address == b.address && a.ray == b.ray;
  }
};
template <int Address, int Ray>
struct SceneMemoryFormat {
  static constexpr SceneMemoryBits bits{Address, Ray};
  Width<Address> address{};
  Width<Ray> ray{};
  constexpr operator SceneMemoryBits() const { return bits; }
};

namespace scene_memory {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  using Id = decltype(format.ray + 1_w);
  using Bytes = decltype(format.address + 5_w);
  using Place = decltype(format.address + 2_w);
  using Count = decltype(format.ray * 0_w + 2_w);
  using Part = decltype(format.ray * 0_w + 64_w);
};

template <class D, class F>
struct State {
  using W = Widths<F>;

  Word<D, typename W::Count> count;  ///< words of the block that have been asked for
  typename D::bit there;             ///< a whole block; its last word is the memory's
  Word<D, typename W::Id> id;
  Word<D, typename W::Part> words[3];

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const SceneMemoryBits bits = format;
    visit(control_field("count", 2), self.count);
    visit(control_field("there_1", 1), self.there);
    visit(data_field("id_1", bits.ray + 1), self.id);
    constexpr const char* names[] = {"word_0_1", "word_1_1", "word_2_1"};
    for (int i = 0; i < 3; ++i) visit(data_field(names[i], 64), self.words[i]);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit asks;  ///< the core's request stays until it is taken
  Word<D, typename W::Bytes> bytes;
  Word<D, typename W::Id> asker;
  bit writes;  ///< a word of the image, which stays until it is taken
  Word<D, typename W::Place> place;
  Word<D, typename W::Part> written;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const SceneMemoryBits bits = format;
    visit(data_field("request_valid", 1), self.asks);
    visit(data_field("request_address", bits.address + 5), self.bytes);
    visit(data_field("request_id", bits.ray + 1), self.asker);
    visit(data_field("word_valid", 1), self.writes);
    visit(data_field("word_place", bits.address + 2), self.place);
    visit(data_field("word", 64), self.written);
  }
};

template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;
  using Part = Word<D, typename W::Part>;

  bit ready;       ///< takes the core's request
  bit word_ready;  ///< takes the word of the image
  bit there;       ///< a block, which the core takes at once
  Word<D, typename W::Id> id;
  Part words[4];

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const SceneMemoryBits bits = format;
    visit(data_field("request_ready", 1), self.ready);
    visit(data_field("word_ready", 1), self.word_ready);
    visit(data_field("read_valid", 1), self.there);
    visit(data_field("read_id", bits.ray + 1), self.id);
    constexpr const char* names[] = {"read_word_0", "read_word_1", "read_word_2", "read_word_3"};
    for (int i = 0; i < 4; ++i) visit(data_field(names[i], 64), self.words[i]);
  }
};

template <class Memory>
struct Memories {
  Memory blocks;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const SceneMemoryBits bits = format;
    visit(MemoryShape{"blocks", bits.words(), 64, MemoryKind::single}, self.blocks);
  }
};

struct SceneMemory {
  static constexpr const char* name = "scene_memory";
  static constexpr const char* summary = "reads blocks of an image that is in a memory of the chip";
  static constexpr const char* header = __FILE__;
  using Bits = SceneMemoryBits;
  using BuiltIn = FormatList<SceneMemoryFormat<12, 1>>;
  template <class D, class F>
  using State = scene_memory::State<D, F>;
  template <class D, class F>
  using Inputs = scene_memory::Inputs<D, F>;
  template <class D, class F>
  using Outputs = scene_memory::Outputs<D, F>;
  template <class Memory>
  using Memories = scene_memory::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto w = format.ray * 0_w;
    // The core holds its request while the words are read, so its address needs no register here.
    return {Bit(state.count == D::lit(3, w + 2_w)),
            Bit(state.count == D::lit(0, w + 2_w)),
            state.there,
            state.id,
            {state.words[0], state.words[1], state.words[2], memories.blocks.word(w + 64_w)}};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto w = format.ray * 0_w;
    const Bit free = as("free", Bit(state.count == D::lit(0, w + 2_w)));
    const Bit writes = as("writes", in.writes & free);
    const Bit reads = as("reads", in.asks & ~writes);
    const auto block = slice(in.bytes, format.address + 4_w, 5_w);
    const auto place = as("place", select(writes, in.place, cat(block, state.count)));
    const auto last_word = memories.blocks.word(w + 64_w);
    memories.blocks.access(writes, place, in.written);
    // The words of a block come in above, one after the other, and those before move down.
    state.words[0] = state.words[1];
    state.words[1] = state.words[2];
    state.words[2] = last_word;
    state.id = in.asker;
    state.there = as("last_word", reads & Bit(state.count == D::lit(3, w + 2_w)));
    state.count = as_unsigned(resize(state.count + reads, w + 2_w));
  }
};

}  // namespace scene_memory

using scene_memory::SceneMemory;

}  // namespace hls
}  // namespace hitpipe
