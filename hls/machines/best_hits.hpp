// The best hit of each ray (docs/core.md): T and the number of the triangle, from the ray's beginning to its
// answer. Before the first hit T is the ray's length. A new ray comes in here and goes on to the walker. The
// divider compares hits with the best ones; a ray that is done with a leaf takes its length, which is the
// best T, back to the walker as a box distance.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {

/// The format "tTcCdDiI", for example t20c1d20i5.
///   T  bits of a distance;  C  low bits of it that a box distance has not;  D  bits of a box distance, at
///   least T - C;  I  bits of a ray's number
struct BestBits {
  int distance = 20;  ///< T
  int dropped = 1;    ///< C
  int box = 20;       ///< D
  int ray = 5;        ///< I

  static constexpr FormatField fields[] = {
      {"t", "T", 4, 36}, {"c", "C", 0, 11}, {"d", "D", 4, 36, "36"}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "D at least T-C, and C less than T";
  static constexpr const char* type = "BestFormat";

  constexpr int rays() const { return power_of_two(ray); }
  constexpr bool valid() const { return dropped < distance && box >= distance - dropped; }
  friend constexpr bool operator==(const BestBits& a, const BestBits& b) {
    return a.distance == b.distance && a.dropped == b.dropped && a.box == b.box && a.ray == b.ray;
  }
};
template <int Distance, int Dropped, int Box, int Ray>
struct BestFormat {
  static constexpr BestBits bits{Distance, Dropped, Box, Ray};
  static_assert(bits.valid(), "there is no such format tTcCdDiI");
  Width<Distance> distance{};
  Width<Dropped> dropped{};
  Width<Box> box{};
  Width<Ray> ray{};
  constexpr operator BestBits() const { return bits; }
};

namespace best_hits {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto number_of(const F& f) { return f.ray * 0_w + Width<triangle_number_bits>(); }
  static constexpr auto best_of(const F& f) { return f.distance + number_of(f); }

  using Ray = decltype(format.ray + 0_w);
  using Distance = decltype(format.distance + 0_w);
  using Box = decltype(format.box + 0_w);
  using Number = decltype(number_of(format));
};

template <class D, class F>
struct State {
  using bit = typename D::bit;
  using W = Widths<F>;

  // A new ray on its way to the walker.
  bit begins;
  Word<D, typename W::Ray> begun;
  Word<D, typename W::Distance> length;
  // What the divider has said.
  bit divided, closer;
  Word<D, typename W::Ray> divider;
  Word<D, typename W::Distance> t;
  // A ray whose best hit was asked for.
  bit leaf, stops, lost;
  Word<D, typename W::Ray> leaf_ray;
  bit answers, failed;
  Word<D, typename W::Ray> answered;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BestBits bits = format;
    visit(control_field("begins_1", 1), self.begins);
    visit(data_field("begun_1", bits.ray), self.begun);
    visit(data_field("length_1", bits.distance), self.length);
    visit(control_field("divided_1", 1), self.divided);
    visit(data_field("closer_1", 1), self.closer);
    visit(data_field("divider_1", bits.ray), self.divider);
    visit(data_field("t_1", bits.distance), self.t);
    visit(control_field("leaf_1", 1), self.leaf);
    visit(data_field("stops_1", 1), self.stops);
    visit(data_field("lost_1", 1), self.lost);
    visit(data_field("leaf_ray_1", bits.ray), self.leaf_ray);
    visit(control_field("answers_1", 1), self.answers);
    visit(data_field("failed_1", 1), self.failed);
    visit(data_field("answered_1", bits.ray), self.answered);
  }
};

