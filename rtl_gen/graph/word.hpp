// The bits of a graph's value, at most 128, and what is asked of them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace hitpipe::rtl {

inline constexpr int most_value_bits = 128;
/// A port is read and written by programs in 64 bits.
inline constexpr int most_port_bits = 64;

__extension__ using Word = unsigned __int128;
/// A word that is read as two's complement.
__extension__ using Number = __int128;

/// The same for a word of either size.
template <class W>
using SignedWord = std::conditional_t<sizeof(W) == sizeof(Word), Number, std::int64_t>;

/// A word whose low `width` bits are 1, 0 <= width <= the word's own.
template <class W = Word>
[[nodiscard]] constexpr W ones_below(int width) {
  return width == 0 ? W{0} : static_cast<W>(~W{0} >> (8 * static_cast<int>(sizeof(W)) - width));
}

/// The low `width` bits as two's complement, 1 <= width <= the word's own.
template <class W>
[[nodiscard]] constexpr SignedWord<W> number_of(W word, int width) {
  const int above = 8 * static_cast<int>(sizeof(W)) - width;
  return static_cast<SignedWord<W>>(word << above) >> above;
}

/// Bits high..low are 1.
[[nodiscard]] constexpr Word bit_range(int high, int low) {
  return ones_below(high + 1) & ~ones_below(low);
}

[[nodiscard]] constexpr std::uint64_t upper_half(Word word) {
  return static_cast<std::uint64_t>(word >> 64);
}
[[nodiscard]] constexpr std::uint64_t lower_half(Word word) {
  return static_cast<std::uint64_t>(word);
}

/// The place above the highest 1; 0 if there is none.
[[nodiscard]] constexpr int width_of_bits(Word word) {
  return upper_half(word) != 0 ? 128 - std::countl_zero(upper_half(word))
                               : 64 - std::countl_zero(lower_half(word));
}

/// How many of the lowest bits are 0, or are 1.
[[nodiscard]] constexpr int low_zeros(Word word) {
  return lower_half(word) != 0 ? std::countr_zero(lower_half(word)) : 64 + std::countr_zero(upper_half(word));
}
[[nodiscard]] constexpr int low_ones(Word word) {
  return low_zeros(~word);
}

[[nodiscard]] constexpr int count_of_ones(Word word) {
  return std::popcount(upper_half(word)) + std::popcount(lower_half(word));
}

/// Calls visit(high, low) for each run of adjacent 1s, from the low bits up.
template <class Visit>
constexpr void for_each_run(Word bits, Visit&& visit) {
  while (bits != 0) {
    const int low = low_zeros(bits);
    const int high = low + low_ones(bits >> low) - 1;
    visit(high, low);
    bits &= ~bit_range(high, low);
  }
}

}  // namespace hitpipe::rtl
