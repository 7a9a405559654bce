// The host's value domains for widths that are known at run time. A value carries its width, 1 to 64 bits, or
// 1 to 128 in the domain WideSized, which is slower. Results have the bits and widths of ap_int's rules
// (hls/num/ap_operators.hpp), so a format chosen at run time needs no instance of its own.
#pragma once

#include <cassert>
#include <cstdint>

#include "hls/num/bits.hpp"

namespace hitpipe::hls {

__extension__ typedef unsigned __int128 WideWord;

/// An integer of `width` bits, signed or not. The bits of its word above them repeat the sign, or are 0. Word
/// is an unsigned integer.
template <bool S, class Word>
class SizedInt {
 public:
  static constexpr bool is_signed = S;
  static constexpr int most_bits = 8 * sizeof(Word);

  constexpr SizedInt() = default;
  /// The low bits of a word.
  constexpr SizedInt(Word bits, int width) : word_(wrapped(bits, width)), width_(width) {}
  /// The word must be canonical: above the width it has only bits of the sign.
  static constexpr SizedInt exact(Word word, int width) {
    assert(width >= 1 && width <= most_bits);
    SizedInt x;
    x.word_ = word;
    x.width_ = width;
    return x;
  }

  [[nodiscard]] constexpr Word word() const { return word_; }
  [[nodiscard]] constexpr int width() const { return width_; }
  /// The low bits, with zeros above.
  [[nodiscard]] constexpr Word pattern() const { return word_ & ones(width_); }
  /// The low 64 bits.
  [[nodiscard]] constexpr std::int64_t to_int64() const { return static_cast<std::int64_t>(word_); }
  [[nodiscard]] constexpr bool negative() const { return S && word_ >> (most_bits - 1) != 0; }

 private:
  static constexpr Word ones(int width) { return ~Word{0} >> (most_bits - width); }
  static constexpr Word wrapped(Word bits, int width) {
    assert(width >= 1 && width <= most_bits);
    const Word low = bits & ones(width);
    const bool is_negative = S && low >> (width - 1) != 0;
    return is_negative ? low | ~ones(width) : low;
  }

  Word word_ = 0;
  int width_ = 1;
};

template <class Word>
struct SizedDomain {
  using sint = SizedInt<true, Word>;
  using uint = SizedInt<false, Word>;
  using bit = uint;

  static constexpr uint lit(std::int64_t value, int width) { return {static_cast<Word>(value), width}; }
};
using Sized = SizedDomain<std::uint64_t>;
using WideSized = SizedDomain<WideWord>;

/// The width in which both operands are exact.
template <bool S1, bool S2, class Word>
constexpr int common_width(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return max(a.width() + (S2 && !S1 ? 1 : 0), b.width() + (S1 && !S2 ? 1 : 0));
}

template <bool S1, bool S2, class Word>
constexpr SizedInt<(S1 || S2), Word> operator+(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return SizedInt<(S1 || S2), Word>::exact(a.word() + b.word(), common_width(a, b) + 1);
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<true, Word> operator-(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return SizedInt<true, Word>::exact(a.word() - b.word(), common_width(a, b) + 1);
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<(S1 || S2), Word> operator*(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return SizedInt<(S1 || S2), Word>::exact(a.word() * b.word(), a.width() + b.width());
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<(S1 || S2), Word> operator&(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return SizedInt<(S1 || S2), Word>::exact(a.word() & b.word(), common_width(a, b));
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<(S1 || S2), Word> operator|(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return SizedInt<(S1 || S2), Word>::exact(a.word() | b.word(), common_width(a, b));
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<(S1 || S2), Word> operator^(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return SizedInt<(S1 || S2), Word>::exact(a.word() ^ b.word(), common_width(a, b));
}
template <bool S, class Word>
constexpr SizedInt<S, Word> operator~(const SizedInt<S, Word>& a) {
  return {~a.word(), a.width()};
}

template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> operator<(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  // Of equal signs, the words of two's complement compare as the numbers do.
  const bool less = a.negative() == b.negative() ? a.word() < b.word() : a.negative();
  return SizedInt<false, Word>::exact(less ? 1 : 0, 1);
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> operator>(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return b < a;
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> operator<=(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return ~(b < a);
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> operator>=(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return ~(a < b);
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> operator==(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  const bool same = a.word() == b.word() && a.negative() == b.negative();
  return SizedInt<false, Word>::exact(same ? 1 : 0, 1);
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> operator!=(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return ~(a == b);
}

template <bool S, class Word>
constexpr int width_of(const SizedInt<S, Word>& x) {
  return x.width();
}
template <bool S, class Word>
constexpr SizedInt<false, Word> slice(const SizedInt<S, Word>& x, int high, int low) {
  assert(low >= 0 && high >= low && high < x.width());
  return {x.word() >> low, high - low + 1};
}
template <bool S1, bool S2, class Word>
constexpr SizedInt<false, Word> cat(const SizedInt<S1, Word>& a, const SizedInt<S2, Word>& b) {
  return {a.word() << b.width() | b.pattern(), a.width() + b.width()};
}
template <bool S, class Word>
constexpr SizedInt<S, Word> select(const SizedInt<false, Word>& bit, const SizedInt<S, Word>& a,
                                   const SizedInt<S, Word>& b) {
  assert(bit.width() == 1 && a.width() == b.width());
  return SizedInt<S, Word>::exact(bit.word() != 0 ? a.word() : b.word(), a.width());
}
template <bool S, class Word>
constexpr SizedInt<S, Word> resize(const SizedInt<S, Word>& x, int width) {
  return {x.word(), width};
}
template <bool S, class Word>
constexpr SizedInt<true, Word> as_signed(const SizedInt<S, Word>& x) {
  return {x.word(), x.width()};
}
template <bool S, class Word>
constexpr SizedInt<false, Word> as_unsigned(const SizedInt<S, Word>& x) {
  return {x.word(), x.width()};
}
template <bool S, class Word>
constexpr SizedInt<S, Word> as(const char* /*name*/, const SizedInt<S, Word>& x) {
  return x;
}
template <bool S, class Word>
constexpr SizedInt<S, Word> as(const char* /*name*/, char /*axis*/, const SizedInt<S, Word>& x) {
  return x;
}

}  // namespace hitpipe::hls
