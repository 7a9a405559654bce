// The weights of the corners where a ray hits its triangle (docs/core.md), for cores that give them. It keeps
// det, u and v of int_triangle: of each ray's last test that was a hit, and of its best hit. It stands behind
// `replies`, takes an answer from it, and gives it with the words of its ray.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {

/// The format "dDeEtTgGiI", for example d61e62t20g16i5.
///   D  bits of det;  E  bits of u and v;  T  bits of a distance;  G  bits of a tag;  I  bits of a ray's
///   number
struct WeightBits {
  int determinant = 61;  ///< D
  int edge = 62;         ///< E
  int distance = 20;     ///< T
  int tag = 16;          ///< G
  int ray = 5;           ///< I

  static constexpr FormatField fields[] = {
      {"d", "D", 25, 81}, {"e", "E", 25, 84}, {"t", "T", 4, 36}, {"g", "G", 1, 64}, {"i", "I", 1, 8}};
  static constexpr const char* type = "WeightFormat";

  constexpr int rays() const { return power_of_two(ray); }
  friend constexpr bool operator==(const WeightBits& a, const WeightBits& b) {
    return a.determinant == b.determinant && a.edge == b.edge && a.distance == b.distance && a.tag == b.tag &&
           a.ray == b.ray;
  }
};
template <int Determinant, int Edge, int Distance, int Tag, int Ray>
struct WeightFormat {
  static constexpr WeightBits bits{Determinant, Edge, Distance, Tag, Ray};
  Width<Determinant> determinant{};
  Width<Edge> edge{};
  Width<Distance> distance{};
  Width<Tag> tag{};
  Width<Ray> ray{};
  constexpr operator WeightBits() const { return bits; }
};

namespace weights {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto number_of(const F& f) { return f.ray * 0_w + Width<triangle_number_bits>(); }

  using Ray = decltype(format.ray + 0_w);
  using Tag = decltype(format.tag + 0_w);
  using Distance = decltype(format.distance + 0_w);
  using Number = decltype(number_of(format));
};

/// A number with a sign as two ports: the high half has the sign, and the low half may have a bit less.
template <class D, class W>
struct Halves {
  static constexpr W width{};
  SignedWord<D, decltype(width - width / 2_w)> high;
  Word<D, decltype(width / 2_w)> low;

  template <class Self, class Visit>
  static constexpr void for_each(const char* high_name, const char* low_name, int bits, Self& self,
                                 Visit&& visit) {
    visit(data_field(high_name, bits - bits / 2, true), self.high);
    visit(data_field(low_name, bits / 2), self.low);
  }
  static constexpr Halves of(const Word<D, W>& word) {
    const auto bits = width_of(word);
    return {as_signed(slice(word, bits - 1_w, bits / 2_w)), slice(word, bits / 2_w - 1_w, 0_w)};
  }
  constexpr auto word() const { return cat(high, low); }
};

/// det, u and v.
template <class D, class F>
struct Numbers {
  static constexpr F format{};
  Halves<D, decltype(format.determinant + 0_w)> det;
  Halves<D, decltype(format.edge + 0_w)> u, v;
};

template <class D, class F>
struct State {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit has;    ///< an answer was taken, and has not left
  bit there;  ///< and the words of its ray are there
  Word<D, typename W::Ray> ray;
  Word<D, typename W::Tag> tag;
  bit failed;
  Word<D, typename W::Number> number;
  Word<D, typename W::Distance> t;
  bit freed;
  Word<D, typename W::Ray> freed_ray;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WeightBits bits = format;
    visit(control_field("has", 1), self.has);
    visit(control_field("there", 1), self.there);
    visit(data_field("ray", bits.ray), self.ray);
    visit(data_field("tag", bits.tag), self.tag);
    visit(data_field("failed", 1), self.failed);
    visit(data_field("number", triangle_number_bits), self.number);
    visit(data_field("t", bits.distance), self.t);
    visit(control_field("freed_1", 1), self.freed);
    visit(data_field("freed_ray_1", bits.ray), self.freed_ray);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit tested, hit;  ///< both are 1: a test of int_triangle ends in this cycle with HIT
  Word<D, typename W::Ray> tester;
  Numbers<D, F> test;
  Word<D, typename W::Ray> asked;  ///< the ray that the divider is at
  bit done, closer;                ///< both are 1: its last hit is its best one
  bit answers;                     ///< `replies` has an answer
  Word<D, typename W::Tag> tag;
  bit failed;
  Word<D, typename W::Number> number;
  Word<D, typename W::Distance> t;
  bit left;  ///< an answer has left `replies` in the last cycle
  Word<D, typename W::Ray> left_ray;
  bit taken;  ///< the answer that is given is taken

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WeightBits bits = format;
    visit(data_field("tested", 1), self.tested);
    visit(data_field("test_hit", 1), self.hit);
    visit(data_field("tester", bits.ray), self.tester);
    self.test.det.for_each("det_high", "det_low", bits.determinant, self.test.det, visit);
    self.test.u.for_each("u_high", "u_low", bits.edge, self.test.u, visit);
    self.test.v.for_each("v_high", "v_low", bits.edge, self.test.v, visit);
    visit(data_field("asked", bits.ray), self.asked);
    visit(data_field("done", 1), self.done);
    visit(data_field("closer", 1), self.closer);
    visit(data_field("answer", 1), self.answers);
    visit(data_field("answer_tag", bits.tag), self.tag);
    visit(data_field("answer_failed", 1), self.failed);
    visit(data_field("answer_number", triangle_number_bits), self.number);
    visit(data_field("answer_t", bits.distance), self.t);
    visit(data_field("left", 1), self.left);
    visit(data_field("left_ray", bits.ray), self.left_ray);
    visit(data_field("hit_ready", 1), self.taken);
  }
};

