// Widths as values. Width<24> is known when the code is compiled, and arithmetic on such widths gives Widths.
// In a domain whose widths are known at run time the same expressions are ints: `e + m - 1_w` works in both.
#pragma once

namespace hitpipe {
namespace hls {

template <int N>
struct Width {
  constexpr operator int() const { return N; }
};

/// A comparison of two Widths.
template <bool B>
struct Truth {
  constexpr operator bool() const { return B; }
};

template <int A, int B>
constexpr Width<A + B> operator+(Width<A>, Width<B>) {
  return {};
}
template <int A, int B>
constexpr Width<A - B> operator-(Width<A>, Width<B>) {
  return {};
}
template <int A, int B>
constexpr Width<A * B> operator*(Width<A>, Width<B>) {
  return {};
}
template <int A, int B>
constexpr Width<A / B> operator/(Width<A>, Width<B>) {
  return {};
}
template <int A, int B>
constexpr Truth<(A < B)> operator<(Width<A>, Width<B>) {
  return {};
}

constexpr int min(int a, int b) {
  return a < b ? a : b;
}
template <int A, int B>
constexpr Width<min(A, B)> min(Width<A>, Width<B>) {
  return {};
}
constexpr int max(int a, int b) {
  return a < b ? b : a;
}
template <int A, int B>
constexpr Width<max(A, B)> max(Width<A>, Width<B>) {
  return {};
}

constexpr int power_of_two(int exponent) {
  return 1 << exponent;
}
template <int E>
constexpr Width<power_of_two(E)> power_of_two(Width<E>) {
  return {};
}

/// The bits needed to count 0 .. values-1.
constexpr int count_bits(int values) {
  int bits = 0;
  while ((1 << bits) < values) ++bits;
  return bits;
}
template <int Values>
constexpr Width<count_bits(Values)> count_bits(Width<Values>) {
  return {};
}

template <char... Digits>
constexpr int decimal_number() {
  const char digits[] = {Digits...};
  int number = 0;
  for (const char digit : digits) number = 10 * number + (digit - '0');
  return number;
}
/// 24_w is Width<24>.
template <char... Digits>
constexpr Width<decimal_number<Digits...>()> operator""_w() {
  return {};
}

}  // namespace hls
}  // namespace hitpipe