template <class D, class F>
struct Inputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit begin;  ///< a new ray, where `takes` was 1
  Word<D, typename W::Ray> begun;
  Word<D, typename W::Distance> length;
  bit any;           ///< it wants any hit, else the nearest
  bit walker_takes;  ///< the walker takes a new ray in this cycle
  bit reads;         ///< a triangle has been read for a ray
  Word<D, typename W::Ray> reader;
  Word<D, typename W::Number> number;
  Word<D, typename W::Ray> asked;  ///< the divider's
  bit done, closer;
  Word<D, typename W::Distance> t;
  bit leaf;  ///< a ray is done with its leaf
  Word<D, typename W::Ray> leaf_ray;
  bit stops, lost;
  bit ended;  ///< a walk has ended
  Word<D, typename W::Ray> ender;
  bit failed;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BestBits bits = format;
    visit(data_field("new_ray", 1), self.begin);
    visit(data_field("begun", bits.ray), self.begun);
    visit(data_field("length", bits.distance), self.length);
    visit(data_field("any", 1), self.any);
    visit(data_field("walker_takes", 1), self.walker_takes);
    visit(data_field("reads", 1), self.reads);
    visit(data_field("read_ray", bits.ray), self.reader);
    visit(data_field("number", triangle_number_bits), self.number);
    visit(data_field("asked", bits.ray), self.asked);
    visit(data_field("done", 1), self.done);
    visit(data_field("closer", 1), self.closer);
    visit(data_field("t", bits.distance), self.t);
    visit(data_field("leaf", 1), self.leaf);
    visit(data_field("leaf_ray", bits.ray), self.leaf_ray);
    visit(data_field("stops", 1), self.stops);
    visit(data_field("lost", 1), self.lost);
    visit(data_field("ended", 1), self.ended);
    visit(data_field("ender", bits.ray), self.ender);
    visit(data_field("failed", 1), self.failed);
  }
};

template <class D, class F>
struct Outputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit takes;   ///< a new ray may begin in this cycle
  bit begins;  ///< to the walker
  Word<D, typename W::Ray> begun;
  Word<D, typename W::Box> cut;             ///< its length as a box distance
  Word<D, typename W::Number> number;       ///< to the divider, of the ray that it asked for
  Word<D, typename W::Distance> best;       ///< likewise
  Word<D, typename W::Number> best_number;  ///< likewise
  bit divided;                              ///< to the reader: a hit has been compared
  Word<D, typename W::Ray> divider;
  bit stops;
  bit leaf;  ///< to the walker: a ray is done with its leaf
  Word<D, typename W::Ray> leaf_ray;
  Word<D, typename W::Box> leaf_cut;
  bit leaf_stops, leaf_lost;
  bit answers;  ///< a ray's answer
  Word<D, typename W::Ray> answered;
  Word<D, typename W::Distance> answer_t;
  Word<D, typename W::Number> answer_number;  ///< all ones: no hit
  bit answer_failed;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BestBits bits = format;
    visit(data_field("takes", 1), self.takes);
    visit(data_field("begins", 1), self.begins);
    visit(data_field("begin_ray", bits.ray), self.begun);
    visit(data_field("begin_cut", bits.box), self.cut);
    visit(data_field("asked_number", triangle_number_bits), self.number);
    visit(data_field("best", bits.distance), self.best);
    visit(data_field("best_number", triangle_number_bits), self.best_number);
    visit(data_field("divided", 1), self.divided);
    visit(data_field("divided_ray", bits.ray), self.divider);
    visit(data_field("divided_stops", 1), self.stops);
    visit(data_field("leaf_done", 1), self.leaf);
    visit(data_field("leaf_done_ray", bits.ray), self.leaf_ray);
    visit(data_field("leaf_done_cut", bits.box), self.leaf_cut);
    visit(data_field("leaf_done_stops", 1), self.leaf_stops);
    visit(data_field("leaf_done_lost", 1), self.leaf_lost);
    visit(data_field("answers", 1), self.answers);
    visit(data_field("answered", bits.ray), self.answered);
    visit(data_field("answer_t", bits.distance), self.answer_t);
    visit(data_field("answer_number", triangle_number_bits), self.answer_number);
    visit(data_field("answer_failed", 1), self.answer_failed);
  }
};

/// By ray. The best hits are there three times, since three read them.
template <class Memory>
struct Memories {
  Memory numbers;  ///< of the triangle that is tested
  Memory kinds;    ///< 1: any hit
  Memory divided_bests, leaf_bests, answer_bests;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const BestBits bits = format;
    const auto memory = [&](const char* name, int width, Memory& of) {
      visit(MemoryShape{name, bits.rays(), width, MemoryKind::block}, of);
    };
    memory("numbers", triangle_number_bits, self.numbers);
    memory("kinds", 1, self.kinds);
    memory("divided_bests", Widths<BestBits>::best_of(bits), self.divided_bests);
    memory("leaf_bests", Widths<BestBits>::best_of(bits), self.leaf_bests);
    memory("answer_bests", Widths<BestBits>::best_of(bits), self.answer_bests);
  }
};

