// The triangle test of small chips (docs/core.md): one multiplier that adds up. It stands in place
// of triangle_feed, int_triangle and divider, with the same answers. A test takes some hundred cycles. The
// oldest triangle is tested by triangle_program, which ends as soon as the triangle is missed. If it is hit,
// the accumulator holds num in the end, and
//   T = floor(2^(S+F) |num| / |det|)
// is divided in it, a bit of T in a cycle, without restoring. An instruction is fetched in one cycle, its two
// words are read in the next and multiplied in the third, and the product is added in the fourth.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/triangle_program.hpp"
#include "hls/machines/triangle_queue.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {
namespace serial_triangle {

using namespace channels;
namespace program = triangle_program;
namespace queue = triangle_queue;

/// Bits of a stored word, with a sign. It has room for a number of E1, E2, q, r and D, and two words have
/// room for one of P or C.
inline constexpr auto word_bits = [](const CoreBits& f) {
  return max(f.coord + max(f.finer, 1), f.direction());
};
/// Bits of the accumulator. While it divides, it holds twice a remainder.
inline constexpr auto sum_bits = [](const CoreBits& f) {
  return max(max(f.volume(), f.edge()), f.determinant() + 1);
};
inline constexpr auto product_bits = [](const CoreBits& f) { return 2 * word_bits(f); };
inline constexpr auto left_bits = [](const CoreBits& f) { return count_bits(f.distance() + 1); };
inline constexpr auto raised_by = [](const CoreBits& f) { return f.slope + f.fraction; };
constexpr int counter_bits = count_bits(program::most_instructions);
constexpr int code_bits = program::instruction_bits;

constexpr Control<"works"> works;                    // the oldest triangle is tested
constexpr Control<"tested_1"> tested_1;              // the program has ended in the last cycle
constexpr Data<"hit_1"> hit_1;                       // with a hit
constexpr Control<"fetches"> fetches;                // instructions are fetched
constexpr Control<"counter", counter_bits> counter;  // the place of the next one
constexpr Control<"fetched"> fetched;                // there is an instruction in that cycle of its own
constexpr Control<"reads_words"> reads_words;        // likewise
constexpr Control<"multiplied"> multiplied;          // likewise
constexpr Data<"code_2", code_bits> code_2;          // the latter two
constexpr Data<"code_3", code_bits> code_3;
constexpr SignedData<"product", product_bits> product;
constexpr SignedData<"sum", sum_bits>
    sum;  // the accumulator; in a division the remainder, -|det| .. |det| - 1
constexpr SignedData<"det", &CoreBits::determinant> det;
constexpr Control<"left", left_bits> left;  // cycles of division to come
constexpr Data<"quotient", &CoreBits::distance>
    quotient;                            // bits of T enter below; what is to be divided leaves above
constexpr Control<"compares"> compares;  // the cycles after the division
constexpr Control<"answers"> answers;
constexpr Data<"nearer"> nearer;

inline constexpr auto program_words = [] { return program::program.instructions.data(); };
constexpr Rom<"instructions", program_words, program::most_instructions, code_bits> instructions;
constexpr Block<"words_0", power_of_two(program::place_bits), word_bits> words_0;
constexpr Block<"words_1", power_of_two(program::place_bits), word_bits>
    words_1;  // equal, since an instruction reads two words

struct SerialTriangle {
  static constexpr const char* name = "serial_triangle";
  static constexpr const char* summary = "tests triangles with one multiplier, for small chips";
  using Bits = CoreBits;
  using BuiltIn = FormatList<Fixed<CoreBits{{20, 1, 20, 0, 0}, 5}>>;
  struct In : Join<queue::In, Divides::Back> {};
  struct Out : Join<TriangleRead, List<unread, tested, hit>, Divides> {};
  struct State : Join<queue::State,
                      List<works, tested_1, hit_1, fetches, counter, fetched, reads_words, multiplied, code_2,
                           code_3, product, sum, det, left, quotient, compares, answers, nearer>> {};
  struct Memory : Join<queue::Memory, List<instructions, words_0, words_1>> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    out[reads] = now[queue::reads_1];
    out[read_ray] = now[queue::reader_1];
    out[number] = now[queue::number_1];
    out[unread] = now[queue::unread_1];
    out[tested] = now[tested_1];
    out[hit] = now[hit_1];
    out[asked] = memory[queue::rays].word();
    out[done] = now[answers];
    out[t] = now[quotient];
    out[closer] = now[nearer];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto& code = now[code_3];

    // Does the test go on?
    const Bit negative = sign(now[sum]);
    const Bit same = as("same_sign", ~(negative ^ Bit(sign(now[det]))));
    const Bit is_zero = as("is_zero", ~any<D>(now[sum]));
    const Bit misses =
        as("misses", now[multiplied] & ((has<D, program::checks_det>(code) & is_zero) |
                                        (has<D, program::checks_same>(code) & ~(same | is_zero)) |
                                        (has<D, program::checks_other>(code) & same & ~is_zero) |
                                        (has<D, program::checks_num>(code) & negative)));
    const Bit hits = as("hits", now[multiplied] & has<D, program::checks_num>(code) & ~negative);
    const Bit ends = as("ends", misses | hits);
    const Bit leaves = as("leaves", (now[tested_1] & ~now[hit_1]) | now[answers]);

