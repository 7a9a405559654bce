// The program of the serial triangle test (docs/core.md): int_triangle's formulas as sums of products of two
// words. The machine serial_triangle has an accumulator, one multiplier, and a memory of words. An
// instruction adds a product, or a word of the triangle or the ray, to the accumulator. It may also store
// what the accumulator held before, or compare it with 0. With the corners v0, v1, v2 and the origin o,
//   E1 = v1 - v0, E2 = v2 - v0, q = 2^g v0 - o, r = 2^g v1 - o, P = D x E2, C = q x E1
//   det = E1 . P, u = q . P, v = D . C, e0 = 2^g det + u + v = r . P + D . C, num = E2 . C
// P and C have two words, a low and a high one.
#pragma once

#include <array>
#include <cstdint>

namespace hitpipe {
namespace hls {
namespace triangle_program {

/// Parts of an instruction, from its lowest bit on. An instruction of zeros changes nothing.
constexpr int place_bits = 5;
/// Places of the two words that are multiplied. If an instruction does not multiply, the first place is a
/// Source in the low bits, and a ray axis above them.
constexpr int first_place = 0, second_place = first_place + place_bits;
constexpr int source_bits = 3;
/// The place of a stored word.
constexpr int stored_place = second_place + place_bits;
/// Flags, a bit each.
enum Flag {
  multiplies = stored_place + place_bits,
  begins,        ///< the sum begins with 0, not with what the accumulator holds
  raises,        ///< what it holds is shifted by a low word first
  subtracts,     ///< instead of adding
  turns,         ///< num's products: they change their sign if num would be negative
  fine,          ///< of a corner: 2^g times its coordinate
  stores,        ///< a word is stored
  stores_low,    ///< the low one of two words
  stores_high,   ///< the one above it
  checks_det,    ///< goes on if the accumulator is not 0, and keeps it as det
  checks_same,   ///< goes on if the accumulator is 0 or has the sign of det
  checks_other,  ///< goes on if it is 0 or has the other sign
  checks_num,    ///< goes on if it is at least 0; then the program has ended with a hit
  instruction_bits
};

/// A word from outside. Corners are 1, 2 and 3.
enum Source { nothing, corner_0, corner_1, corner_2, origin, direction };

/// Places of the words of a vector, one for each ray axis.
enum Vector { of_e1 = 0, of_e2 = 3, of_q = 6, of_r = 9, of_d = 12, of_p = 15, of_c = 21, words = 27 };
/// From the low words of P and C to the high ones.
constexpr int to_high = 3;

constexpr int most_instructions = 128;

struct Program {
  std::array<std::uint32_t, most_instructions> instructions{};
  int length = 0;
};

class Assembler {
 public:
  constexpr void load(Source source, int axis, bool minus = false, bool is_fine = false) {
    add(flag(fine, is_fine) | flag(subtracts, minus) | static_cast<std::uint32_t>(source) << first_place |
        static_cast<std::uint32_t>(axis) << (first_place + source_bits));
  }
  /// A stored word is there three instructions later.
  constexpr void product(int a, int b, std::uint32_t flags = 0) {
    while (place() < there_[static_cast<std::size_t>(a)] || place() < there_[static_cast<std::size_t>(b)])
      wait();
    add(flag(multiplies) | flags | static_cast<std::uint32_t>(a) << first_place |
        static_cast<std::uint32_t>(b) << second_place);
  }
  /// The next term begins a sum.
  constexpr void begin() { next_ |= flag(begins); }

  /// A sum of one word.
  constexpr void store(int to) { keep(to); }
  /// A sum of two words. The accumulator must hold it until both are stored.
  constexpr void store_wide(int low) {
    keep(low, flag(stores_low));
    wait();
    keep(low + to_high, flag(stores_high));
  }
  constexpr void check(Flag what) { next_ |= flag(what); }
  /// An instruction that only does what is due.
  constexpr void wait() {
    const std::uint32_t later = next_ & flag(begins);
    next_ &= ~later;
    add(0);
    next_ = later;
  }

  /// to = a x b, of vectors with one word an axis.
  constexpr void cross(int to, int a, int b) {
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      begin();
      product(a + next, b + last);
      product(a + last, b + next, flag(subtracts));
      store_wide(to + axis);
    }
  }
  /// The low or the high words of a . b, where b has two words an axis.
  constexpr void dot_part(int a, int b, std::uint32_t flags = 0) {
    for (int axis = 0; axis < 3; ++axis) {
      product(a + axis, b + axis, flags);
      flags &= ~flag(raises);
    }
  }
  constexpr void dot(int a, int b, std::uint32_t flags = 0) {
    begin();
    dot_part(a, b + to_high, flags);
    dot_part(a, b, flags | flag(raises));
  }
  /// to = corner - what is taken away.
  constexpr void difference(int to, Source corner, Source taken, bool is_fine) {
    for (int axis = 0; axis < 3; ++axis) {
      begin();
      load(corner, axis, false, is_fine);
      load(taken, axis, true);
      store(to + axis);
    }
  }

  static constexpr std::uint32_t flag(Flag what, bool is = true) { return std::uint32_t{is} << what; }
  [[nodiscard]] constexpr Program program() const { return program_; }

 private:
  [[nodiscard]] constexpr int place() const { return program_.length; }
  constexpr void add(std::uint32_t instruction) {
    program_.instructions[static_cast<std::size_t>(program_.length++)] = instruction | next_;
    next_ = 0;
  }
  constexpr void keep(int to, std::uint32_t which = 0) {
    next_ |= flag(stores) | which | static_cast<std::uint32_t>(to) << stored_place;
    there_[static_cast<std::size_t>(to)] = place() + 3;
  }

  Program program_{};
  std::uint32_t next_ = 0;  ///< what the next instruction does besides its own
  std::array<int, 1 << place_bits> there_{};
};

/// In the order in which most tests end early.
constexpr Program assembled() {
  Assembler made;
  for (int axis = 0; axis < 3; ++axis) {
    made.begin();
    made.load(direction, axis);
    made.store(of_d + axis);
  }
  made.difference(of_e2, corner_2, corner_0, false);
  made.difference(of_e1, corner_1, corner_0, false);
  made.cross(of_p, of_d, of_e2);
  made.dot(of_e1, of_p);
  made.check(checks_det);
  made.difference(of_q, corner_0, origin, true);
  made.dot(of_q, of_p);
  made.check(checks_other);
  made.cross(of_c, of_q, of_e1);
  made.dot(of_d, of_c);
  made.check(checks_other);
  made.difference(of_r, corner_1, origin, true);
  made.begin();
  made.dot_part(of_r, of_p + to_high);
  made.dot_part(of_d, of_c + to_high);
  made.dot_part(of_r, of_p, Assembler::flag(raises));
  made.dot_part(of_d, of_c);
  made.check(checks_same);
  made.dot(of_e2, of_c, Assembler::flag(turns));
  made.check(checks_num);
  made.wait();
  return made.program();
}
inline constexpr Program program = assembled();

}  // namespace triangle_program
}  // namespace hls
}  // namespace hitpipe
