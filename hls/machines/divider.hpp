// Where a ray meets the triangles that it hits, and whether one is nearer than the best so far
// (docs/integer_world.md). int_triangle says HIT, det and num; this machine makes
//   T = floor(2^(S+F) |num| / |det|)
// Few tests are hits, so they wait in a queue with a place for every ray. A ray is in one place at a time, so
// the queue cannot overflow. One test is divided at a time, without restoring, by two bits of T in a cycle: a
// cycle loads it, at most 12 divide it where T has no more than 24 bits, and one compares (T, number) with
// the best of the ray.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {
namespace divider {

/// Cycles of division, for that many bits of T.
constexpr int cycles(int distance) {
  return (distance + 1) / 2;
}
/// Cycles from one test to the next: it is loaded, divided and compared.
constexpr int interval(const WorldBits& format) {
  return cycles(format.distance()) + 2;
}

inline constexpr auto divisions = [](const CoreBits& f) { return cycles(f.distance()); };
inline constexpr auto left_bits = [](const CoreBits& f) { return count_bits(divisions(f) + 1); };
inline constexpr auto quotient_bits = [](const CoreBits& f) { return 2 * divisions(f); };
inline constexpr auto raised_by = [](const CoreBits& f) { return f.slope + f.fraction; };
using namespace channels;

using TestDet = Halves<"det", &CoreBits::determinant>;
using TestNum = Halves<"num", &CoreBits::volume>;

using Queue = IdQueue<>;                    // tests that wait; the oldest is divided
constexpr Control<"left", left_bits> left;  // cycles of division to come
constexpr Control<"compares"> compares;     // the cycles after the division
constexpr Control<"answers"> answers;
constexpr Data<"at", ray_bits> at;                                    // the ray whose test is divided
constexpr SignedData<"remainder", &CoreBits::determinant> remainder;  // -|det| .. |det| - 1
constexpr SignedData<"thrice", &CoreBits::determinant> thrice;        // the low bits of 3 det
constexpr Data<"quotient", quotient_bits>
    quotient;  // bits of T enter below; what is to be divided leaves above
constexpr Data<"nearer"> nearer;
constexpr DataIf<"backward", 1, has_questions> backward;  // det is negative

constexpr Block<"rays", &CoreBits::rays, ray_bits> rays;  // the queue
constexpr Block<"dets", &CoreBits::rays, &CoreBits::determinant> dets;
constexpr Block<"nums", &CoreBits::rays, &CoreBits::volume> nums;

struct Divider {
  static constexpr const char* name = "divider";
  static constexpr const char* summary = "distance of the triangles that are hit, and the nearest";
  using Bits = CoreBits;
  using BuiltIn = FormatList<Fixed<CoreBits{{20, 1, 20, 0, 0}, 5}>, Fixed<CoreBits{{20, 1, 20, 0, 0}, 7}>>;
  struct In : Join<Tested, TestDet, TestNum, Divides::Back, Compares::Back> {};
  struct Out : Join<Divides, Compares> {};
  struct State
      : Join<Queue::State, List<left, compares, answers, at, remainder, thrice, quotient, nearer, backward>> {
  };
  struct Memory : List<rays, dets, nums> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& /*memory*/, const auto& out) {
    out[asked] = now[at];
    out[done] = now[answers];
    out[t] = slice(now[quotient], t.width(f) - 1_w, 0_w);
    out[closer] = now[nearer];
    if (has_questions(CoreBits(f))) out[hit_back] = now[backward];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto det_bits = number_in<&CoreBits::determinant>(f);
    const auto num_bits = number_in<&CoreBits::volume>(f);
    const auto shift = number_in<raised_by>(f);
    const auto t_bits = quotient.width(f);

    // The queue. The words of its oldest test are asked for all the time.
    const auto place = as("place", Queue::place(now));
    const Bit enters = as("enters", in[tested] & in[hit]);
    memory[rays].write(enters, place, in[tester]);
    memory[dets].write(enters, place, cat(in[TestDet::high], in[TestDet::low]));
    memory[nums].write(enters, place, cat(in[TestNum::high], in[TestNum::low]));
    const Bit divides = as("divides", any<D>(now[left]));
    const Bit loads = as("loads", now[Queue::there] & ~divides & ~now[compares]);
    const auto oldest = Queue::step<D>(now, next, enters, now[compares]);
    memory[rays].ask(oldest);
    memory[dets].ask(oldest);
    memory[nums].ask(oldest);

