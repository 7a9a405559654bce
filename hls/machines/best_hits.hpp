// The best hit of each ray (docs/core.md): T and the number of the triangle, from the ray's beginning to its
// answer. Before the first hit T is the ray's length. A new ray comes in here and goes on to the walker. The
// divider compares hits with the best ones; a ray that is done with a leaf takes its length, which is the
// best T, back to the walker as a box distance.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/memory.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe::hls {

/// The format "tTcCdDiI", for example t20c1d20i5.
struct BestBits {
  int distance = 20;  ///< T: bits of a distance
  int dropped = 1;    ///< C: low bits of it that a box distance has not
  int box = 20;       ///< D: bits of a box distance, at least T - C
  int ray = 5;        ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {
      {"t", "T", 4, 36}, {"c", "C", 0, 11}, {"d", "D", 4, 36, "36"}, {"i", "I", 1, 8}};
  static constexpr const char* condition = "D at least T-C, and C less than T";

  constexpr int rays() const { return power_of_two(ray); }
  constexpr bool valid() const { return dropped < distance && box >= distance - dropped; }
  friend constexpr bool operator==(const BestBits&, const BestBits&) = default;
};

namespace best_hits {

constexpr Data<"new_ray"> new_ray;  // where `takes` was 1
constexpr Data<"begun", &BestBits::ray> begun;
constexpr Data<"length", &BestBits::distance> length;
constexpr Data<"any"> any_hit;                // it wants any hit, else the nearest
constexpr Data<"walker_takes"> walker_takes;  // the walker takes a new ray in this cycle
constexpr Data<"reads"> reads;                // a triangle has been read for a ray
constexpr Data<"read_ray", &BestBits::ray> read_ray;
constexpr Data<"number", triangle_number_bits> number;
constexpr Data<"asked", &BestBits::ray> asked;  // the divider's
constexpr Data<"done"> done;
constexpr Data<"closer"> closer;
constexpr Data<"t", &BestBits::distance> t;
constexpr Data<"leaf"> leaf;  // a ray is done with its leaf
constexpr Data<"leaf_ray", &BestBits::ray> leaf_ray;
constexpr Data<"stops"> stops;
constexpr Data<"lost"> lost;
constexpr Data<"ended"> ended;  // a walk has ended
constexpr Data<"ender", &BestBits::ray> ender;
constexpr Data<"failed"> failed;

constexpr Data<"takes"> takes;    // a new ray may begin in this cycle
constexpr Data<"begins"> begins;  // to the walker
constexpr Data<"begin_ray", &BestBits::ray> begin_ray;
constexpr Data<"begin_cut", &BestBits::box> begin_cut;  // its length as a box distance
constexpr Data<"asked_number", triangle_number_bits>
    asked_number;                                  // to the divider, of the ray that it asked for
constexpr Data<"best", &BestBits::distance> best;  // likewise
constexpr Data<"best_number", triangle_number_bits> best_number;  // likewise
constexpr Data<"divided"> divided;                                // to the reader: a hit has been compared
constexpr Data<"divided_ray", &BestBits::ray> divided_ray;
constexpr Data<"divided_stops"> divided_stops;
constexpr Data<"leaf_done"> leaf_done;  // to the walker: a ray is done with its leaf
constexpr Data<"leaf_done_ray", &BestBits::ray> leaf_done_ray;
constexpr Data<"leaf_done_cut", &BestBits::box> leaf_done_cut;
constexpr Data<"leaf_done_stops"> leaf_done_stops;
constexpr Data<"leaf_done_lost"> leaf_done_lost;
constexpr Data<"answers"> answers;  // a ray's answer
constexpr Data<"answered", &BestBits::ray> answered;
constexpr Data<"answer_t", &BestBits::distance> answer_t;
constexpr Data<"answer_number", triangle_number_bits> answer_number;  // all ones: no hit
constexpr Data<"answer_failed"> answer_failed;

constexpr Control<"begins_1"> begins_1;  // a new ray on its way to the walker
constexpr Data<"begun_1", &BestBits::ray> begun_1;
constexpr Data<"length_1", &BestBits::distance> length_1;
constexpr Control<"divided_1"> divided_1;  // what the divider has said
constexpr Data<"closer_1"> closer_1;
constexpr Data<"divider_1", &BestBits::ray> divider_1;
constexpr Data<"t_1", &BestBits::distance> t_1;
constexpr Control<"leaf_1"> leaf_1;  // a ray whose best hit was asked for
constexpr Data<"stops_1"> stops_1;
constexpr Data<"lost_1"> lost_1;
constexpr Data<"leaf_ray_1", &BestBits::ray> leaf_ray_1;
constexpr Control<"answers_1"> answers_1;
constexpr Data<"failed_1"> failed_1;
constexpr Data<"answered_1", &BestBits::ray> answered_1;

// By ray. The best hits are there three times, since three read them.
struct Best : List<best, best_number> {};
constexpr Block<"numbers", &BestBits::rays, triangle_number_bits> numbers;  // of the triangle that is tested
constexpr Block<"kinds", &BestBits::rays, 1> kinds;                         // 1: any hit
constexpr BlockOf<"divided_bests", &BestBits::rays, Best> divided_bests;
constexpr BlockOf<"leaf_bests", &BestBits::rays, Best> leaf_bests;
constexpr BlockOf<"answer_bests", &BestBits::rays, Best> answer_bests;

struct BestHits {
  static constexpr const char* name = "best_hits";
  static constexpr const char* summary = "the best hit of each ray, from its beginning to its answer";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = BestBits;
  using BuiltIn = FormatList<Fixed<BestBits{20, 1, 20, 5}>, Fixed<BestBits{20, 1, 20, 7}>>;
  struct In : List<new_ray, begun, length, any_hit, walker_takes, reads, read_ray, number, asked, done,
                   closer, t, leaf, leaf_ray, stops, lost, ended, ender, failed> {};
  struct Out : List<takes, begins, begin_ray, begin_cut, asked_number, best, best_number, divided,
                    divided_ray, divided_stops, leaf_done, leaf_done_ray, leaf_done_cut, leaf_done_stops,
                    leaf_done_lost, answers, answered, answer_t, answer_number, answer_failed> {};
  struct State : List<begins_1, begun_1, length_1, divided_1, closer_1, divider_1, t_1, leaf_1, stops_1,
                      lost_1, leaf_ray_1, answers_1, failed_1, answered_1> {};
  struct Memory : List<numbers, kinds, divided_bests, leaf_bests, answer_bests> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    const auto cut_of = [&](const auto& distance) {
      const auto kept = slice(distance, width_of(distance) - 1_w, number_in<&BestBits::dropped>(f));
      return resize(kept, begin_cut.width(f));
    };
    const auto compared = memory[divided_bests].word();
    const auto at_leaf = memory[leaf_bests].word();
    const auto answer = memory[answer_bests].word();
    out[takes] = may_begin(now);
    out[begins] = now[begins_1];
    out[begin_ray] = now[begun_1];
    out[begin_cut] = cut_of(now[length_1]);
    out[asked_number] = memory[numbers].word();
    out[best] = compared[best];
    out[best_number] = compared[best_number];
    out[divided] = now[divided_1];
    out[divided_ray] = now[divider_1];
    out[divided_stops] = now[closer_1] & typename D::bit(memory[kinds].word());
    out[leaf_done] = now[leaf_1];
    out[leaf_done_ray] = now[leaf_ray_1];
    out[leaf_done_cut] = cut_of(at_leaf[best]);
    out[leaf_done_stops] = now[stops_1];
    out[leaf_done_lost] = now[lost_1];
    out[answers] = now[answers_1];
    out[answered] = now[answered_1];
    out[answer_t] = answer[best];
    out[answer_number] = answer[best_number];
    out[answer_failed] = now[failed_1];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit new_one = as("begins_ray", in[new_ray] & may_begin(now));
    const Bit improves = as("improves", now[divided_1] & now[closer_1]);
    const Bit writes = as("writes_best", new_one | improves);
    const auto place = as("best_place", select(new_one, in[begun], now[divider_1]));
    const auto no_triangle = D::lit(-1, width_of(in[number]));
    const auto tested = memory[numbers].word();
    const auto word =
        as("best_written", select(new_one, cat(in[length], no_triangle), cat(now[t_1], tested)));
    memory[divided_bests].write(writes, place, word);
    memory[leaf_bests].write(writes, place, word);
    memory[answer_bests].write(writes, place, word);
    memory[kinds].write(new_one, in[begun], in[any_hit]);
    memory[numbers].write(in[reads], in[read_ray], in[number]);
    memory[divided_bests].ask(in[asked]);
    memory[numbers].ask(in[asked]);
    memory[kinds].ask(in[asked]);
    memory[leaf_bests].ask(in[leaf_ray]);
    memory[answer_bests].ask(in[ender]);

    next.where(new_one)[begun_1] = in[begun];
    next.where(new_one)[length_1] = in[length];
    next[begins_1] = new_one | (now[begins_1] & ~in[walker_takes]);
    next[divided_1] = in[done];
    next[closer_1] = in[closer];
    next[divider_1] = in[asked];
    next[t_1] = in[t];
    next[leaf_1] = in[leaf];
    next[stops_1] = in[stops];
    next[lost_1] = in[lost];
    next[leaf_ray_1] = in[leaf_ray];
    next[answers_1] = in[ended];
    next[failed_1] = in[failed];
    next[answered_1] = in[ender];
  }

 private:
  /// A hit that the divider has compared is written in the next cycle, and then no ray begins.
  static constexpr auto may_begin(const auto& now) {
    return as("takes_ray", ~now[begins_1] & ~now[divided_1]);
  }
};

}  // namespace best_hits

using best_hits::BestHits;

}  // namespace hitpipe::hls
