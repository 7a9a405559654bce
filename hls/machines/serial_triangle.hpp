// The triangle test of small chips (docs/core.md): one multiplier that adds up. It stands in place
// of triangle_feed, int_triangle and divider, with the same answers. A test takes some hundred cycles. The
// oldest triangle is tested by triangle_program, which ends as soon as the triangle is missed. If it is hit,
// the accumulator holds num in the end, and
//   T = floor(2^(S+F) |num| / |det|)
// is divided in it, a bit of T in a cycle, without restoring. An instruction is fetched in one cycle, its two
// words are read in the next and multiplied in the third, and the product is added in the fourth.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/machine.hpp"
#include "hls/machines/triangle_program.hpp"
#include "hls/machines/triangle_queue.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe {
namespace hls {
namespace serial_triangle {

namespace program = triangle_program;

/// Bits of a stored word, with a sign. It has room for a number of E1, E2, q, r and D, and two words have
/// room for one of P or C.
template <class F>
constexpr auto word_width(const F& format) {
  return max(format.coord + max(format.finer, 1_w), format.direction());
}
/// Bits of the accumulator. While it divides, it holds twice a remainder.
template <class F>
constexpr auto sum_width(const F& format) {
  return max(max(format.volume(), format.edge()), format.determinant() + 1_w);
}
template <class F>
constexpr auto left_width(const F& format) {
  return count_bits(format.distance() + 1_w);
}

/// Widths as types, in a format.
template <class F>
struct Widths : TriangleWidths<F> {
  static constexpr F format{};
  static constexpr auto instruction_of(const F& f) {
    return f.ray * 0_w + Width<int{program::instruction_bits}>();
  }

  using Distance = decltype(format.distance());
  using Instruction = decltype(instruction_of(format));
  using Place = decltype(format.ray * 0_w + Width<count_bits(program::most_instructions)>());
  using Product = decltype(word_width(format) * 2_w);
  using Sum = decltype(sum_width(format));
  using Determinant = decltype(format.determinant());
  using Left = decltype(left_width(format));
};

template <class D, class F>
struct State {
  using W = Widths<F>;
  using bit = typename D::bit;

  TriangleQueue<D, F> queue;
  bit works;                                        ///< the oldest triangle is tested
  bit tested, hit;                                  ///< the program has ended in the last cycle; with a hit
  bit fetches;                                      ///< instructions are fetched
  Word<D, typename W::Place> place;                 ///< of the next one
  bit fetched, reads_words, multiplied;             ///< there is an instruction in that cycle of its own
  Word<D, typename W::Instruction> code_2, code_3;  ///< the latter two
  SignedWord<D, typename W::Product> product;
  SignedWord<D, typename W::Sum> sum;  ///< the accumulator; in a division the remainder, -|det| .. |det| - 1
  SignedWord<D, typename W::Determinant> det;
  Word<D, typename W::Left> left;          ///< cycles of division to come
  Word<D, typename W::Distance> quotient;  ///< bits of T enter below; what is to be divided leaves above
  bit compares, answers;                   ///< the cycles after the division
  bit closer;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    TriangleQueue<D, F>::for_each(bits, self.queue, visit);
    visit(control_field("works", 1), self.works);
    visit(control_field("tested_1", 1), self.tested);
    visit(data_field("hit_1", 1), self.hit);
    visit(control_field("fetches", 1), self.fetches);
    visit(control_field("counter", count_bits(program::most_instructions)), self.place);
    visit(control_field("fetched", 1), self.fetched);
    visit(control_field("reads_words", 1), self.reads_words);
    visit(control_field("multiplied", 1), self.multiplied);
    visit(data_field("code_2", program::instruction_bits), self.code_2);
    visit(data_field("code_3", program::instruction_bits), self.code_3);
    visit(data_field("product", word_width(bits) * 2, true), self.product);
    visit(data_field("sum", sum_width(bits), true), self.sum);
    visit(data_field("det", bits.determinant(), true), self.det);
    visit(control_field("left", left_width(bits)), self.left);
    visit(data_field("quotient", bits.distance()), self.quotient);
    visit(control_field("compares", 1), self.compares);
    visit(control_field("answers", 1), self.answers);
    visit(data_field("nearer", 1), self.closer);
  }
};

template <class D, class F>
struct Inputs {
  using W = Widths<F>;

