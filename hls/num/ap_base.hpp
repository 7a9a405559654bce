// ap_base<W, S>: a W-bit two's complement integer, the type behind ap_int<W> (S) and ap_uint<W> (not S).
// Names, widths and meanings are as in the vendors' ap_int, so that one pipeline source compiles against
// either. Operators grow (see ap_operators.hpp); only construction, assignment and compound assignment wrap
// to W bits. Widths: 1 to 512 bits. The value is kept in one machine word up to 64 bits, see words.hpp.
#pragma once

#include <cassert>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hls/num/words.hpp"

namespace hitpipe::hls {

template <int W, bool S>
class ap_base;
template <int W>
using ap_int = ap_base<W, true>;
template <int W>
using ap_uint = ap_base<W, false>;

template <class Bits>
class RangeRef;
template <int W, bool S>
class BitRef;
template <class Hi, class Lo>
class ConcatRef;

/// Width and signedness of the operand of an operator. `ap` is false for the integers of C++ themselves.
template <class T>
struct Shape;
template <int W, bool S>
struct Shape<ap_base<W, S>> {
  static constexpr int width = W;
  static constexpr bool is_signed = S;
  static constexpr bool ap = true;
};
/// A C++ integer counts as its own width and sign; bool is one unsigned bit.
template <std::integral T>
struct Shape<T> {
  static constexpr bool is_signed = std::numeric_limits<T>::is_signed;
  static constexpr int width = std::numeric_limits<T>::digits + (is_signed ? 1 : 0);
  static constexpr bool ap = false;
};

template <class T>
concept operand = requires {
  Shape<T>::width;
};
template <class T>
concept ap_operand = operand<T> && Shape<T>::ap;
/// The operands of a binary operator: at least one is not a plain C++ integer.
template <class A, class B>
concept operands = operand<A> && operand<B> &&(Shape<A>::ap || Shape<B>::ap);
/// What may shift an ap value: a C++ integer, or an unsigned ap value.
template <class T>
concept shift_count = operand<T> &&(!Shape<T>::ap || !Shape<T>::is_signed);

template <int W, bool S>
constexpr const ap_base<W, S>& value_of(const ap_base<W, S>& x) {
  return x;
}
template <std::integral T>
constexpr ap_base<Shape<T>::width, Shape<T>::is_signed> value_of(T x) {
  using Wide = std::conditional_t<Shape<T>::is_signed, std::int64_t, std::uint64_t>;
  return ap_base<Shape<T>::width, Shape<T>::is_signed>::exact(
      static_cast<std::uint64_t>(static_cast<Wide>(x)));
}

/// An integer of W bits, signed or not. Bit indices are 0 <= i < W, ranges W > hi >= lo >= 0 (asserted).
template <int W, bool S>
class ap_base {
  static_assert(W >= 1, "hitpipe ap_int: a width must be at least 1 bit");
  static_assert(W <= 512, "hitpipe ap_int: a result may grow to 512 bits; resize the operands first");

 public:
  static constexpr int width = W;
  static constexpr bool is_signed = S;
  using word_type = words::word_t<W>;

  /// Zero.
  constexpr ap_base() = default;
  /// From any C++ integer or ap value: extended by the source's sign, or wrapped to W bits.
  template <operand A>
  constexpr ap_base(const A& a)
      : word_(words::wrap<W, S>(words::convert<word_type, Shape<A>::is_signed>(value_of(a).word()))) {}

  /// From a word that is already canonical (see words.hpp).
  static constexpr ap_base exact(const word_type& word) {
    ap_base x;
    x.word_ = word;
    return x;
  }
  /// From any word, cut to its low W bits.
  static constexpr ap_base wrapped(const word_type& word) { return exact(words::wrap<W, S>(word)); }
  /// The canonical word.
  constexpr const word_type& word() const { return word_; }

