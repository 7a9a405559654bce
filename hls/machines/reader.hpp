// What rays read: records, and the triangles of leaves, one after the other (docs/core.md). The walker says
// where a ray goes; this machine asks memory for blocks. A ray has one block on its way at a time. When the
// test of a triangle has ended, the ray wants the leaf's next one, or it is done with the leaf.
//   goes     rays whose first block is to be asked for: a record, or the first triangle of a leaf
//   missed   rays whose triangle was not hit
//   divided  rays whose hit has been compared with the best one
// No block outside the image is asked for.
#pragma once

#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {

/// The format "aAiI", for example a24i5.
///   A  bits of a block's number;  I  bits of a ray's number
struct ReaderBits {
  int address = 24;  ///< A
  int ray = 5;       ///< I

  static constexpr FormatField fields[] = {{"a", "A", 4, 32}, {"i", "I", 1, 8}};
  static constexpr const char* type = "ReaderFormat";

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const ReaderBits& a, const ReaderBits& b) {
    return a.address == b.address && a.ray == b.ray;
  }
};
template <int Address, int Ray>
struct ReaderFormat {
  static constexpr ReaderBits bits{Address, Ray};
  Width<Address> address{};
  Width<Ray> ray{};
  constexpr operator ReaderBits() const { return bits; }
};

namespace reader {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto count_of(const F& f) { return f.ray * 0_w + Width<child_count_bits>(); }
  /// Of a word in `goes`: ray, outside, triangle, block.
  static constexpr auto go_of(const F& f) { return f.ray + f.address + 2_w; }
  /// Of a word in `leaves`: outside, triangles to come, the block of the next.
  static constexpr auto leaf_of(const F& f) { return f.address + count_of(f) + 1_w; }

  using Ray = decltype(format.ray + 0_w);
  using Address = decltype(format.address + 0_w);
  using Count = decltype(count_of(format));
  using Leaf = decltype(leaf_of(format));
};

template <class D, class F>
struct State {
  using bit = typename D::bit;
  using W = Widths<F>;

  IdQueue<D, F> goes, missed, divided;
  bit there_1, stops_1;  ///< a ray whose triangle has been tested
  bit settled_1;         ///< no word was to be written when the leaf's was asked for
  Word<D, typename W::Ray> ray_1;
  bit writes;  ///< what the leaf's word becomes, to be written
  Word<D, typename W::Ray> writer;
  Word<D, typename W::Leaf> leaf;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReaderBits bits = format;
    IdQueue<D, F>::for_each({"goes_used", "goes_oldest", "goes_there"}, bits.ray, self.goes, visit);
    IdQueue<D, F>::for_each({"missed_used", "missed_oldest", "missed_there"}, bits.ray, self.missed, visit);
    IdQueue<D, F>::for_each({"divided_used", "divided_oldest", "divided_there"}, bits.ray, self.divided,
                            visit);
    visit(control_field("there_1", 1), self.there_1);
    visit(data_field("stops_1", 1), self.stops_1);
    visit(data_field("settled_1", 1), self.settled_1);
    visit(data_field("ray_1", bits.ray), self.ray_1);
    visit(control_field("writes", 1), self.writes);
    visit(data_field("writer", bits.ray), self.writer);
    visit(data_field("leaf", Widths<ReaderBits>::leaf_of(bits)), self.leaf);
  }
};

template <class D, class F>
struct Inputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit go;  ///< the walker's `goes`
  Word<D, typename W::Ray> goer;
  Word<D, typename W::Address> block;
  Word<D, typename W::Count> triangles;  ///< all ones: a record
  bit tested, hit;                       ///< the test of a triangle has ended, with HIT or without
  Word<D, typename W::Ray> tester;
  bit divides;  ///< a hit has been compared
  Word<D, typename W::Ray> divider;
  bit stops;                          ///< and the ray wants nothing else
  bit granted;                        ///< memory takes what `asks` asks for
  Word<D, typename W::Address> last;  ///< the last block of the image; constant while rays are in flight

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReaderBits bits = format;
    visit(data_field("go", 1), self.go);
    visit(data_field("goer", bits.ray), self.goer);
    visit(data_field("block", bits.address), self.block);
    visit(data_field("triangles", child_count_bits), self.triangles);
    visit(data_field("tested", 1), self.tested);
    visit(data_field("hit", 1), self.hit);
    visit(data_field("tester", bits.ray), self.tester);
    visit(data_field("divides", 1), self.divides);
    visit(data_field("divided_ray", bits.ray), self.divider);
    visit(data_field("stops", 1), self.stops);
    visit(data_field("granted", 1), self.granted);
    visit(data_field("last", bits.address), self.last);
  }
};