  TriangleInputs<D, F> triangle;
  Word<D, typename W::Number> number;       ///< of the triangle that the ray `asked` is tested with
  Word<D, typename W::Distance> best;       ///< T of the best hit of that ray; its length before the first
  Word<D, typename W::Number> best_number;  ///< all ones before the first

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    TriangleInputs<D, F>::for_each(bits, self.triangle, visit);
    visit(data_field("asked_number", triangle_number_bits), self.number);
    visit(data_field("best", bits.distance()), self.best);
    visit(data_field("best_number", triangle_number_bits), self.best_number);
  }
};

/// What triangle_feed says of a triangle that has come, int_triangle of HIT, and divider of T.
template <class D, class F>
struct Outputs {
  using W = Widths<F>;
  using bit = typename D::bit;

  bit reads;
  Word<D, typename W::Ray> reader;
  Word<D, typename W::Number> number;
  bit tested, hit;                 ///< the test of the ray `asked` has ended
  Word<D, typename W::Ray> asked;  ///< the ray of the oldest triangle; its best is wanted in the next cycles
  bit done;                        ///< 1: `asked`, `t` and `closer` are an answer
  Word<D, typename W::Distance> t;
  bit closer;  ///< (T, number) is less than (best, best_number)

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    visit(data_field("reads", 1), self.reads);
    visit(data_field("read_ray", bits.ray), self.reader);
    visit(data_field("number", triangle_number_bits), self.number);
    visit(data_field("tested", 1), self.tested);
    visit(data_field("hit", 1), self.hit);
    visit(data_field("asked", bits.ray), self.asked);
    visit(data_field("done", 1), self.done);
    visit(data_field("t", bits.distance()), self.t);
    visit(data_field("closer", 1), self.closer);
  }
};

template <class Memory>
struct Memories {
  TriangleMemories<Memory> queue;
  Memory instructions;
  Memory words_0, words_1;  ///< equal, since an instruction reads two words

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const CoreBits bits = format;
    TriangleMemories<Memory>::for_each(bits, self.queue, visit);
    visit(MemoryShape{"instructions", program::most_instructions, program::instruction_bits, MemoryKind::rom,
                      program::program.instructions.data()},
          self.instructions);
    const auto words = [&](const char* name, Memory& of) {
      visit(MemoryShape{name, power_of_two(program::place_bits), word_width(bits), MemoryKind::block}, of);
    };
    words("words_0", self.words_0);
    words("words_1", self.words_1);
  }
};