struct BestHits {
  static constexpr const char* name = "best_hits";
  static constexpr const char* summary = "the best hit of each ray, from its beginning to its answer";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = BestBits;
  using BuiltIn = FormatList<BestFormat<20, 1, 20, 5>, BestFormat<20, 1, 20, 7>>;
  template <class D, class F>
  using State = best_hits::State<D, F>;
  template <class D, class F>
  using Inputs = best_hits::Inputs<D, F>;
  template <class D, class F>
  using Outputs = best_hits::Outputs<D, F>;
  template <class Memory>
  using Memories = best_hits::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    const auto number_bits = Widths<F>::number_of(format);
    const auto best_bits = Widths<F>::best_of(format);
    const auto cut_of = [&](const auto& t) {
      return resize(slice(t, format.distance - 1_w, format.dropped), format.box);
    };
    const auto t_of = [&](const auto& best) { return slice(best, best_bits - 1_w, number_bits); };
    const auto number_of = [&](const auto& best) { return slice(best, number_bits - 1_w, 0_w); };
    const auto compared = memories.divided_bests.word(best_bits);
    const auto at_leaf = memories.leaf_bests.word(best_bits);
    const auto answer = memories.answer_bests.word(best_bits);

    Outputs<D, F> out;
    out.takes = takes<D>(state);
    out.begins = state.begins;
    out.begun = state.begun;
    out.cut = cut_of(state.length);
    out.number = memories.numbers.word(number_bits);
    out.best = t_of(compared);
    out.best_number = number_of(compared);
    out.divided = state.divided;
    out.divider = state.divider;
    out.stops = state.closer & typename D::bit(memories.kinds.word(1_w + format.ray * 0_w));
    out.leaf = state.leaf;
    out.leaf_ray = state.leaf_ray;
    out.leaf_cut = cut_of(t_of(at_leaf));
    out.leaf_stops = state.stops;
    out.leaf_lost = state.lost;
    out.answers = state.answers;
    out.answered = state.answered;
    out.answer_t = t_of(answer);
    out.answer_number = number_of(answer);
    out.answer_failed = state.failed;
    return out;
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto number_bits = Widths<F>::number_of(format);
    const Bit taken = takes<D>(state);
    const Bit begins = as("begins_ray", in.begin & taken);
    const Bit improves = as("improves", state.divided & state.closer);
    const Bit writes = as("writes_best", begins | improves);
    const auto place = as("best_place", select(begins, in.begun, state.divider));
    const auto best = as("best_written", select(begins, cat(in.length, D::lit(-1, number_bits)),
                                                cat(state.t, memories.numbers.word(number_bits))));
    memories.divided_bests.write(writes, place, best);
    memories.leaf_bests.write(writes, place, best);
    memories.answer_bests.write(writes, place, best);
    memories.kinds.write(begins, in.begun, in.any);
    memories.numbers.write(in.reads, in.reader, in.number);
    memories.divided_bests.ask(in.asked);
    memories.numbers.ask(in.asked);
    memories.kinds.ask(in.asked);
    memories.leaf_bests.ask(in.leaf_ray);
    memories.answer_bests.ask(in.ender);

    state.begun = select(begins, in.begun, state.begun);
    state.length = select(begins, in.length, state.length);
    state.begins = begins | (state.begins & ~in.walker_takes);
    state.divided = in.done;
    state.closer = in.closer;
    state.divider = in.asked;
    state.t = in.t;
    state.leaf = in.leaf;
    state.stops = in.stops;
    state.lost = in.lost;
    state.leaf_ray = in.leaf_ray;
    state.answers = in.ended;
    state.failed = in.failed;
    state.answered = in.ender;
  }

 private:
  /// A hit that the divider has compared is written in the next cycle, and then no ray begins.
  template <class D, class F>
  static constexpr typename D::bit takes(const State<D, F>& state) {
    return as("takes_ray", ~state.begins & ~state.divided);
  }
};

}  // namespace best_hits

using best_hits::BestHits;

}  // namespace hls
}  // namespace hitpipe