    store<D>(f, now, memory);
    const Bit divides = as("divides", any<D>(now[left]));
    const Bit back_m = memory[queue::origins].word()[queue::back_m];
    const auto new_sum = as("sum_next", next_sum<D>(f, now, hits, divides, same, back_m));
    next[nearer] = Bit(cat(now[quotient], in[asked_number]) < cat(in[best], in[best_number]));
    next[quotient] = next_quotient<D>(f, now, hits, divides, new_sum);
    next[answers] = now[compares];
    next[compares] = as("last", is<D>(now[left], 1));
    next[left] = select(hits, D::lit(t.width(f), left.width(f)), minus(now[left], divides));
    next.where(Bit(now[multiplied] & has<D, program::checks_det>(code)))[det] =
        as_signed(slice(now[sum], det.width(f) - 1_w, 0_w));
    next[sum] = new_sum;
    next[product] = term<D>(f, now[code_2], memory);

    const Bit begins = as("begins", now[queue::ready] & ~now[works]);
    fetch<D>(now, begins, ends, memory, next);
    next[tested_1] = ends;
    next[hit_1] = hits;
    next[works] = begins | (now[works] & ~leaves);
    queue::step<D>(f, now, in, leaves, memory, next);
  }

 private:
  template <class D, program::Flag Flag>
  static constexpr typename D::bit has(const auto& code) {
    return bit_at(code, Width<int{Flag}>());
  }
  template <int At, int Bits>
  static constexpr auto part_of(const auto& code) {
    return slice(code, Width<At + Bits - 1>(), Width<At>());
  }

  /// The next instruction, and the words of the one that has come.
  template <class D>
  static constexpr void fetch(const auto& now, const auto& begins, const auto& ends, const auto& memory,
                              const auto& next) {
    const auto instruction = memory[instructions].word();
    memory[instructions].ask(now[counter]);
    next[counter] = only(now[fetches], plus(now[counter], now[fetches]));
    next[multiplied] = now[reads_words] & ~ends;
    next[reads_words] = now[fetched] & ~ends;
    next[fetched] = now[fetches] & ~ends;
    next[fetches] = begins | (now[fetches] & ~ends);
    next[code_3] = now[code_2];
    next[code_2] = instruction;
    memory[words_0].ask(part_of<program::first_place, program::place_bits>(instruction));
    memory[words_1].ask(part_of<program::second_place, program::place_bits>(instruction));
  }

  /// |num| 2^(S+F), if it is a hit.
  template <class D>
  static constexpr auto dividend(const auto& f, const auto& now) {
    return cat(slice(now[sum], number_in<&CoreBits::volume>(f) - 2_w, 0_w),
               D::lit(0, number_in<raised_by>(f)));
  }

  /// The accumulator: a sum; or twice the remainder, with |det| taken away or added.
  template <class D, class Bit>
  static constexpr auto next_sum(const auto& f, const auto& now, const Bit& hits, const Bit& divides,
                                 const Bit& same, const Bit& back_m) {
    const auto& code = now[code_3];
    const auto bits = sum.width(f);
    const auto quotient_bits = quotient.width(f);
    const auto word = number_in<word_bits>(f);
    const auto whole = dividend<D>(f, now);
    const auto remainder =
        resize(as_signed(cat(D::lit(0, 1_w), slice(whole, width_of(whole) - 1_w, quotient_bits))), bits);
    const auto digit = either(
        brings_down(f), now[quotient], [&](const auto& q) { return bit_at(q, quotient_bits - 1_w); },
        [&](const auto&) { return D::lit(0, 1_w); });
    const auto raised = cat(slice(now[sum], bits - word, 0_w), D::lit(0, word - 1_w));
    const auto doubled = cat(slice(now[sum], bits - 2_w, 0_w), digit);
    const auto moved =
        select(divides, doubled, select(has<D, program::raises>(code), raised, as_unsigned(now[sum])));
    const Bit drops = as("drops", has<D, program::begins>(code) & ~divides);
    const auto base = select(hits, as_unsigned(remainder), moved) & spread(Bit(~drops), bits);
    const auto change = as("change", select(divides, resize(now[det], bits), resize(now[product], bits)));
    // num is made positive if it is a hit's: det's sign, the other one if the direction is negative.
    const Bit turns = has<D, program::turns>(code) & ~(Bit(sign(now[det])) ^ back_m);
    const Bit negates = as("minus", select(divides, same, Bit(has<D, program::subtracts>(code) ^ turns)));
    const auto longer = as_signed(cat(base, D::lit(1, 1_w))) +
                        as_signed(cat(change ^ as_signed(spread(negates, bits)), negates));
    return as_signed(slice(longer, bits, 1_w));
  }
  /// The low bits of the dividend enter the remainder; else they are 0.
  static constexpr auto brings_down(const auto& f) { return number_in<raised_by>(f) < quotient.width(f); }
  template <class D, class Bit>
  static constexpr auto next_quotient(const auto& f, const auto& now, const Bit& hits, const Bit& divides,
                                      const auto& remainder) {
    const auto bits = quotient.width(f);
    const auto longer = cat(slice(now[quotient], bits - 2_w, 0_w), Bit(~Bit(sign(remainder))));
    return change_if(brings_down(f), select(divides, longer, now[quotient]), [&](const auto& q) {
      return select(hits, slice(dividend<D>(f, now), bits - 1_w, 0_w), q);
    });
  }