struct SerialTriangle {
  static constexpr const char* name = "serial_triangle";
  static constexpr const char* summary = "tests triangles with one multiplier, for small chips";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = CoreBits;
  using BuiltIn = FormatList<CoreFormat<20, 1, 20, 0, 0, 5>>;
  template <class D, class F>
  using State = serial_triangle::State<D, F>;
  template <class D, class F>
  using Inputs = serial_triangle::Inputs<D, F>;
  template <class D, class F>
  using Outputs = serial_triangle::Outputs<D, F>;
  template <class Memory>
  using Memories = serial_triangle::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& format, const State<D, F>& state,
                                         Memories<Memory>& memories) {
    return {state.queue.reads, state.queue.reader, state.queue.number,
            state.tested,      state.hit,          memories.queue.rays.word(format.ray),
            state.answers,     state.quotient,     state.closer};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto& code = state.code_3;
    const auto triangle = TriangleQueue<D, F>::oldest(format, memories.queue);

    // Does the test go on?
    const Bit negative = sign(state.sum);
    const Bit same = as("same_sign", ~(negative ^ Bit(sign(state.det))));
    const Bit is_zero = as("is_zero", ~any<D>(state.sum));
    const Bit misses =
        as("misses", state.multiplied & ((has<D, program::checks_det>(code) & is_zero) |
                                         (has<D, program::checks_same>(code) & ~(same | is_zero)) |
                                         (has<D, program::checks_other>(code) & same & ~is_zero) |
                                         (has<D, program::checks_num>(code) & negative)));
    const Bit hits = as("hits", state.multiplied & has<D, program::checks_num>(code) & ~negative);
    const Bit ends = as("ends", misses | hits);
    const Bit leaves = as("leaves", (state.tested & ~state.hit) | state.answers);

    store<D>(format, state, memories);
    const Bit divides = as("divides", any<D>(state.left));
    const auto sum = as("sum_next", next_sum<D>(format, state, hits, divides, same, triangle.back_m));
    state.closer = Bit(cat(state.quotient, in.number) < cat(in.best, in.best_number));
    state.quotient = next_quotient<D>(format, state, hits, divides, sum);
    state.answers = state.compares;
    state.compares = as("last", Bit(state.left == D::lit(1, left_width(format))));
    state.left = select(hits, D::lit(format.distance(), left_width(format)),
                        resize(as_unsigned(state.left - divides), left_width(format)));
    state.det = select(Bit(state.multiplied & has<D, program::checks_det>(code)),
                       as_signed(slice(state.sum, format.determinant() - 1_w, 0_w)), state.det);
    state.sum = sum;
    state.product = product_of<D>(format, state.code_2, triangle, memories);

    fetch(format, state, as("begins", state.queue.ready & ~state.works), ends, memories);
    state.tested = ends;
    state.hit = hits;
    state.works = (state.queue.ready & ~state.works) | (state.works & ~leaves);
    state.queue.step(format, in.triangle, leaves, memories.queue);
  }

 private:
  template <class D, program::Flag Flag, class Code>
  static constexpr typename D::bit has(const Code& code) {
    return bit_at(code, Width<int{Flag}>());
  }
  template <int At, int Bits, class Code>
  static constexpr auto part_of(const Code& code) {
    return slice(code, Width<At + Bits - 1>(), Width<At>());
  }

  /// The next instruction, and the words of the one that has come.
  template <class F, class State, class Bit, class Memory>
  static constexpr void fetch(const F& format, State& state, const Bit& begins, const Bit& ends,
                              Memories<Memory>& memories) {
    const auto place_bits = width_of(state.place);
    const auto instruction = memories.instructions.word(Widths<F>::instruction_of(format));
    memories.instructions.ask(state.place);
    state.place = resize(state.place + state.fetches, place_bits) & spread(state.fetches, place_bits);
    state.multiplied = state.reads_words & ~ends;
    state.reads_words = state.fetched & ~ends;
    state.fetched = state.fetches & ~ends;
    state.fetches = begins | (state.fetches & ~ends);
    state.code_3 = state.code_2;
    state.code_2 = instruction;
    memories.words_0.ask(part_of<program::first_place, program::place_bits>(instruction));
    memories.words_1.ask(part_of<program::second_place, program::place_bits>(instruction));
  }

  /// |num| 2^(S+F), if it is a hit.
  template <class D, class F>
  static constexpr auto dividend(const F& format, const State<D, F>& state) {
    return cat(slice(state.sum, format.volume() - 2_w, 0_w), D::lit(0, format.slope + format.fraction));
  }

  /// The accumulator: a sum; or twice the remainder, with |det| taken away or added.
  template <class D, class F, class Bit>
  static constexpr auto next_sum(const F& format, const State<D, F>& state, const Bit& hits,
                                 const Bit& divides, const Bit& same, const Bit& back_m) {
    const auto& code = state.code_3;
    const auto bits = sum_width(format);
    const auto quotient_bits = format.distance();
    const auto word = word_width(format);
    const auto whole = dividend<D>(format, state);
    const auto remainder =
        resize(as_signed(cat(D::lit(0, 1_w), slice(whole, width_of(whole) - 1_w, quotient_bits))), bits);
    const auto digit = either(
        brings_down(format), state.quotient, [&](const auto& q) { return bit_at(q, quotient_bits - 1_w); },
        [&](const auto&) { return D::lit(0, 1_w); });
    const auto raised = cat(slice(state.sum, bits - word, 0_w), D::lit(0, word - 1_w));
    const auto doubled = cat(slice(state.sum, bits - 2_w, 0_w), digit);
    const auto moved =
        select(divides, doubled, select(has<D, program::raises>(code), raised, as_unsigned(state.sum)));
    const Bit drops = as("drops", has<D, program::begins>(code) & ~divides);
    const auto base = select(hits, as_unsigned(remainder), moved) & spread(Bit(~drops), bits);
    const auto change = as("change", select(divides, resize(state.det, bits), resize(state.product, bits)));
    // num is made positive if it is a hit's: det's sign, the other one if the direction is negative.
    const Bit turns = has<D, program::turns>(code) & ~(Bit(sign(state.det)) ^ back_m);
    const Bit minus = as("minus", select(divides, same, Bit(has<D, program::subtracts>(code) ^ turns)));
    const auto sum =
        as_signed(cat(base, D::lit(1, 1_w))) + as_signed(cat(change ^ as_signed(spread(minus, bits)), minus));
    return as_signed(slice(sum, bits, 1_w));
  }
  /// The low bits of the dividend enter the remainder; else they are 0.
  template <class F>
  static constexpr auto brings_down(const F& format) {
    return format.slope + format.fraction < format.distance();
  }
  template <class D, class F, class Bit, class Sum>
  static constexpr auto next_quotient(const F& format, const State<D, F>& state, const Bit& hits,
                                      const Bit& divides, const Sum& remainder) {
    const auto bits = format.distance();
    const auto longer = cat(slice(state.quotient, bits - 2_w, 0_w), Bit(~Bit(sign(remainder))));
    return change_if(brings_down(format), select(divides, longer, state.quotient), [&](const auto& q) {
      return select(hits, slice(dividend<D>(format, state), bits - 1_w, 0_w), q);
    });
  }

  /// What an instruction adds: a product of two words, or a word from outside.
  template <class D, class F, class Code, class Triangle, class Memory>
  static constexpr auto product_of(const F& format, const Code& code, const Triangle& triangle,
                                   Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto word = word_width(format);
    const auto source = part_of<program::first_place, program::source_bits>(code);
    const auto axis = part_of<program::first_place + program::source_bits, 2>(code);
    const Bit is_a = as("is_a", bit_at(axis, 0_w));
    const Bit is_b = as("is_b", bit_at(axis, 1_w));
    const Bit is_m = as("is_m", ~(is_a | is_b));
    // A ray axis and the major axis trade places.
    const Bit is_y = as("is_y", (is_m & triangle.major_y) | (is_a & ~triangle.major_y));
    const Bit is_z = as("is_z", (is_m & triangle.major_z) | (is_b & ~triangle.major_z));
    const auto coordinate = [&](const auto& x, const auto& y, const auto& z) {
      return select(is_z, z, select(is_y, y, x));
    };
    const auto by_ray_axis = [&](const auto& m, const auto& a, const auto& b) {
      return select(is_b, b, select(is_a, a, m));
    };
    const auto coarse =
        as("coordinate", select(bit_at(source, 1_w),
                                select(bit_at(source, 0_w), coordinate(triangle.x2, triangle.y2, triangle.z2),
                                       coordinate(triangle.x1, triangle.y1, triangle.z1)),
                                coordinate(triangle.x0, triangle.y0, triangle.z0)));
    const auto corner = change_if(0_w < format.finer, resize(coarse, format.point()), [&](const auto& x) {
      return select(has<D, program::fine>(code), as_signed(cat(coarse, D::lit(0, format.finer))), x);
    });
    const auto origin = by_ray_axis(triangle.origin_m, triangle.origin_a, triangle.origin_b);
    const auto one = as_signed(cat(D::lit(1, 2_w), D::lit(0, format.slope)));
    const auto direction = by_ray_axis(one, triangle.slope_a, triangle.slope_b);
    const auto outside = select(bit_at(source, 2_w),
                                select(bit_at(source, 0_w), resize(direction, word), resize(origin, word)),
                                resize(corner, word));
    const auto loaded = as("loaded", as_unsigned(outside) & spread(any<D>(source), word));
    const auto product =
        as("words_product", as_signed(memories.words_0.word(word)) * as_signed(memories.words_1.word(word)));
    return as("term",
              select(has<D, program::multiplies>(code), product, resize(as_signed(loaded), word * 2_w)));
  }

  template <class D, class F, class Memory>
  static constexpr void store(const F& format, const State<D, F>& state, Memories<Memory>& memories) {
    using Bit = typename D::bit;
    const auto& code = state.code_3;
    const auto word = word_width(format);
    const auto low = slice(state.sum, word - 2_w, 0_w);
    const Bit top = Bit(bit_at(state.sum, word - 1_w)) & ~has<D, program::stores_low>(code);
    const auto above = as_signed(slice(state.sum, sum_width(format) - 1_w, word - 1_w));
    const auto stored = as("stored", select(has<D, program::stores_high>(code),
                                            as_unsigned(resize(above, word)), cat(top, low)));
    const Bit stores = as("stores", state.multiplied & has<D, program::stores>(code));
    const auto place = part_of<program::stored_place, program::place_bits>(code);
    memories.words_0.write(stores, place, stored);
    memories.words_1.write(stores, place, stored);
  }
};

}  // namespace serial_triangle

using serial_triangle::SerialTriangle;

}  // namespace hls
}  // namespace hitpipe
