// The weights of the corners where a ray hits its triangle (docs/core.md), for cores that give them. It keeps
// det, u and v of int_triangle: of each ray's last test that was a hit, and of its best hit. It stands behind
// `replies`, takes an answer from it, and gives it with the words of its ray.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "dDeEtTgGiI", for example d61e62t20g16i5.
struct WeightBits {
  int determinant = 61;  ///< D: bits of det
  int edge = 62;         ///< E: bits of u and v
  int distance = 20;     ///< T: bits of the T of an answer
  int tag = 16;          ///< G: bits of a tag
  int ray = 5;           ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {
      {"d", "D", 25, 81}, {"e", "E", 25, 84}, {"t", "T", 4, 36}, {"g", "G", 1, 64}, {"i", "I", 1, 8}};

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const WeightBits&, const WeightBits&) = default;
};

namespace weights {

using namespace channels;

// Of a test that ends, and of an answer.
using TestDet = Halves<"det", &WeightBits::determinant>;
using TestU = Halves<"u", &WeightBits::edge>;
using TestV = Halves<"v", &WeightBits::edge>;
using HitDet = Halves<"hit_det", &WeightBits::determinant>;
using HitU = Halves<"hit_u", &WeightBits::edge>;
using HitV = Halves<"hit_v", &WeightBits::edge>;
struct HitWeights : Join<HitDet, HitU, HitV> {};

constexpr Control<"has"> has;      // an answer was taken, and has not left
constexpr Control<"there"> there;  // and the words of its ray are there
constexpr Data<"ray", ray_bits> ray;
struct Answer : List<HitsToWeights::tag, HitsToWeights::t, HitsToWeights::number, HitsToWeights::failed> {};
constexpr Control<"freed_1"> freed_1;
constexpr Data<"freed_ray_1", ray_bits> freed_ray_1;

// By ray: of the last hit, and of the best one.
constexpr Block<"last_det", &WeightBits::rays, &WeightBits::determinant> last_det;
constexpr Block<"last_u", &WeightBits::rays, &WeightBits::edge> last_u;
constexpr Block<"last_v", &WeightBits::rays, &WeightBits::edge> last_v;
constexpr BlockOf<"best_det", &WeightBits::rays, HitDet> best_det;
constexpr BlockOf<"best_u", &WeightBits::rays, HitU> best_u;
constexpr BlockOf<"best_v", &WeightBits::rays, HitV> best_v;

struct Weights {
  static constexpr const char* name = "weights";
  static constexpr const char* summary = "keeps the weights of the corners of each ray's best hit";
  using Bits = WeightBits;
  using BuiltIn = FormatList<Fixed<WeightBits{61, 62, 20, 16, 5}>>;
  struct In : Join<Tested, TestDet, TestU, TestV, List<asked, done, closer>, HitsToWeights, FreedToWeights,
                   Hits::Back> {};
  struct Out : Join<HitsToWeights::Back, Hits, HitWeights, Freed> {};
  struct State : Join<List<has, there, ray>, Held<Answer>, List<freed_1, freed_ray_1>> {};
  struct Memory : List<last_det, last_u, last_v, best_det, best_u, best_v> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[HitsToWeights::ready] = ~now[has];
    out[Hits::valid] = now[there];
    out[Hits::tag] = now[held<HitsToWeights::tag>];
    out[Hits::t] = now[held<HitsToWeights::t>];
    out[Hits::number] = now[held<HitsToWeights::number>];
    out[Hits::failed] = now[held<HitsToWeights::failed>];
    out.copy(memory[best_det].word());
    out.copy(memory[best_u].word());
    out.copy(memory[best_v].word());
    out[Freed::is] = now[freed_1];
    out[Freed::ray] = now[freed_ray_1];
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    // The divider is at a ray for several cycles, so the words of its last hit are there when it is done.
    const Bit hits = as("hits", in[tested] & in[hit]);
    const Bit improves = as("improves", in[done] & in[closer]);
    const auto keep = [&](auto last, auto best, const auto& test) {
      memory[last].write(hits, in[tester], test);
      memory[last].ask(in[asked]);
      memory[best].write(improves, in[asked], memory[last].word());
    };
    keep(last_det, best_det, cat(in[TestDet::high], in[TestDet::low]));
    keep(last_u, best_u, cat(in[TestU::high], in[TestU::low]));
    keep(last_v, best_v, cat(in[TestV::high], in[TestV::low]));

    // An answer leaves `replies` in one cycle. In the next its ray is said, and in the third its words are
    // there. They stay: the ray's number is free only when the answer has left.
    const Bit taken = as("takes_answer", in[HitsToWeights::valid] & ~now[has]);
    const Bit leaves = as("leaves", now[there] & in[Hits::ready]);
    next.where(taken).hold(in, Answer());
    const auto wanted = as("ray_wanted", select(in[FreedToWeights::is], in[FreedToWeights::ray], now[ray]));
    memory[best_det].ask(wanted);
    memory[best_u].ask(wanted);
    memory[best_v].ask(wanted);
    next[freed_1] = leaves;
    next[freed_ray_1] = now[ray];
    next[ray] = wanted;
    next[there] = in[FreedToWeights::is] | (now[there] & ~leaves);
    next[has] = taken | (now[has] & ~leaves);
  }
};

}  // namespace weights

using weights::Weights;

}  // namespace hitpipe::hls