  /// What an instruction adds: a product of two words, or a word from outside.
  template <class D>
  static constexpr auto term(const auto& f, const auto& code, const auto& memory) {
    using Bit = typename D::bit;
    const auto ray = memory[queue::origins].word();
    const auto slopes = memory[queue::slopes].word();
    const auto first = memory[queue::corners_0].word();
    const auto second = memory[queue::corners_1].word();
    const auto third = memory[queue::corners_2].word();
    const Bit major_y = ray[queue::major_y], major_z = ray[queue::major_z];
    const auto word = number_in<word_bits>(f);
    const auto finer = number_in<&CoreBits::finer>(f);
    const auto source = part_of<program::first_place, program::source_bits>(code);
    const auto axis = part_of<program::first_place + program::source_bits, 2>(code);
    const Bit is_a = as("is_a", bit_at(axis, 0_w));
    const Bit is_b = as("is_b", bit_at(axis, 1_w));
    const Bit is_m = as("is_m", ~(is_a | is_b));
    // A ray axis and the major axis trade places.
    const Bit is_y = as("is_y", (is_m & major_y) | (is_a & ~major_y));
    const Bit is_z = as("is_z", (is_m & major_z) | (is_b & ~major_z));
    const auto coordinate = [&](const auto& x, const auto& y, const auto& z) {
      return select(is_z, z, select(is_y, y, x));
    };
    const auto by_ray_axis = [&](const auto& m, const auto& a, const auto& b) {
      return select(is_b, b, select(is_a, a, m));
    };
    const auto coarse = as(
        "coordinate",
        select(bit_at(source, 1_w),
               select(bit_at(source, 0_w), coordinate(third[queue::x2], third[queue::y2], third[queue::z2]),
                      coordinate(second[queue::x1], second[queue::y1], second[queue::z1])),
               coordinate(first[queue::x0], first[queue::y0], first[queue::z0])));
    const auto corner =
        change_if(0_w < finer, resize(coarse, number_in<&CoreBits::point>(f)), [&](const auto& x) {
          return select(has<D, program::fine>(code), as_signed(cat(coarse, D::lit(0, finer))), x);
        });
    const auto origin = by_ray_axis(ray[queue::origin_m], ray[queue::origin_a], ray[queue::origin_b]);
    const auto one = as_signed(cat(D::lit(1, 2_w), D::lit(0, number_in<&CoreBits::slope>(f))));
    const auto direction = by_ray_axis(one, slopes[queue::slope_a], slopes[queue::slope_b]);
    const auto outside = select(bit_at(source, 2_w),
                                select(bit_at(source, 0_w), resize(direction, word), resize(origin, word)),
                                resize(corner, word));
    const auto loaded = as("loaded", as_unsigned(outside) & spread(any<D>(source), word));
    const auto multiplied_words =
        as("words_product", as_signed(memory[words_0].word()) * as_signed(memory[words_1].word()));
    return as("term", select(has<D, program::multiplies>(code), multiplied_words,
                             resize(as_signed(loaded), word * 2_w)));
  }

  template <class D>
  static constexpr void store(const auto& f, const auto& now, const auto& memory) {
    using Bit = typename D::bit;
    const auto& code = now[code_3];
    const auto word = number_in<word_bits>(f);
    const auto low = slice(now[sum], word - 2_w, 0_w);
    const Bit top = Bit(bit_at(now[sum], word - 1_w)) & ~has<D, program::stores_low>(code);
    const auto above = as_signed(slice(now[sum], sum.width(f) - 1_w, word - 1_w));
    const auto stored = as("stored", select(has<D, program::stores_high>(code),
                                            as_unsigned(resize(above, word)), cat(top, low)));
    const Bit stores = as("stores", now[multiplied] & has<D, program::stores>(code));
    const auto place = part_of<program::stored_place, program::place_bits>(code);
    memory[words_0].write(stores, place, stored);
    memory[words_1].write(stores, place, stored);
  }
};

}  // namespace serial_triangle

using serial_triangle::SerialTriangle;

}  // namespace hitpipe::hls
