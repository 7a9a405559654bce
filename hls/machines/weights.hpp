// The weights of the corners where a ray hits its triangle (docs/core.md), for cores that give them. It keeps
// det, u and v of int_triangle: of each ray's last test that was a hit, and of its best hit. It stands behind
// `replies`, takes an answer from it, and gives it with the words of its ray.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/memory.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe::hls {

/// The format "dDeEtTgGiI", for example d61e62t20g16i5.
struct WeightBits {
  int determinant = 61;  ///< D: bits of det
  int edge = 62;         ///< E: bits of u and v
  int distance = 20;     ///< T: bits of a distance
  int tag = 16;          ///< G: bits of a tag
  int ray = 5;           ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {
      {"d", "D", 25, 81}, {"e", "E", 25, 84}, {"t", "T", 4, 36}, {"g", "G", 1, 64}, {"i", "I", 1, 8}};

  constexpr int rays() const { return power_of_two(ray); }
  // A number with a sign has two ports: the high half has the sign, and the low half may have a bit less.
  constexpr int det_low() const { return determinant / 2; }
  constexpr int det_high() const { return determinant - det_low(); }
  constexpr int edge_low() const { return edge / 2; }
  constexpr int edge_high() const { return edge - edge_low(); }
  friend constexpr bool operator==(const WeightBits&, const WeightBits&) = default;
};