template <class D, class F>
struct Outputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit asks;  ///< for a block
  Word<D, typename W::Address> wanted;
  Word<D, typename W::Ray> asker;
  bit triangle;  ///< it is one; else a record
  bit done;      ///< a ray is done with its leaf
  Word<D, typename W::Ray> doner;
  bit stopped;  ///< and wants nothing else
  bit lost;     ///< because a block that it wants is not in the image

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReaderBits bits = format;
    visit(data_field("asks", 1), self.asks);
    visit(data_field("wanted", bits.address), self.wanted);
    visit(data_field("asker", bits.ray), self.asker);
    visit(data_field("triangle", 1), self.triangle);
    visit(data_field("done", 1), self.done);
    visit(data_field("of", bits.ray), self.doner);
    visit(data_field("stopped", 1), self.stopped);
    visit(data_field("lost", 1), self.lost);
  }
};

template <class Memory>
struct Memories {
  Memory go_words, missed_rays, divided_rays;  ///< the queues
  Memory leaves;                               ///< by ray

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const ReaderBits bits = format;
    using W = Widths<ReaderBits>;
    const auto memory = [&](const char* name, int width, Memory& of) {
      visit(MemoryShape{name, bits.rays(), width, MemoryKind::block}, of);
    };
    memory("go_words", W::go_of(bits), self.go_words);
    memory("missed_rays", bits.ray, self.missed_rays);
    memory("divided_rays", bits.ray + 1, self.divided_rays);
    memory("leaves", W::leaf_of(bits), self.leaves);
  }
};

struct Reader {
  static constexpr const char* name = "reader";
  static constexpr const char* summary = "asks memory for records, and for a leaf's triangles in turn";
  static constexpr const char* header = __FILE__;
  using Bits = ReaderBits;
  using BuiltIn = FormatList<ReaderFormat<24, 5>, ReaderFormat<24, 7>>;
  template <class D, class F>
  using State = reader::State<D, F>;
  template <class D, class F>
  using Inputs = reader::Inputs<D, F>;
  template <class D, class F>
  using Outputs = reader::Outputs<D, F>;
  template <class Memory>
  using Memories = reader::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    const auto wants = Wants<D, F>::of(format, state, memories);
    Outputs<D, F> out;
    out.asks = wants.next | wants.go;
    out.wanted = select(wants.next, wants.next_block, wants.go_block);
    out.asker = select(wants.next, state.ray_1, wants.goer);
    out.triangle = wants.next | wants.go_triangle;
    const auto lost = wants.next_lost | wants.go_lost;
    out.done = wants.done | lost;
    out.doner = select(wants.go_lost, wants.goer, state.ray_1);
    out.stopped = state.stops_1 | lost;
    out.lost = lost;
    return out;
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    using W = Widths<F>;
    const auto i = format.ray;
    const auto a = format.address;
    const auto count_bits = W::count_of(format);
    const auto one = D::lit(1, 1_w);
    const auto wants = Wants<D, F>::of(format, state, memories);

    // Into the queues. A block is outside where its number is larger than the last one's.
    const Bit record = as("record", Bit(in.triangles == D::lit((1 << child_count_bits) - 1, count_bits)));
    memories.go_words.write(in.go, as("go_place", state.goes.place(i)),
                            cat(cat(in.goer, Bit(in.last < in.block)), cat(Bit(~record), in.block)));
    const Bit misses = as("misses", in.tested & ~in.hit);
    memories.missed_rays.write(misses, as("missed_place", state.missed.place(i)), in.tester);
    memories.divided_rays.write(in.divides, as("divided_place", state.divided.place(i)),
                                cat(in.divider, in.stops));

