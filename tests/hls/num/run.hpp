// The operands of the ap_int tests, and a Run. A Run applies rows (exact.hpp) to corner and random operands,
// compares with exact integers, counts what it checked, and prints a failing result with its types, operands
// in hex and seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/hls/num/exact.hpp"

namespace hitpipe::hls::exact {

/// Where operators break: zero, one, all ones, both ends of either sign, one past an end, alternating bits.
inline std::vector<Integer> corners(const Type& t) {
  const Integer half = power_of_two(t.width - 1);
  const Integer alternating = (power_of_two(2 * ((t.width + 1) / 2)) - 1) / 3;
  std::vector<Integer> values;
  for (const Integer& bits : {Integer(0), Integer(1), Integer(-1), half, Integer(half - 1), Integer(half + 1),
                              Integer(-2), alternating}) {
    values.push_back(wrapped(bits, t.width, t.is_signed));
  }
  return values;
}

inline constexpr std::size_t corner_count = 8;
inline constexpr std::size_t random_count = 36;
inline constexpr std::size_t values_per_row = corner_count + random_count;
inline constexpr std::size_t pairs_per_row = corner_count * corner_count + random_count;

/// Random values of every magnitude: a random number of random low bits, or its complement.
inline Integer random_value(const Type& t, std::mt19937_64& random) {
  const int used = 1 + static_cast<int>(random() % static_cast<unsigned>(t.width));
  Integer bits = 0;
  for (int done = 0; done < used; done += 64) bits = (bits << 64) | random();
  bits = pattern(bits, used);
  return wrapped(random() % 2 == 0 ? bits : Integer(-bits - 1), t.width, t.is_signed);
}

/// The vectors of one test. Prints the seed, checks, and ends with finish().
class Run {
 public:
  explicit Run(std::uint64_t seed) : seed_(seed), random_(seed) { std::cout << "seed " << seed << '\n'; }

  std::mt19937_64& random() { return random_; }

  /// Every row on corner and random pairs; expected(row, a, b) is the exact result.
  template <class Expected>
  void check(const char* operation, const std::vector<Row>& rows, Expected expected) {
    for (const Row& row : rows) {
      for (const Integer& a : corners(row.a)) {
        for (const Integer& b : corners(row.b)) check_one(operation, row, a, b, expected(row, a, b));
      }
      for (std::size_t i = 0; i < random_count; ++i) {
        // Named, because the compiler chooses the order in which arguments are evaluated.
        const Integer a = random_value(row.a, random_);
        const Integer b = random_value(row.b, random_);
        check_one(operation, row, a, b, expected(row, a, b));
      }
    }
  }

  /// Rows of one operand; expected(row, a) is exact.
  template <class Expected>
  void check_one_operand(const char* operation, const std::vector<Row>& rows, Expected expected) {
    for (const Row& row : rows) {
      for (const Integer& a : values(row.a)) check_one(operation, row, a, 0, expected(row, a));
    }
  }

  /// Rows of a Choice, for each variant; arguments(type) chooses one, and expected(row, a, choice) is exact.
  template <class Arguments, class Expected>
  void check_choices(const std::vector<const char*>& variants, const std::vector<Row>& rows,
                     Arguments arguments, Expected expected) {
    for (const Row& row : rows) {
      for (std::size_t v = 0; v < variants.size(); ++v) {
        for (const Integer& a : values(row.a)) {
          Choice choice = arguments(row.a, random_);
          choice.variant = static_cast<int>(v);
          check_one(variants[v], row, a, choice.operand(), expected(row, a, choice));
        }
      }
    }
  }

  void check_one(const char* operation, const Row& row, const Integer& a, const Integer& b,
                 const Integer& expected) {
    ++checked_;
    const Integer got = from_raw(row.apply(to_raw(a), to_raw(b)), row.result.is_signed);
    if (got == expected || ++failed_ > 5) return;
    ADD_FAILURE() << operation << " on " << name(row.a) << " and " << name(row.b) << ": a " << hex(a) << " b "
                  << hex(b) << " gives " << hex(got) << ", exactly " << hex(expected) << "; seed " << seed_;
  }

  void finish(std::size_t intended) const {
    EXPECT_EQ(failed_, 0u);
    EXPECT_EQ(checked_, intended);
    std::cout << checked_ << " results checked\n";
  }

 private:
  std::vector<Integer> values(const Type& t) {
    std::vector<Integer> all = corners(t);
    while (all.size() < values_per_row) all.push_back(random_value(t, random_));
    return all;
  }

  static std::string hex(const Integer& x) {
    std::ostringstream text;
    const Raw raw = to_raw(x < 0 ? Integer(-x) : x);
    std::size_t used = raw.size();
    while (used > 1 && raw[used - 1] == 0) --used;
    text << (x < 0 ? "-0x" : "0x") << std::hex << raw[used - 1] << std::setfill('0');
    for (std::size_t i = used - 1; i-- > 0;) text << std::setw(16) << raw[i];
    return text.str();
  }

  std::uint64_t seed_;
  std::mt19937_64 random_;
  std::size_t checked_ = 0;
  std::size_t failed_ = 0;
};

}  // namespace hitpipe::hls::exact