    // |num| 2^(S+F) above and below the bits of T.
    const auto num = as_signed(memory[nums].word());
    const auto size = as("size", select(Bit(sign(num)), resize(D::lit(0, 1_w) - num, num_bits), num));
    const auto whole = cat(slice(size, num_bits - 2_w, 0_w), D::lit(0, shift));
    const auto above =
        resize(as_signed(cat(D::lit(0, 1_w), slice(whole, width_of(whole) - 1_w, t_bits))), det_bits);
    const auto below = slice(whole, t_bits - 1_w, 0_w);
    const auto brings_down = shift < t_bits;  // else `below` is 0

    // Two bits of T. Twice the remainder, with |det| taken away or added, has the first bit as its sign; then
    // the same again gives the second. So four times the remainder changes by |det| or by 3 |det|. Both are
    // computed beside the first bit, which selects one.
    const auto det = as_signed(memory[dets].word());
    const Bit negative = sign(now[remainder]);
    const Bit subtracts = as("subtracts", ~(negative ^ Bit(sign(det))));  // det, which may be negative
    const auto change_by = [&](const auto& x) {
      return as_signed(x ^ as_signed(spread(subtracts, width_of(x))));
    };
    const auto quotient_top = t_bits - 1_w;
    const auto zero = D::lit(0, 1_w);
    const auto first_digit = either(
        brings_down, now[quotient], [&](const auto& q) { return bit_at(q, quotient_top); },
        [&](const auto&) { return zero; });
    const auto second_digit = either(
        brings_down, now[quotient], [&](const auto& q) { return bit_at(q, quotient_top - 1_w); },
        [&](const auto&) { return zero; });
    const auto doubled = as_signed(cat(cat(now[remainder], first_digit), zero));
    const auto bound = as_signed(cat(det ^ as_signed(spread(Bit(~subtracts), det_bits)), Bit(~subtracts)));
    const Bit first_negative = as("first_negative", Bit(doubled < bound));
    const auto quadrupled = cat(cat(now[remainder], first_digit), second_digit);
    const auto changed = [&](const char* name, const auto& x) {
      const auto sum = as_signed(cat(quadrupled, D::lit(1, 1_w))) + as_signed(cat(change_by(x), subtracts));
      return as(name, as_signed(slice(sum, det_bits, 1_w)));
    };
    const auto by_one = changed("by_one", det);
    const auto by_three = changed("by_three", now[thrice]);
    const auto divided = select(Bit(first_negative ^ negative), by_one, by_three);
    const auto longer =
        cat(slice(now[quotient], t_bits - 3_w, 0_w), cat(Bit(~first_negative), Bit(~Bit(sign(divided)))));

    const auto found = slice(now[quotient], t.width(f) - 1_w, 0_w);
    const Bit is_less = Bit(cat(found, in[asked_number]) < cat(in[best], in[best_number]));
    // The next crossing is not before the ray's place. A crossing that is counted is.
    next[nearer] = change_if(has_questions(CoreBits(f)), is_less, [&](const Bit& less) {
      // A ray that counts takes every triangle at its end, whatever its number.
      const auto any_number = spread(in[asked_counts], width_of(in[asked_from_number]));
      const auto end = cat(in[asked_from_t], in[asked_from_number] | any_number);
      const Bit before = as("before", Bit(cat(found, in[asked_number]) < end));
      next[backward] = sign(det);
      return select(in[asked_counts], before, Bit(less & ~before));
    });
    next.where(loads)[at] = memory[rays].word();
    next[remainder] = select(loads, above, divided);
    next.where(loads)[thrice] = resize(det + as_signed(cat(det, zero)), det_bits);
    next[quotient] = change_if(brings_down, select(divides, longer, now[quotient]),
                               [&](const auto& kept) { return select(loads, below, kept); });
    next[answers] = now[compares];
    next[compares] = as("last", is<D>(now[left], 1));
    next[left] = select(loads, D::lit(divisions(f), left.width(f)), minus(now[left], divides));
  }
};

}  // namespace divider

using divider::Divider;

}  // namespace hitpipe::hls
