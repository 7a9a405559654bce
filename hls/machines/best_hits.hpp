// The best hit of each ray (docs/core.md): T and the number of the triangle, from the ray's beginning to its
// answer. Before the first hit T is the ray's length. A new ray comes in here and goes on to the walker. The
// divider compares hits with the best ones; a ray that is done with a leaf takes its length, which is the
// best T, back to the walker as a box distance.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {

/// The format "tTcCdDiI", for example t20c1d20i5, or "tTcCdDiIqQuU".
struct BestBits {
  int distance = 20;                  ///< T: bits of a distance
  int dropped = 1;                    ///< C: low bits of it that a box distance has not
  int box = 20;                       ///< D: bits of a box distance, at least T - C
  int ray = 5;                        ///< I: bits of a ray's number
  int questions = 0;                  ///< Q: rays may want crossings
  int number = triangle_number_bits;  ///< U: bits of a triangle's number; not written: those of an image

  static constexpr FormatField fields[] = {{"t", "T", 4, 36},
                                           {"c", "C", 0, 11},
                                           {"d", "D", 4, 36, "36"},
                                           {"i", "I", 1, 8},
                                           {"q", "Q", 1, 1, nullptr, true},
                                           {"u", "U", 4, triangle_number_bits, nullptr, true}};
  static constexpr const char* condition = "D at least T-C, and C less than T";

  constexpr int rays() const { return power_of_two(ray); }
  /// Of the T of an answer. A sum of sides is within the count of crossings, of a triangle's number.
  constexpr int answer_width() const { return questions == 0 ? distance : max(distance, number + 1); }
  constexpr bool valid() const { return dropped < distance && box >= distance - dropped; }
  friend constexpr bool operator==(const BestBits&, const BestBits&) = default;
};

