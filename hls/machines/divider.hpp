// Where a ray meets the triangles that it hits, and whether one is nearer than the best so far
// (docs/integer_world.md). int_triangle says HIT, det and num; this machine makes
//   T = floor(2^(S+F) |num| / |det|)
// Few tests are hits, so they wait in a queue with a place for every ray. A ray is in one place at a time, so
// the queue cannot overflow. One test is divided at a time, without restoring, by two bits of T in a cycle: a
// cycle loads it, at most 12 divide it where T has no more than 24 bits, and one compares (T, number) with
// the best of the ray.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {
namespace divider {

/// Cycles of division, for that many bits of T.
constexpr int cycles(int distance) {
  return (distance + 1) / 2;
}
template <int N>
constexpr Width<cycles(N)> cycles(Width<N>) {
  return {};
}
/// Cycles from one test to the next: it is loaded, divided and compared.
constexpr int interval(const WorldBits& format) {
  return cycles(format.distance()) + 2;
}

template <class F>
constexpr auto quotient_width(const F& format) {
  return cycles(format.distance()) * 2_w;
}
template <class F>
constexpr auto left_width(const F& format) {
  return count_bits(cycles(format.distance()) + 1_w);
}

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  using Ray = decltype(format.ray + 0_w);
  using Distance = decltype(format.distance());
  using Quotient = decltype(quotient_width(format));
  using Left = decltype(left_width(format));
  using Determinant = decltype(format.determinant());
  using Number = decltype(format.ray * 0_w + Width<triangle_number_bits>());
};

template <class D, class F>
struct State {
  using bit = typename D::bit;
  using W = Widths<F>;

  IdQueue<D, F> queue;                               ///< tests that wait; the oldest is divided
  Word<D, typename W::Left> left;                    ///< cycles of division to come
  bit compares, answers;                             ///< the cycles after the division
  Word<D, typename W::Ray> at;                       ///< the ray whose test is divided
  SignedWord<D, typename W::Determinant> remainder;  ///< -|det| .. |det| - 1
  SignedWord<D, typename W::Determinant> thrice;     ///< the low bits of 3 det
  Word<D, typename W::Quotient> quotient;  ///< bits of T enter below; what is to be divided leaves above
  bit closer;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    IdQueue<D, F>::for_each({"used", "oldest", "there"}, bits.ray, self.queue, visit);
    visit(control_field("left", left_width(bits)), self.left);
    visit(control_field("compares", 1), self.compares);
    visit(control_field("answers", 1), self.answers);
    visit(data_field("at", bits.ray), self.at);
    visit(data_field("remainder", bits.determinant(), true), self.remainder);
    visit(data_field("thrice", bits.determinant(), true), self.thrice);
    visit(data_field("quotient", quotient_width(bits)), self.quotient);
    visit(data_field("nearer", 1), self.closer);
  }
};

template <class D, class F>
struct Inputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit tested, hit;               ///< both are 1: a test of int_triangle ends in this cycle with HIT
  Word<D, typename W::Ray> ray;  ///< of that test
  typename F::template DeterminantHigh<D> det_high;
  typename F::template DeterminantLow<D> det_low;
  typename F::template VolumeHigh<D> num_high;
  typename F::template VolumeLow<D> num_low;
  Word<D, typename W::Number> number;       ///< of the triangle that the ray `asked` was tested with
  Word<D, typename W::Distance> best;       ///< T of the best hit of that ray; its length before the first
  Word<D, typename W::Number> best_number;  ///< all ones before the first

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    const auto high = [](int width) { return width - width / 2; };
    const auto low = [](int width) { return width / 2; };
    visit(data_field("tested", 1), self.tested);
    visit(data_field("hit", 1), self.hit);
    visit(data_field("ray", bits.ray), self.ray);
    visit(data_field("det_high", high(bits.determinant()), true), self.det_high);
    visit(data_field("det_low", low(bits.determinant())), self.det_low);
    visit(data_field("num_high", high(bits.volume()), true), self.num_high);
    visit(data_field("num_low", low(bits.volume())), self.num_low);
    visit(data_field("number", triangle_number_bits), self.number);
    visit(data_field("best", bits.distance()), self.best);
    visit(data_field("best_number", triangle_number_bits), self.best_number);
  }
};

template <class D, class F>
struct Outputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  Word<D, typename W::Ray> asked;  ///< the ray whose best and number are wanted in the next cycles
  bit done;                        ///< 1: `asked`, `t` and `closer` are an answer
  Word<D, typename W::Distance> t;
  bit closer;  ///< (T, number) is less than (best, best_number)

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    visit(data_field("asked", bits.ray), self.asked);
    visit(data_field("done", 1), self.done);
    visit(data_field("t", bits.distance()), self.t);
    visit(data_field("closer", 1), self.closer);
  }
};

template <class Memory>
struct Memories {
  Memory rays, dets, nums;  ///< the queue

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    visit(MemoryShape{"rays", bits.rays(), bits.ray, MemoryKind::block}, self.rays);
    visit(MemoryShape{"dets", bits.rays(), bits.determinant(), MemoryKind::block}, self.dets);
    visit(MemoryShape{"nums", bits.rays(), bits.volume(), MemoryKind::block}, self.nums);
  }
};