namespace weights {

constexpr Data<"tested">
    tested;  // this and `test_hit` are 1: a test of int_triangle ends in this cycle with HIT
constexpr Data<"test_hit"> test_hit;
constexpr Data<"tester", &WeightBits::ray> tester;
constexpr SignedData<"det_high", &WeightBits::det_high> det_high;
constexpr Data<"det_low", &WeightBits::det_low> det_low;
constexpr SignedData<"u_high", &WeightBits::edge_high> u_high;
constexpr Data<"u_low", &WeightBits::edge_low> u_low;
constexpr SignedData<"v_high", &WeightBits::edge_high> v_high;
constexpr Data<"v_low", &WeightBits::edge_low> v_low;
constexpr Data<"asked", &WeightBits::ray> asked;  // the ray that the divider is at
constexpr Data<"done"> done;                      // this and `closer` are 1: its last hit is its best one
constexpr Data<"closer"> closer;
constexpr Data<"answer"> answer;  // `replies` has an answer
constexpr Data<"answer_tag", &WeightBits::tag> answer_tag;
constexpr Data<"answer_failed"> answer_failed;
constexpr Data<"answer_number", triangle_number_bits> answer_number;
constexpr Data<"answer_t", &WeightBits::distance> answer_t;
constexpr Data<"left"> left;  // an answer has left `replies` in the last cycle
constexpr Data<"left_ray", &WeightBits::ray> left_ray;
constexpr Data<"hit_ready"> hit_ready;  // the answer that is given is taken

constexpr Data<"takes"> takes;  // an answer of `replies`
constexpr Data<"hit_valid"> hit_valid;
constexpr Data<"hit_tag", &WeightBits::tag> hit_tag;
constexpr Data<"hit_failed"> hit_failed;
constexpr Data<"hit_number", triangle_number_bits> hit_number;
constexpr Data<"hit_t", &WeightBits::distance> hit_t;
constexpr SignedData<"hit_det_high", &WeightBits::det_high> hit_det_high;
constexpr Data<"hit_det_low", &WeightBits::det_low> hit_det_low;
constexpr SignedData<"hit_u_high", &WeightBits::edge_high> hit_u_high;
constexpr Data<"hit_u_low", &WeightBits::edge_low> hit_u_low;
constexpr SignedData<"hit_v_high", &WeightBits::edge_high> hit_v_high;
constexpr Data<"hit_v_low", &WeightBits::edge_low> hit_v_low;
constexpr Data<"freed"> freed;  // to the door
constexpr Data<"freed_ray", &WeightBits::ray> freed_ray;

constexpr Control<"has"> has;      // an answer was taken, and has not left
constexpr Control<"there"> there;  // and the words of its ray are there
constexpr Data<"ray", &WeightBits::ray> ray;
constexpr Data<"tag", &WeightBits::tag> tag;
constexpr Data<"failed"> failed;
constexpr Data<"number", triangle_number_bits> number;
constexpr Data<"t", &WeightBits::distance> t;
constexpr Control<"freed_1"> freed_1;
constexpr Data<"freed_ray_1", &WeightBits::ray> freed_ray_1;

// By ray: of the last hit, and of the best one.
struct Det : List<hit_det_high, hit_det_low> {};
struct U : List<hit_u_high, hit_u_low> {};
struct V : List<hit_v_high, hit_v_low> {};
constexpr Block<"last_det", &WeightBits::rays, &WeightBits::determinant> last_det;
constexpr Block<"last_u", &WeightBits::rays, &WeightBits::edge> last_u;
constexpr Block<"last_v", &WeightBits::rays, &WeightBits::edge> last_v;
constexpr BlockOf<"best_det", &WeightBits::rays, Det> best_det;
constexpr BlockOf<"best_u", &WeightBits::rays, U> best_u;
constexpr BlockOf<"best_v", &WeightBits::rays, V> best_v;

struct Weights {
  static constexpr const char* name = "weights";
  static constexpr const char* summary = "keeps the weights of the corners of each ray's best hit";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = WeightBits;
  using BuiltIn = FormatList<Fixed<WeightBits{61, 62, 20, 16, 5}>>;
  struct In
      : List<tested, test_hit, tester, det_high, det_low, u_high, u_low, v_high, v_low, asked, done, closer,
             answer, answer_tag, answer_failed, answer_number, answer_t, left, left_ray, hit_ready> {};
  struct Out : List<takes, hit_valid, hit_tag, hit_failed, hit_number, hit_t, hit_det_high, hit_det_low,
                    hit_u_high, hit_u_low, hit_v_high, hit_v_low, freed, freed_ray> {};
  struct State : List<has, there, ray, tag, failed, number, t, freed_1, freed_ray_1> {};
  struct Memory : List<last_det, last_u, last_v, best_det, best_u, best_v> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[takes] = ~now[has];
    out[hit_valid] = now[there];
    out[hit_tag] = now[tag];
    out[hit_failed] = now[failed];
    out[hit_number] = now[number];
    out[hit_t] = now[t];
    out.copy(memory[best_det].word());
    out.copy(memory[best_u].word());
    out.copy(memory[best_v].word());
    out[freed] = now[freed_1];
    out[freed_ray] = now[freed_ray_1];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    // The divider is at a ray for several cycles, so the words of its last hit are there when it is done.
    const Bit hits = as("hits", in[tested] & in[test_hit]);
    const Bit improves = as("improves", in[done] & in[closer]);
    const auto keep = [&](auto last, auto best, const auto& test) {
      memory[last].write(hits, in[tester], test);
      memory[last].ask(in[asked]);
      memory[best].write(improves, in[asked], memory[last].word());
    };
    keep(last_det, best_det, cat(in[det_high], in[det_low]));
    keep(last_u, best_u, cat(in[u_high], in[u_low]));
    keep(last_v, best_v, cat(in[v_high], in[v_low]));

    // An answer leaves `replies` in one cycle. In the next its ray is said, and in the third its words are
    // there. They stay: the ray's number is free only when the answer has left.
    const Bit taken = as("takes_answer", in[answer] & ~now[has]);
    const Bit leaves = as("leaves", now[there] & in[hit_ready]);
    next.where(taken)[tag] = in[answer_tag];
    next.where(taken)[failed] = in[answer_failed];
    next.where(taken)[number] = in[answer_number];
    next.where(taken)[t] = in[answer_t];
    const auto wanted = as("ray_wanted", select(in[left], in[left_ray], now[ray]));
    memory[best_det].ask(wanted);
    memory[best_u].ask(wanted);
    memory[best_v].ask(wanted);
    next[freed_1] = leaves;
    next[freed_ray_1] = now[ray];
    next[ray] = wanted;
    next[there] = in[left] | (now[there] & ~leaves);
    next[has] = taken | (now[has] & ~leaves);
  }
};

}  // namespace weights

using weights::Weights;

}  // namespace hitpipe::hls