namespace best_hits {

using namespace channels;

constexpr Control<"begins_1"> begins_1;    // a new ray on its way to the walker
constexpr Control<"divided_1"> divided_1;  // what the divider has said
constexpr Data<"divider_1", ray_bits> divider_1;
constexpr Control<"leaf_1"> leaf_1;  // a ray whose best hit was asked for
constexpr Control<"answers_1"> answers_1;
struct New : List<begun, length> {};
struct Leaf : List<leaf_ray, leaf_stops, leaf_lost> {};
struct End : List<walk_ray, failed> {};

// By ray. The best hits are there three times, since three read them.
struct Best : List<best, best_number> {};
struct Answered : List<answer_t, best_number> {};
constexpr Block<"numbers", &BestBits::rays, number_bits> numbers;  // of the triangle that is tested
constexpr Block<"kinds", &BestBits::rays, 1> kinds;                // 1: any hit
constexpr BlockOf<"divided_bests", &BestBits::rays, Answered> divided_bests;
constexpr BlockOf<"leaf_bests", &BestBits::rays, Best> leaf_bests;
constexpr BlockOf<"answer_bests", &BestBits::rays, Answered> answer_bests;
// Of rays that want crossings. What one has counted is in place of its best hit: the sum of sides as T, in two's
// complement, and the crossings as the number. Its length, in leaf_bests, stays.
constexpr DataIf<"hit_back_1", 1, has_questions> hit_back_1;
struct Question : List<counts, turned> {};
struct From : List<from_t, from_number> {};
constexpr BlockOfIf<"questions", &BestBits::rays, Question, has_questions> questions;
constexpr BlockOfIf<"froms", &BestBits::rays, From, has_questions> froms;

struct BestHits {
  static constexpr const char* name = "best_hits";
  static constexpr const char* summary = "the best hit of each ray, from its beginning to its answer";
  using Bits = BestBits;
  using BuiltIn = FormatList<Fixed<BestBits{20, 1, 20, 5}>, Fixed<BestBits{20, 1, 20, 7}>>;
  struct In : Join<NewRay, Starts::Back, TriangleRead, Divides, Compares, LeafDone, Ended> {};
  struct Out : Join<NewRay::Back, Starts, Divides::Back, Compares::Back, Divided, Returns, Answers> {};
  struct State : Join<List<begins_1>, Held<New>, List<divided_1, held<closer>, divider_1, held<t>, leaf_1>,
                      Held<Leaf>, List<answers_1>, Held<End>, List<hit_back_1>> {};
  struct Memory : List<numbers, kinds, divided_bests, leaf_bests, answer_bests, questions, froms> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    const auto cut_of = [&](const auto& distance) {
      const auto kept = slice(distance, width_of(distance) - 1_w, number_in<&BestBits::dropped>(f));
      return resize(kept, start_cut.width(f));
    };
    const auto compared = memory[divided_bests].word();
    const auto at_leaf = memory[leaf_bests].word();
    const auto answer = memory[answer_bests].word();
    out[takes] = may_begin(now);
    out[starts] = now[begins_1];
    out[start_ray] = now[held<begun>];
    out[start_cut] = cut_of(now[held<length>]);
    out[asked_number] = memory[numbers].word();
    out[best] = slice(compared[answer_t], number_in<distance_bits>(f) - 1_w, 0_w);
    out[best_number] = compared[best_number];
    if (has_questions(BestBits(f))) {
      out[asked_counts] = memory[questions].word()[counts];
      out[asked_from_t] = memory[froms].word()[from_t];
      out[asked_from_number] = memory[froms].word()[from_number];
    }
    out[divided] = now[divided_1];
    out[divided_ray] = now[divider_1];
    out[divided_stops] = now[held<closer>] & typename D::bit(memory[kinds].word());
    out[returns] = now[leaf_1];
    out[return_ray] = now[held<leaf_ray>];
    out[return_cut] = cut_of(at_leaf[best]);
    out[return_stops] = now[held<leaf_stops>];
    out[return_lost] = now[held<leaf_lost>];
    out[answers] = now[answers_1];
    out[answered] = now[held<walk_ray>];
    out[answer_t] = answer[answer_t];
    out[answer_number] = answer[best_number];
    out[answer_failed] = now[held<failed>];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit new_one = as("begins_ray", in[new_ray] & may_begin(now));
    const Bit improves = as("improves", now[divided_1] & now[held<closer>]);
    const Bit writes = as("writes_best", new_one | improves);
    const auto place = as("best_place", select(new_one, in[begun], now[divider_1]));
    const auto no_triangle = D::lit(-1, width_of(in[number]));
    const auto tested = memory[numbers].word();
    const auto word =
        as("best_written", select(new_one, cat(in[length], no_triangle), cat(now[held<t>], tested)));
    const bool has_counts = has_questions(BestBits(f));
    const auto found = change_if(has_counts, word, [&](const auto& pair) {
      const auto number_width = width_of(in[number]);
      const auto best_t = slice(pair, width_of(pair) - 1_w, number_width);
      const auto best_one = cat(resize(best_t, answer_t.width(f)), slice(pair, number_width - 1_w, 0_w));
      const auto question = memory[questions].word();
      const auto so_far = memory[divided_bests].word();
      const Bit down = as("side_is_down", ~(now[hit_back_1] ^ Bit(question[turned])));
      const auto side = cat(spread(down, answer_t.width(f) - 1_w), D::lit(1, 1_w));
      const auto tally = cat(plus(so_far[answer_t], side), plus(so_far[best_number], D::lit(1, 1_w)));
      const Bit counts_more = as("counts_more", ~new_one & Bit(question[counts]));
      return as("found", select(counts_more, tally, only(Bit(~(new_one & in[counts])), best_one)));
    });
    memory[divided_bests].write(writes, place, found);
    memory[answer_bests].write(writes, place, found);
    if (has_counts) {
      const auto question = memory[questions].word();
      memory[leaf_bests].write(Bit(new_one | (improves & ~Bit(question[counts]))), place, word);
      memory[questions].write(new_one, in[begun], in[counts], in[turned]);
      memory[froms].write(new_one, in[begun], in[from_t], in[from_number]);
      memory[questions].ask(in[asked]);
      memory[froms].ask(in[asked]);
      next[hit_back_1] = in[hit_back];
    } else {
      memory[leaf_bests].write(writes, place, word);
    }
    memory[kinds].write(new_one, in[begun], in[any_hit]);
    memory[numbers].write(in[reads], in[read_ray], in[number]);
    memory[divided_bests].ask(in[asked]);
    memory[numbers].ask(in[asked]);
    memory[kinds].ask(in[asked]);
    memory[leaf_bests].ask(in[leaf_ray]);
    memory[answer_bests].ask(in[walk_ray]);

    next.where(new_one)[held<begun>] = in[begun];
    next.where(new_one)[held<length>] = in[length];
    next[begins_1] = new_one | (now[begins_1] & ~in[walker_takes]);
    next[divided_1] = in[done];
    next[held<closer>] = in[closer];
    next[divider_1] = in[asked];
    next[held<t>] = in[t];
    next[leaf_1] = in[leaf_done];
    next.hold(in, Leaf());
    next[answers_1] = in[ended];
    next.hold(in, End());
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