template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit takes;  ///< an answer of `replies`
  bit there;
  Word<D, typename W::Tag> tag;
  bit failed;
  Word<D, typename W::Number> number;
  Word<D, typename W::Distance> t;
  Numbers<D, F> best;
  bit freed;  ///< to the door
  Word<D, typename W::Ray> freed_ray;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WeightBits bits = format;
    visit(data_field("takes", 1), self.takes);
    visit(data_field("hit_valid", 1), self.there);
    visit(data_field("hit_tag", bits.tag), self.tag);
    visit(data_field("hit_failed", 1), self.failed);
    visit(data_field("hit_number", triangle_number_bits), self.number);
    visit(data_field("hit_t", bits.distance), self.t);
    self.best.det.for_each("hit_det_high", "hit_det_low", bits.determinant, self.best.det, visit);
    self.best.u.for_each("hit_u_high", "hit_u_low", bits.edge, self.best.u, visit);
    self.best.v.for_each("hit_v_high", "hit_v_low", bits.edge, self.best.v, visit);
    visit(data_field("freed", 1), self.freed);
    visit(data_field("freed_ray", bits.ray), self.freed_ray);
  }
};

/// By ray: of the last hit, and of the best one.
template <class Memory>
struct Memories {
  Memory last_det, last_u, last_v;
  Memory best_det, best_u, best_v;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WeightBits bits = format;
    const auto memory = [&](const char* name, int width, Memory& of) {
      visit(MemoryShape{name, bits.rays(), width, MemoryKind::block}, of);
    };
    memory("last_det", bits.determinant, self.last_det);
    memory("last_u", bits.edge, self.last_u);
    memory("last_v", bits.edge, self.last_v);
    memory("best_det", bits.determinant, self.best_det);
    memory("best_u", bits.edge, self.best_u);
    memory("best_v", bits.edge, self.best_v);
  }
};

struct Weights {
  static constexpr const char* name = "weights";
  static constexpr const char* summary = "keeps the weights of the corners of each ray's best hit";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = WeightBits;
  using BuiltIn = FormatList<WeightFormat<61, 62, 20, 16, 5>>;
  template <class D, class F>
  using State = weights::State<D, F>;
  template <class D, class F>
  using Inputs = weights::Inputs<D, F>;
  template <class D, class F>
  using Outputs = weights::Outputs<D, F>;
  template <class Memory>
  using Memories = weights::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    using Of = Numbers<D, F>;
    return {~state.has,
            state.there,
            state.tag,
            state.failed,
            state.number,
            state.t,
            {decltype(Of::det)::of(memories.best_det.word(format.determinant)),
             decltype(Of::u)::of(memories.best_u.word(format.edge)),
             decltype(Of::v)::of(memories.best_v.word(format.edge))},
            state.freed,
            state.freed_ray};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    // The divider is at a ray for several cycles, so the words of its last hit are there when it is done.
    const Bit hits = as("hits", in.tested & in.hit);
    const Bit improves = as("improves", in.done & in.closer);
    const auto keep = [&](Memory& last, Memory& best, const auto& test, const auto& width) {
      last.write(hits, in.tester, test.word());
      last.ask(in.asked);
      best.write(improves, in.asked, last.word(width));
    };
    keep(memories.last_det, memories.best_det, in.test.det, format.determinant);
    keep(memories.last_u, memories.best_u, in.test.u, format.edge);
    keep(memories.last_v, memories.best_v, in.test.v, format.edge);

    // An answer leaves `replies` in one cycle. In the next its ray is said, and in the third its words are
    // there. They stay: the ray's number is free only when the answer has left.
    const Bit takes = as("takes_answer", in.answers & ~state.has);
    const Bit leaves = as("leaves", state.there & in.taken);
    state.tag = select(takes, in.tag, state.tag);
    state.failed = select(takes, in.failed, state.failed);
    state.number = select(takes, in.number, state.number);
    state.t = select(takes, in.t, state.t);
    const auto ray = as("ray_wanted", select(in.left, in.left_ray, state.ray));
    memories.best_det.ask(ray);
    memories.best_u.ask(ray);
    memories.best_v.ask(ray);
    state.freed = leaves;
    state.freed_ray = state.ray;
    state.ray = ray;
    state.there = in.left | (state.there & ~leaves);
    state.has = takes | (state.has & ~leaves);
  }
};

}  // namespace weights

using weights::Weights;

}  // namespace hls
}  // namespace hitpipe
