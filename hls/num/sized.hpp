// The host's value domain for widths that are known at run time. A value carries its width, 1 to 64 bits.
// Results have the bits and widths of ap_int's rules (hls/num/ap_operators.hpp), so a format chosen at run
// time needs no instance of its own.
#pragma once

#include <cassert>
#include <cstdint>

#include "hls/num/bits.hpp"

namespace hitpipe::hls {

/// An integer of `width` bits, signed or not. The bits of its word above them repeat the sign, or are 0.
template <bool S>
class SizedInt {
 public:
  static constexpr bool is_signed = S;

  constexpr SizedInt() = default;
  /// The low bits of a word.
  constexpr SizedInt(std::uint64_t bits, int width) : word_(wrapped(bits, width)), width_(width) {}
  /// The word must be canonical: above the width it has only bits of the sign.
  static constexpr SizedInt exact(std::uint64_t word, int width) {
    assert(width >= 1 && width <= 64);
    SizedInt x;
    x.word_ = word;
    x.width_ = width;
    return x;
  }

  [[nodiscard]] constexpr std::uint64_t word() const { return word_; }
  [[nodiscard]] constexpr int width() const { return width_; }
  /// The low bits, with zeros above.
  [[nodiscard]] constexpr std::uint64_t pattern() const { return word_ & ones(width_); }
  [[nodiscard]] constexpr std::int64_t to_int64() const { return static_cast<std::int64_t>(word_); }

 private:
  static constexpr std::uint64_t ones(int width) { return ~std::uint64_t{0} >> (64 - width); }
  static constexpr std::uint64_t wrapped(std::uint64_t bits, int width) {
    assert(width >= 1 && width <= 64);
    if (!S) return bits & ones(width);
    const int spare = 64 - width;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(bits << spare) >> spare);
  }

  std::uint64_t word_ = 0;
  int width_ = 1;
};

struct Sized {
  using sint = SizedInt<true>;
  using uint = SizedInt<false>;
  using bit = uint;

  static constexpr uint lit(std::int64_t value, int width) {
    return {static_cast<std::uint64_t>(value), width};
  }
};

/// The width in which both operands are exact.
template <bool S1, bool S2>
constexpr int common_width(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return max(a.width() + (S2 && !S1 ? 1 : 0), b.width() + (S1 && !S2 ? 1 : 0));
}

template <bool S1, bool S2>
constexpr SizedInt<S1 || S2> operator+(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return SizedInt < S1 || S2 > ::exact(a.word() + b.word(), common_width(a, b) + 1);
}
template <bool S1, bool S2>
constexpr SizedInt<true> operator-(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return SizedInt<true>::exact(a.word() - b.word(), common_width(a, b) + 1);
}
template <bool S1, bool S2>
constexpr SizedInt<S1 || S2> operator*(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return SizedInt < S1 || S2 > ::exact(a.word() * b.word(), a.width() + b.width());
}
template <bool S1, bool S2>
constexpr SizedInt<S1 || S2> operator&(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return SizedInt < S1 || S2 > ::exact(a.word() & b.word(), common_width(a, b));
}
template <bool S1, bool S2>
constexpr SizedInt<S1 || S2> operator|(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return SizedInt < S1 || S2 > ::exact(a.word() | b.word(), common_width(a, b));
}
template <bool S1, bool S2>
constexpr SizedInt<S1 || S2> operator^(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return SizedInt < S1 || S2 > ::exact(a.word() ^ b.word(), common_width(a, b));
}
template <bool S>
constexpr SizedInt<S> operator~(const SizedInt<S>& a) {
  return {~a.word(), a.width()};
}

template <bool S1, bool S2>
constexpr Sized::bit operator<(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  const bool a_negative = S1 && a.to_int64() < 0;
  const bool b_negative = S2 && b.to_int64() < 0;
  bool less = a.word() < b.word();
  if (S1 && S2) less = a.to_int64() < b.to_int64();
  if (S1 != S2 && (a_negative || b_negative)) less = a_negative;
  return Sized::bit::exact(less ? 1 : 0, 1);
}
template <bool S1, bool S2>
constexpr Sized::bit operator>(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return b < a;
}
template <bool S1, bool S2>
constexpr Sized::bit operator<=(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return ~(b < a);
}
template <bool S1, bool S2>
constexpr Sized::bit operator>=(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return ~(a < b);
}
template <bool S1, bool S2>
constexpr Sized::bit operator==(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  const bool signs_differ = S1 != S2 && ((a.word() | b.word()) >> 63) != 0;
  return Sized::bit::exact(a.word() == b.word() && !signs_differ ? 1 : 0, 1);
}
template <bool S1, bool S2>
constexpr Sized::bit operator!=(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return ~(a == b);
}

template <bool S>
constexpr int width_of(const SizedInt<S>& x) {
  return x.width();
}
template <bool S>
constexpr Sized::uint slice(const SizedInt<S>& x, int high, int low) {
  assert(low >= 0 && high >= low && high < x.width());
  return {x.word() >> low, high - low + 1};
}
template <bool S1, bool S2>
constexpr Sized::uint cat(const SizedInt<S1>& a, const SizedInt<S2>& b) {
  return {a.word() << b.width() | b.pattern(), a.width() + b.width()};
}
template <bool S>
constexpr SizedInt<S> select(const Sized::bit& bit, const SizedInt<S>& a, const SizedInt<S>& b) {
  assert(bit.width() == 1 && a.width() == b.width());
  return SizedInt<S>::exact(bit.word() != 0 ? a.word() : b.word(), a.width());
}
template <bool S>
constexpr SizedInt<S> resize(const SizedInt<S>& x, int width) {
  return {x.word(), width};
}
template <bool S>
constexpr Sized::sint as_signed(const SizedInt<S>& x) {
  return {x.word(), x.width()};
}
template <bool S>
constexpr Sized::uint as_unsigned(const SizedInt<S>& x) {
  return {x.word(), x.width()};
}
template <bool S>
constexpr SizedInt<S> as(const char* /*name*/, const SizedInt<S>& x) {
  return x;
}
template <bool S>
constexpr SizedInt<S> as(const char* /*name*/, char /*axis*/, const SizedInt<S>& x) {
  return x;
}

}  // namespace hitpipe::hls