  // Parts. A part of an lvalue can be written; any other part is a copy. A part is unsigned.
  constexpr RangeRef<ap_base&> range(int hi, int lo) &;
  constexpr RangeRef<ap_base> range(int hi, int lo) const&;
  constexpr RangeRef<ap_base&> operator()(int hi, int lo) &;
  constexpr RangeRef<ap_base> operator()(int hi, int lo) const&;
  constexpr BitRef<W, S> operator[](int i) &;
  constexpr bool operator[](int i) const& { return test(i); }
  constexpr BitRef<W, S> bit(int i) &;
  constexpr bool bit(int i) const& { return test(i); }

  constexpr bool test(int i) const {
    assert(i >= 0 && i < W);
    return words::bit(word_, i);
  }
  constexpr bool get_bit(int i) const { return test(i); }
  constexpr void set_bit(int i, bool v) {
    assert(i >= 0 && i < W);
    const word_type one = words::shift_left(words::low_ones<word_type>(1), i);
    word_ = words::wrap<W, S>(v ? word_ | one : word_ & ~one);
  }
  constexpr void set(int i) { set_bit(i, true); }
  constexpr void set(int i, bool v) { set_bit(i, v); }
  constexpr void clear(int i) { set_bit(i, false); }
  constexpr void invert(int i) { set_bit(i, !test(i)); }

  /// (x, b): this value in the high bits, b in the low bits. Unsigned, as wide as both. Writable if both are.
  template <class B>
  constexpr auto concat(B&& b) &;
  template <class B>
  constexpr auto concat(B&& b) const&;

  constexpr bool and_reduce() const { return word_ == words::wrap<W, S>(~word_type{}); }
  constexpr bool or_reduce() const { return !is_zero(); }
  constexpr bool xor_reduce() const { return words::parity(words::wrap<W, false>(word_)); }

  constexpr int length() const { return W; }
  constexpr bool is_zero() const { return word_ == word_type{}; }
  /// True when the value is below zero.
  constexpr bool sign() const { return S && words::bit(word_, W - 1); }

  // To C++ integers: the low bits, extended by this value's sign.
  constexpr bool to_bool() const { return !is_zero(); }
  constexpr int to_int() const { return static_cast<int>(low64()); }
  constexpr unsigned to_uint() const { return static_cast<unsigned>(low64()); }
  constexpr std::int64_t to_int64() const { return static_cast<std::int64_t>(low64()); }
  constexpr std::uint64_t to_uint64() const { return low64(); }
  /// Text in radix 2, 8, 10 or 16; defined in hls/num/ap_string.hpp.
  constexpr auto to_string(int radix = 10) const;

  // Modulo 2^W, whatever the operand's width.
  template <operand B>
  constexpr ap_base& operator+=(const B& b) {
    return *this = wrapped(word_ + low(b));
  }
  template <operand B>
  constexpr ap_base& operator-=(const B& b) {
    return *this = wrapped(word_ - low(b));
  }
  template <operand B>
  constexpr ap_base& operator*=(const B& b) {
    return *this = wrapped(word_ * low(b));
  }
  template <operand B>
  constexpr ap_base& operator&=(const B& b) {
    return *this = wrapped(word_ & low(b));
  }
  template <operand B>
  constexpr ap_base& operator|=(const B& b) {
    return *this = wrapped(word_ | low(b));
  }
  template <operand B>
  constexpr ap_base& operator^=(const B& b) {
    return *this = wrapped(word_ ^ low(b));
  }
  template <operand B>
  constexpr ap_base& operator/=(const B& b) {
    return *this = *this / b;
  }
  template <operand B>
  constexpr ap_base& operator%=(const B& b) {
    return *this = *this % b;
  }
  template <shift_count N>
  constexpr ap_base& operator<<=(const N& n) {
    return *this = *this << n;
  }
  template <shift_count N>
  constexpr ap_base& operator>>=(const N& n) {
    return *this = *this >> n;
  }

 private:
  constexpr std::uint64_t low64() const { return words::convert<std::uint64_t, S>(word_); }
  template <operand B>
  static constexpr word_type low(const B& b) {
    return words::convert<word_type, Shape<B>::is_signed>(value_of(b).word());
  }

  word_type word_{};
};

}  // namespace hitpipe::hls
