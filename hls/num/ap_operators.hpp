// The operators of ap_int, each result as wide as it can need: with
// e1 = W1 + (S2 and not S1), e2 = W2 + (S1 and not S2)
//   a + b   max(e1, e2) + 1, signed if either is    a & | ^ b  max(e1, e2), signed if either is
//   a - b   max(e1, e2) + 1, signed                 a / b      W1 + S2, signed if either is
//   a * b   W1 + W2, signed if either is            a % b      min(W1, W2 + (S1 and not S2)), as a
//   -a      max(W, S ? 2 : 1) + 1, signed           ~a +a a << n a >> n   as a
// Comparisons give bool, exact across widths and signs. A C++ integer counts as its own width and sign.
// Division rounds toward zero. By zero, the quotient is all ones and the remainder is the dividend, wrapped.
#pragma once

#include <algorithm>

#include "hls/num/ap_base.hpp"
#include "hls/num/ap_refs.hpp"

namespace hitpipe::hls {

/// Result types of the binary operators, by the table above.
template <class A, class B>
struct ResultOf {
  static constexpr int w1 = Shape<A>::width;
  static constexpr int w2 = Shape<B>::width;
  static constexpr bool s1 = Shape<A>::is_signed;
  static constexpr bool s2 = Shape<B>::is_signed;
  static constexpr bool is_signed = s1 || s2;
  /// The width in which both operands are exact.
  static constexpr int common = std::max(w1 + (s2 && !s1 ? 1 : 0), w2 + (s1 && !s2 ? 1 : 0));

