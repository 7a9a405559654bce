// Bits, ranges and concatenations, read and written in place, and the reductions, against exact bit patterns.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_parts_test {
namespace {

using exact::Integer;
using exact::Row;

bool bit_of(const Integer& bits, int i) {
  return bit_test(bits, static_cast<unsigned>(i));
}

int ones_in(const Integer& bits, int width) {
  int ones = 0;
  for (int i = 0; i < width; ++i) ones += bit_of(bits, i) ? 1 : 0;
  return ones;
}

/// Two bit indices, i <= j.
exact::Choice indices(const exact::Type& type, std::mt19937_64& random) {
  const auto width = static_cast<unsigned>(type.width);
  const int first = static_cast<int>(random() % width);
  const int second = static_cast<int>(random() % width);
  return {0, std::min(first, second), std::max(first, second)};
}

TEST(ApIntBit, IsReadByEveryName) {
  exact::Run run(41);
  const auto read = [](auto a, const exact::Choice& choice) -> bool {
    const auto& constant = a;
    switch (choice.variant) {
      case 0:
        return a[choice.i];
      case 1:
        return constant[choice.i];
      case 2:
        return a.bit(choice.i);
      case 3:
        return constant.bit(choice.i);
      case 4:
        return a.test(choice.i);
      default:
        return a.get_bit(choice.i);
    }
  };
  run.check_choices({"[i]", "const [i]", "bit(i)", "const bit(i)", "test", "get_bit"},
                    exact::rows_of_choice(read), indices,
                    [](const Row& row, const Integer& a, const exact::Choice& choice) {
                      return Integer(bit_of(exact::pattern(a, row.a.width), choice.i));
                    });
  run.finish(6 * exact::choice_row_count * exact::values_per_row);
}

TEST(ApIntBit, IsWrittenInPlace) {
  exact::Run run(42);
  const auto write = [](auto a, const exact::Choice& choice) {
    const int i = choice.i;
    switch (choice.variant) {
      case 0:
        a[i] = 1;
        break;
      case 1:
        a[i] = ap_int<9>(-256);
        break;
      case 2:
        a.set_bit(i, true);
        break;
      case 3:
        a.set(i);
        break;
      case 4:
        a.bit(i) = false;
        break;
      case 5:
        a.set(i, false);
        break;
      case 6:
        a.clear(i);
        break;
      case 7:
        a.bit(i) = ~a[i];
        break;
      default:
        a.invert(i);
        break;
    }
    return a;
  };
  run.check_choices({"[i] = 1", "[i] = word", "set_bit", "set", "bit(i) = 0", "set(i, 0)", "clear",
                     "bit(i) = ~[i]", "invert"},
                    exact::rows_of_choice(write), indices,
                    [](const Row& row, const Integer& a, const exact::Choice& choice) {
                      const Integer bits = exact::pattern(a, row.a.width);
                      const bool old = bit_of(bits, choice.i);
                      const Integer one = exact::power_of_two(choice.i);
                      const Integer cleared = old ? Integer(bits - one) : bits;
                      const bool on = choice.variant < 4 || (choice.variant >= 7 && !old);
                      return exact::wrapped(on ? Integer(cleared + one) : cleared, row.a.width,
                                            row.a.is_signed);
                    });
  run.finish(9 * exact::choice_row_count * exact::values_per_row);
}

TEST(ApIntBit, IsCopiedByValueFromAnotherBit) {
  ap_uint<4> from = 0b1000;
  ap_uint<4> to = 0;
  to[0] = from[3];
  from[3] = 0;
  EXPECT_EQ(to, 1);
  EXPECT_EQ(from, 0);
}

/// Bits j..i of a value.
Integer part(const Row& row, const Integer& a, const exact::Choice& choice) {
  const Integer bits = exact::pattern(a, row.a.width);
  return exact::pattern(bits >> static_cast<unsigned>(choice.i), choice.j - choice.i + 1);
}

TEST(ApIntRange, IsReadAndReduced) {
  exact::Run run(43);
  const auto read = [](auto a, const exact::Choice& choice) -> ap_int<130> {
    const auto& constant = a;
    const int hi = choice.j;
    const int lo = choice.i;
    switch (choice.variant) {
      case 0:
        return a.range(hi, lo);
      case 1:
        return constant.range(hi, lo);
      case 2:
        return a(hi, lo);
      case 3:
        return constant(hi, lo);
      case 4:
        return a(hi, lo).length();
      case 5:
        return a(hi, lo).and_reduce();
      case 6:
        return a(hi, lo).or_reduce();
      case 7:
        return a(hi, lo).xor_reduce();
      default:
        return a(hi, lo).to_uint64();
    }
  };
  run.check_choices({"range", "const range", "(hi, lo)", "const (hi, lo)", "length", "and_reduce",
                     "or_reduce", "xor_reduce", "to_uint64"},
                    exact::rows_of_choice(read), indices,
                    [](const Row& row, const Integer& a, const exact::Choice& choice) {
                      const Integer bits = part(row, a, choice);
                      const int length = choice.j - choice.i + 1;
                      switch (choice.variant) {
                        case 4:
                          return Integer(length);
                        case 5:
                          return Integer(ones_in(bits, length) == length);
                        case 6:
                          return Integer(bits != 0);
                        case 7:
                          return Integer(ones_in(bits, length) % 2);
                        case 8:
                          return exact::pattern(bits, 64);
                        default:
                          return bits;
                      }
                    });
  run.finish(9 * exact::choice_row_count * exact::values_per_row);
}

TEST(ApIntRange, IsWrittenInPlace) {
  exact::Run run(44);
  const auto write = [](auto a, const exact::Choice& choice) {
    if (choice.variant == 0) {
      const auto high = ap_int<130>(-0x123456789abcdef0) << 64;
      a.range(choice.j, choice.i) = high - ap_uint<64>(0xfedcba987654321f);
    } else {
      const auto old = a;
      a(choice.j - choice.i, 0) = old(choice.j, choice.i);
    }
    return a;
  };
  const Integer word("-0x123456789abcdef0fedcba987654321f");
  run.check_choices({"range = word", "range = another range"}, exact::rows_of_choice(write), indices,
                    [&word](const Row& row, const Integer& a, const exact::Choice& choice) {
                      const Integer bits = exact::pattern(a, row.a.width);
                      const int length = choice.j - choice.i + 1;
                      const auto lo = static_cast<unsigned>(choice.i);
                      const Integer kept = choice.variant == 0 ? Integer(bits - (part(row, a, choice) << lo))
                                                               : Integer(bits - exact::pattern(bits, length));
                      const Integer moved = choice.variant == 0 ? Integer(exact::pattern(word, length) << lo)
                                                                : part(row, a, choice);
                      return exact::wrapped(kept + moved, row.a.width, row.a.is_signed);
                    });
  run.finish(2 * exact::choice_row_count * exact::values_per_row);
}

TEST(ApIntRange, OfATemporaryHoldsACopy) {
  const auto copy = (ap_uint<8>(0x70) + ap_uint<8>(0x35)).range(7, 4);
  EXPECT_EQ(copy, 0xa);
}

TEST(ApIntReduction, CoversEveryBitAndNoMore) {
  exact::Run run(45);
  const auto reduce = [](const auto& a, const exact::Choice& choice) -> int {
    switch (choice.variant) {
      case 0:
        return a.and_reduce();
      case 1:
        return a.or_reduce();
      case 2:
        return a.xor_reduce();
      case 3:
        return a.is_zero();
      default:
        return a.length();
    }
  };
  run.check_choices({"and_reduce", "or_reduce", "xor_reduce", "is_zero", "length"},
                    exact::rows_of_choice(reduce), indices,
                    [](const Row& row, const Integer& a, const exact::Choice& choice) {
                      const int ones = ones_in(exact::pattern(a, row.a.width), row.a.width);
                      switch (choice.variant) {
                        case 0:
                          return Integer(ones == row.a.width);
                        case 1:
                          return Integer(ones != 0);
                        case 2:
                          return Integer(ones % 2);
                        case 3:
                          return Integer(ones == 0);
                        default:
                          return Integer(row.a.width);
                      }
                    });
  run.finish(5 * exact::choice_row_count * exact::values_per_row);
}

TEST(ApIntConcatenation, PutsTheLeftAboveTheRight) {
  exact::Run run(46);
  const auto both = [](const Row& row, const Integer& a, const Integer& b) {
    const Integer high = exact::pattern(a, row.a.width) << static_cast<unsigned>(row.b.width);
    return Integer(high + exact::pattern(b, row.b.width));
  };
  run.check("(a, b)", exact::crossed_rows([](const auto& a, const auto& b) { return (a, b).value(); }), both);
  run.check("concat", exact::crossed_rows([](const auto& a, const auto& b) { return a.concat(b).value(); }),
            both);
  run.finish(2 * exact::crossed_row_count * exact::pairs_per_row);
}

TEST(ApIntConcatenation, IsWrittenToBothSides) {
  exact::Run run(47);
  // (a, b) after its own value with all bits flipped was written to it.
  run.check("(a, b) = ~(a, b), left", exact::crossed_rows([](auto a, auto b) {
              (a, b) = ~(a, b);
              return a;
            }),
            [](const Row& row, const Integer& a, const Integer&) {
              return exact::wrapped(-a - 1, row.a.width, row.a.is_signed);
            });
  run.check("(a, b) = ~(a, b), right", exact::crossed_rows([](auto a, auto b) {
              (a, b) = ~(a, b);
              return b;
            }),
            [](const Row& row, const Integer&, const Integer& b) {
              return exact::wrapped(-b - 1, row.b.width, row.b.is_signed);
            });
  run.finish(2 * exact::crossed_row_count * exact::pairs_per_row);
}

TEST(ApIntConcatenation, NestsAndTakesBitsRangesAndCppIntegers) {
  ap_uint<8> a = 0xa5;
  ap_int<4> b = -2;
  ap_uint<1> c = 1;
  EXPECT_EQ((a, b, c), 0x14bd);
  EXPECT_EQ((a(3, 0), b), 0x5e);
  EXPECT_EQ((a[7], c, b), 0x3e);
  EXPECT_EQ((c, true), 3);
  EXPECT_EQ((true, c), 3);
  EXPECT_EQ((static_cast<signed char>(-1), c), 0x1ff);
  (a, b, c) = 0x0a46;
  EXPECT_EQ(a, 0x52);
  EXPECT_EQ(b, 3);
  EXPECT_EQ(c, 0);
  (a[0], b) = 0x18;
  EXPECT_EQ(a, 0x53);
  EXPECT_EQ(b, -8);
  (a[0], b) = 0x23;
  EXPECT_EQ(a, 0x52);
  (a(7, 4), b) = 0xc7;
  EXPECT_EQ(a, 0xc2);
  EXPECT_EQ(b, 7);
  a.concat(b) = 0x123;
  EXPECT_EQ(a, 0x12);
  EXPECT_EQ(b, 3);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_parts_test
