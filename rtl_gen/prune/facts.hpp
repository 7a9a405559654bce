// What is known of a value whatever the operands are, as long as they are as demanded: bits that are always
// 0 or always 1, and the interval of its number as two's complement. Each sharpens the other.
#pragma once

#include <cstdint>

#include "rtl_gen/prune/demands.hpp"

namespace hitpipe::rtl {

/// Holds what 64-bit operands make, before it is known to fit.
__extension__ using Wide = __int128;

/// The bits of a value of this width, 0 to 64.
[[nodiscard]] constexpr std::uint64_t all_bits(int width) {
  return width == 0 ? 0 : ~std::uint64_t{0} >> (64 - width);
}
/// A pattern as a two's complement number.
[[nodiscard]] constexpr std::int64_t number_of(std::uint64_t pattern, int width) {
  return static_cast<std::int64_t>(pattern << (64 - width)) >> (64 - width);
}

/// A value's patterns read without a sign.
struct Patterns {
  std::uint64_t low;
  std::uint64_t high;
};

class Facts {
 public:
  /// Of a value of which nothing is known.
  [[nodiscard]] static Facts nothing(int width);
  [[nodiscard]] static Facts constant(int width, std::uint64_t pattern);
  /// Numbers as two's complement; nothing when they do not fit into the width.
  [[nodiscard]] static Facts number(int width, Wide low, Wide high);
  [[nodiscard]] static Facts patterns(int width, Patterns patterns);
  [[nodiscard]] static Facts bits(int width, std::uint64_t zeros, std::uint64_t ones);
  /// Of a value that is one of two.
  [[nodiscard]] static Facts either(const Facts& a, const Facts& b);
  /// Of a value of which both hold.
  [[nodiscard]] static Facts both(const Facts& a, const Facts& b);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] std::uint64_t zeros() const { return zeros_; }
  [[nodiscard]] std::uint64_t ones() const { return ones_; }
  [[nodiscard]] Interval number() const { return number_; }
  [[nodiscard]] Patterns patterns() const;
  [[nodiscard]] bool is_constant() const { return number_.low == number_.high; }
  /// Of a constant.
  [[nodiscard]] std::uint64_t pattern() const {
    return static_cast<std::uint64_t>(number_.low) & all_bits(width_);
  }
  /// Bits that hold the number as two's complement: the others repeat the highest of them.
  [[nodiscard]] int signed_width() const;
  /// Bits below the topmost ones that are known.
  [[nodiscard]] int unknown_width() const;
  /// The lowest bits that are known, and those that are 0.
  [[nodiscard]] int known_low() const;
  [[nodiscard]] int low_zeros() const;

 private:
  Facts(int width, std::uint64_t zeros, std::uint64_t ones, Interval number);
  void sharpen();

  int width_;
  std::uint64_t zeros_;
  std::uint64_t ones_;
  Interval number_;
};

}  // namespace hitpipe::rtl