  using sum = ap_base<common + 1, is_signed>;
  using difference = ap_base<common + 1, true>;
  using product = ap_base<w1 + w2, is_signed>;
  using logic = ap_base<common, is_signed>;
  using quotient = ap_base<w1 + (s2 ? 1 : 0), is_signed>;
  using remainder = ap_base<std::min(w1, w2 + (s1 && !s2 ? 1 : 0)), s1>;
};
/// The type of x itself, as an operand.
template <class A>
using own_type = ap_base<Shape<A>::width, Shape<A>::is_signed>;

/// x in another word, exactly if it has the width.
template <class Word, operand A>
constexpr Word as_word(const A& x) {
  return words::convert<Word, Shape<A>::is_signed>(value_of(x).word());
}

// The results below have room for the exact value, so the word needs no wrapping.

template <class A, class B>
requires operands<A, B>
constexpr auto operator+(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::sum;
  using Word = typename R::word_type;
  return R::exact(as_word<Word>(a) + as_word<Word>(b));
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator-(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::difference;
  using Word = typename R::word_type;
  return R::exact(as_word<Word>(a) - as_word<Word>(b));
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator*(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::product;
  using Word = typename R::word_type;
  return R::exact(as_word<Word>(a) * as_word<Word>(b));
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator&(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::logic;
  using Word = typename R::word_type;
  return R::exact(as_word<Word>(a) & as_word<Word>(b));
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator|(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::logic;
  using Word = typename R::word_type;
  return R::exact(as_word<Word>(a) | as_word<Word>(b));
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator^(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::logic;
  using Word = typename R::word_type;
  return R::exact(as_word<Word>(a) ^ as_word<Word>(b));
}

template <ap_operand A>
constexpr auto operator-(const A& a) {
  return ap_uint<1>() - a;
}

template <ap_operand A>
constexpr auto operator+(const A& a) {
  return own_type<A>(a);
}

template <ap_operand A>
constexpr auto operator~(const A& a) {
  return own_type<A>::wrapped(~value_of(a).word());
}

template <ap_operand A>
constexpr bool operator!(const A& a) {
  return value_of(a).is_zero();
}

/// Divides the magnitudes of a and b, in a word that holds either.
template <class A, class B>
constexpr auto divide_magnitudes(const A& a, const B& b) {
  using Word = words::word_t<std::max(Shape<A>::width, Shape<B>::width)>;
  const Word dividend = as_word<Word>(a);
  const Word divisor = as_word<Word>(b);
  return words::divide<>(value_of(a).sign() ? Word{} - dividend : dividend,
                         value_of(b).sign() ? Word{} - divisor : divisor);
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator/(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::quotient;
  using Word = typename R::word_type;
  if (value_of(b).is_zero()) return R::wrapped(~Word{});
  const Word quotient = words::convert<Word, false>(divide_magnitudes(a, b).quotient);
  return R::exact(value_of(a).sign() != value_of(b).sign() ? Word{} - quotient : quotient);
}

template <class A, class B>
requires operands<A, B>
constexpr auto operator%(const A& a, const B& b) {
  using R = typename ResultOf<A, B>::remainder;
  using Word = typename R::word_type;
  if (value_of(b).is_zero()) return R(a);
  const Word remainder = words::convert<Word, false>(divide_magnitudes(a, b).remainder);
  return R::exact(value_of(a).sign() ? Word{} - remainder : remainder);
}

/// The shift count as an int within -limit..limit; only a signed C++ integer can be negative.
template <shift_count N>
constexpr int clamped_count(const N& n, int limit) {
  if constexpr (Shape<N>::ap) {
    using Word = typename own_type<N>::word_type;
    using Wide = words::word_t<std::max(Shape<N>::width, 32)>;
    const Wide wide = words::convert<Wide, false>(Word(value_of(n).word()));
    const Wide most = words::convert<Wide, false>(static_cast<words::u64>(limit));
    return words::less<false>(wide, most) ? value_of(n).to_int() : limit;
  } else if constexpr (Shape<N>::is_signed) {
    return static_cast<int>(std::clamp<std::int64_t>(n, -limit, limit));
  } else {
    return static_cast<int>(std::min<std::uint64_t>(n, static_cast<std::uint64_t>(limit)));
  }
}

template <int W, bool S>
constexpr ap_base<W, S> shifted_left(const ap_base<W, S>& x, int n) {
  return n >= W ? ap_base<W, S>() : ap_base<W, S>::wrapped(words::shift_left(x.word(), n));
}
template <int W, bool S>
constexpr ap_base<W, S> shifted_right(const ap_base<W, S>& x, int n) {
  if (n >= W) return S ? ap_base<W, S>::exact(words::shift_right<S>(x.word(), W - 1)) : ap_base<W, S>();
  return ap_base<W, S>::exact(words::shift_right<S>(x.word(), n));
}

/// As wide as a; n >= W gives 0. A negative C++ integer shifts right, as the vendors'.
template <ap_operand A, shift_count N>
constexpr auto operator<<(const A& a, const N& n) {
  const int count = clamped_count(n, Shape<A>::width);
  return count < 0 ? shifted_right(own_type<A>(a), -count) : shifted_left(own_type<A>(a), count);
}

/// As wide as a; n >= W gives the sign of a signed value, else 0. A negative C++ integer shifts left.
template <ap_operand A, shift_count N>
constexpr auto operator>>(const A& a, const N& n) {
  const int count = clamped_count(n, Shape<A>::width);
  return count < 0 ? shifted_left(own_type<A>(a), -count) : shifted_right(own_type<A>(a), count);
}

template <class A, class B>
requires operands<A, B>
constexpr bool operator==(const A& a, const B& b) {
  using Word = words::word_t<ResultOf<A, B>::common>;
  return as_word<Word>(a) == as_word<Word>(b);
}

template <class A, class B>
requires operands<A, B>
constexpr bool operator<(const A& a, const B& b) {
  using Word = words::word_t<ResultOf<A, B>::common>;
  return words::less<ResultOf<A, B>::is_signed>(as_word<Word>(a), as_word<Word>(b));
}

template <class A, class B>
requires operands<A, B>
constexpr bool operator!=(const A& a, const B& b) {
  return !(a == b);
}
template <class A, class B>
requires operands<A, B>
constexpr bool operator>(const A& a, const B& b) {
  return b < a;
}
template <class A, class B>
requires operands<A, B>
constexpr bool operator<=(const A& a, const B& b) {
  return !(b < a);
}
template <class A, class B>
requires operands<A, B>
constexpr bool operator>=(const A& a, const B& b) {
  return !(a < b);
}

}  // namespace hitpipe::hls