struct Divider {
  static constexpr const char* name = "divider";
  static constexpr const char* summary = "distance of the triangles that are hit, and the nearest";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = CoreBits;
  using BuiltIn = FormatList<CoreFormat<20, 1, 20, 0, 0, 5>, CoreFormat<20, 1, 20, 0, 0, 7>>;
  template <class D, class F>
  using State = divider::State<D, F>;
  template <class D, class F>
  using Inputs = divider::Inputs<D, F>;
  template <class D, class F>
  using Outputs = divider::Outputs<D, F>;
  template <class Memory>
  using Memories = divider::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state, Memories<Memory>&) {
    return {state.at, state.answers, slice(state.quotient, format.distance() - 1_w, 0_w), state.closer};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;

    // The queue. The words of its oldest test are asked for all the time.
    const auto place = as("place", state.queue.place(format.ray));
    const Bit enters = as("enters", in.tested & in.hit);
    memories.rays.write(enters, place, in.ray);
    memories.dets.write(enters, place, cat(in.det_high, in.det_low));
    memories.nums.write(enters, place, cat(in.num_high, in.num_low));
    const Bit divides = as("divides", any<D>(state.left));
    const Bit loads = as("loads", state.queue.there & ~divides & ~state.compares);
    const auto oldest = state.queue.step(format.ray, enters, state.compares);
    memories.rays.ask(oldest);
    memories.dets.ask(oldest);
    memories.nums.ask(oldest);

    // |num| 2^(S+F) above and below the bits of T.
    const auto num = as_signed(memories.nums.word(format.volume()));
    const auto size = as("size", select(Bit(sign(num)), resize(D::lit(0, 1_w) - num, format.volume()), num));
    const auto whole =
        cat(slice(size, format.volume() - 2_w, 0_w), D::lit(0, format.slope + format.fraction));
    const auto quotient_bits = quotient_width(format);
    const auto above =
        resize(as_signed(cat(D::lit(0, 1_w), slice(whole, width_of(whole) - 1_w, quotient_bits))),
               format.determinant());
    const auto below = slice(whole, quotient_bits - 1_w, 0_w);
    const auto brings_down = format.slope + format.fraction < quotient_bits;  // else `below` is 0

    // Two bits of T. Twice the remainder, with |det| taken away or added, has the first bit as its sign; then
    // the same again gives the second. So four times the remainder changes by |det| or by 3 |det|. Both are
    // computed beside the first bit, which selects one.
    const auto det = as_signed(memories.dets.word(format.determinant()));
    const Bit negative = sign(state.remainder);
    const Bit subtracts = as("subtracts", ~(negative ^ Bit(sign(det))));  // det, which may be negative
    const auto change_by = [&](const auto& x) {
      return as_signed(x ^ as_signed(spread(subtracts, width_of(x))));
    };
    const auto quotient_top = quotient_bits - 1_w;
    const auto zero = D::lit(0, 1_w);
    const auto first_digit = either(
        brings_down, state.quotient, [&](const auto& q) { return bit_at(q, quotient_top); },
        [&](const auto&) { return zero; });
    const auto second_digit = either(
        brings_down, state.quotient, [&](const auto& q) { return bit_at(q, quotient_top - 1_w); },
        [&](const auto&) { return zero; });
    const auto doubled = as_signed(cat(cat(state.remainder, first_digit), zero));
    const auto bound =
        as_signed(cat(det ^ as_signed(spread(Bit(~subtracts), format.determinant())), Bit(~subtracts)));
    const Bit first_negative = as("first_negative", Bit(doubled < bound));
    const auto quadrupled = cat(cat(state.remainder, first_digit), second_digit);
    const auto changed = [&](const char* name, const auto& x) {
      const auto sum = as_signed(cat(quadrupled, D::lit(1, 1_w))) + as_signed(cat(change_by(x), subtracts));
      return as(name, as_signed(slice(sum, format.determinant(), 1_w)));
    };
    const auto by_one = changed("by_one", det);
    const auto by_three = changed("by_three", state.thrice);
    const auto remainder = select(Bit(first_negative ^ negative), by_one, by_three);
    const auto quotient = cat(slice(state.quotient, quotient_bits - 3_w, 0_w),
                              cat(Bit(~first_negative), Bit(~Bit(sign(remainder)))));

    const auto t = slice(state.quotient, format.distance() - 1_w, 0_w);
    state.closer = Bit(cat(t, in.number) < cat(in.best, in.best_number));
    state.at = select(loads, memories.rays.word(format.ray), state.at);
    state.remainder = select(loads, above, remainder);
    state.thrice = select(loads, resize(det + as_signed(cat(det, zero)), format.determinant()), state.thrice);
    state.quotient = change_if(brings_down, select(divides, quotient, state.quotient),
                               [&](const auto& kept) { return select(loads, below, kept); });
    state.answers = state.compares;
    state.compares = as("last", Bit(state.left == D::lit(1, left_width(format))));
    const auto one_less = resize(as_unsigned(state.left - divides), left_width(format));
    state.left = select(loads, D::lit(cycles(format.distance()), left_width(format)), one_less);
  }
};

}  // namespace divider

using divider::Divider;

}  // namespace hls
}  // namespace hitpipe