    // The word of a leaf is written where the ray goes to it, and behind each of its triangles. The first has
    // precedence, the other waits. A ray whose block is outside is lost, whatever its leaf's word says.
    const Bit begins = as("begins_leaf", in.go & ~record);
    const auto leaf_word = [&](const auto& block, const auto& count) {
      const Bit outside = Bit(block == in.last);
      return cat(cat(outside, as_unsigned(resize(count - one, count_bits))),
                 as_unsigned(resize(block + one, a)));
    };
    memories.leaves.write(Bit(begins | state.writes), select(begins, in.goer, state.writer),
                          select(begins, leaf_word(in.block, in.triangles), state.leaf));

    const Bit next_granted = as("next_granted", wants.next & in.granted);
    const Bit go_granted = as("go_granted", wants.go & in.granted);
    const Bit leaves_stage = as("leaves_stage", next_granted | wants.done | wants.next_lost);
    const Bit holds = as("holds", state.there_1 & ~leaves_stage);
    // The stage takes a ray when it is empty: few triangles are tested, and a shorter path is worth more.
    const Bit divided = as("takes_divided", state.divided.there & ~state.there_1);
    const Bit missed = as("takes_missed", state.missed.there & ~state.divided.there & ~state.there_1);
    const auto divided_word = memories.divided_rays.word(i + 1_w);
    const auto taken =
        as("taken", select(state.divided.there, slice(divided_word, i, 1_w), memories.missed_rays.word(i)));
    const auto ray = as("asked_leaf", select(state.there_1, state.ray_1, taken));
    memories.leaves.ask(ray);
    memories.go_words.ask(state.goes.step(i, in.go, Bit(go_granted | wants.go_lost)));
    memories.missed_rays.ask(state.missed.step(i, misses, missed));
    memories.divided_rays.ask(state.divided.step(i, in.divides, divided));
    state.stops_1 = select(state.there_1, state.stops_1, Bit(divided & Bit(bit_at(divided_word, 0_w))));
    state.there_1 = holds | divided | missed;
    state.settled_1 = ~state.writes;
    state.writer = select(next_granted, state.ray_1, state.writer);
    state.leaf = select(next_granted, leaf_word(wants.next_block, wants.to_come), state.leaf);
    state.writes = next_granted | (state.writes & begins);
    state.ray_1 = ray;
  }

 private:
  /// What the first of the rays want.
  template <class D, class F>
  struct Wants {
    using Bit = typename D::bit;
    using W = Widths<F>;

    Bit next, done, next_lost;  ///< the ray of stage 1: its leaf's next triangle, which may not be there
    Word<D, typename W::Address> next_block;
    Word<D, typename W::Count> to_come;
    Bit go, go_lost, go_triangle;  ///< the first of the queue `goes`
    Word<D, typename W::Address> go_block;
    Word<D, typename W::Ray> goer;

    template <class Memory>
    static constexpr Wants of(const F& format, const State<D, F>& state, Memories<Memory>& memories) {
      const auto i = format.ray;
      const auto a = format.address;
      const auto count_bits = W::count_of(format);
      Wants w;
      // Stage 1: the word of a leaf is there, unless one is to be written first.
      const auto leaf = memories.leaves.word(W::leaf_of(format));
      w.next_block = slice(leaf, a - 1_w, 0_w);
      w.to_come = slice(leaf, a + count_bits - 1_w, a);
      const Bit outside = bit_at(leaf, a + count_bits);
      const Bit knows = as("knows", state.there_1 & state.settled_1 & ~state.writes);
      w.done = as("leaf_done", knows & (state.stops_1 | ~any<D>(w.to_come)));
      w.next = as("wants_next", knows & ~w.done & ~outside);
      w.next_lost = as("next_lost", knows & ~w.done & outside);

      const auto word = memories.go_words.word(W::go_of(format));
      const Bit go_outside = bit_at(word, a + 1_w);
      w.go_block = slice(word, a - 1_w, 0_w);
      w.go_triangle = bit_at(word, a);
      w.goer = slice(word, a + i + 1_w, a + 2_w);
      w.go = as("wants_go", state.goes.there & ~go_outside & ~w.next);
      w.go_lost = as("go_lost", state.goes.there & go_outside & ~knows);
      return w;
    }
  };
};

}  // namespace reader

using reader::Reader;

}  // namespace hls
}  // namespace hitpipe
