// What the compiler decides: the width and sign of every result, constant expressions, and properties of the
// types.
#include <type_traits>

#include <gtest/gtest.h>

#include "hls/num/domain.hpp"

namespace hitpipe::hls::ap_int_types_test {
namespace {

template <int W>
using s = ap_int<W>;
template <int W>
using u = ap_uint<W>;

template <class Got, class Expected>
inline constexpr bool same = std::is_same_v<std::remove_cv_t<Got>, Expected>;

template <class A, class B>
constexpr bool sum_is(auto expected) {
  return same<decltype(A() + B()), decltype(expected)>;
}
template <class A, class B>
constexpr bool difference_is(auto expected) {
  return same<decltype(A() - B()), decltype(expected)>;
}
template <class A, class B>
constexpr bool product_is(auto expected) {
  return same<decltype(A() * B()), decltype(expected)>;
}
template <class A, class B>
constexpr bool logic_is(auto expected) {
  return same<decltype(A() & B()), decltype(expected)> && same<decltype(A() | B()), decltype(expected)> &&
         same<decltype(A() ^ B()), decltype(expected)>;
}
template <class A, class B>
constexpr bool quotient_is(auto expected) {
  return same<decltype(A() / B()), decltype(expected)>;
}
template <class A, class B>
constexpr bool remainder_is(auto expected) {
  return same<decltype(A() % B()), decltype(expected)>;
}

// a + b: max(e1, e2) + 1, signed if either is.
static_assert(sum_is<u<8>, u<8>>(u<9>()) && sum_is<s<8>, s<8>>(s<9>()));
static_assert(sum_is<u<8>, s<8>>(s<10>()) && sum_is<s<8>, u<8>>(s<10>()));
static_assert(sum_is<u<4>, s<8>>(s<9>()) && sum_is<s<4>, u<8>>(s<10>()));
static_assert(sum_is<u<1>, u<1>>(u<2>()) && sum_is<u<128>, s<128>>(s<130>()));
// a - b: the same, always signed.
static_assert(difference_is<u<8>, u<8>>(s<9>()) && difference_is<s<24>, s<24>>(s<25>()));
static_assert(difference_is<u<8>, s<8>>(s<10>()) && difference_is<s<31>, u<30>>(s<32>()));
// a * b: W1 + W2, signed if either is.
static_assert(product_is<s<24>, s<24>>(s<48>()) && product_is<u<8>, u<5>>(u<13>()));
static_assert(product_is<u<8>, s<5>>(s<13>()) && product_is<s<256>, u<256>>(s<512>()));
// a & b, a | b, a ^ b: max(e1, e2), signed if either is.
static_assert(logic_is<u<8>, u<4>>(u<8>()) && logic_is<s<8>, s<4>>(s<8>()));
static_assert(logic_is<s<8>, u<8>>(s<9>()) && logic_is<u<8>, s<8>>(s<9>()) && logic_is<s<8>, u<4>>(s<8>()));
// a / b: W1 + S2, signed if either is. a % b: min(W1, W2 + (S1 and not S2)), as a.
static_assert(quotient_is<u<8>, u<4>>(u<8>()) && quotient_is<s<8>, u<4>>(s<8>()));
static_assert(quotient_is<u<8>, s<4>>(s<9>()) && quotient_is<s<8>, s<12>>(s<9>()));
static_assert(remainder_is<u<8>, u<4>>(u<4>()) && remainder_is<s<8>, s<4>>(s<4>()));
static_assert(remainder_is<s<8>, u<4>>(s<5>()) && remainder_is<u<8>, s<4>>(u<4>()));
static_assert(remainder_is<s<4>, u<8>>(s<4>()) && remainder_is<u<3>, s<8>>(u<3>()));
// -a: max(W, S ? 2 : 1) + 1, signed. ~a, +a, a << n, a >> n: as a.
static_assert(same<decltype(-s<1>()), s<3>> && same<decltype(-u<1>()), s<2>>);
static_assert(same<decltype(-s<2>()), s<3>> && same<decltype(-u<24>()), s<25>>);
static_assert(same<decltype(~u<1>()), u<1>> && same<decltype(+s<7>()), s<7>>);
static_assert(same<decltype(u<5>() << 3), u<5>> && same<decltype(s<5>() >> u<9>()), s<5>>);
// A C++ integer has its own width and sign; bool is one bit.
static_assert(sum_is<u<8>, int>(s<33>()) && sum_is<int, u<8>>(s<33>()) && sum_is<u<8>, bool>(u<9>()));
static_assert(product_is<s<8>, unsigned char>(s<16>()) && difference_is<u<64>, std::int64_t>(s<66>()));
static_assert(quotient_is<int, u<8>>(s<32>()) && remainder_is<u<8>, short>(u<8>()));
static_assert(logic_is<u<8>, std::uint64_t>(u<64>()) && logic_is<char, u<8>>(s<9>()));
// Parts are unsigned: a bit is one bit, a range as wide as its parent, a concatenation as wide as both sides.
static_assert(same<decltype(u<8>()(7, 4) + u<8>()(3, 0)), u<9>>);
static_assert(same<decltype(s<8>().range(3, 0) * u<4>()), u<12>>);
static_assert(same<decltype(+(u<8>(), s<5>())), u<13>> && same<decltype(+(u<8>(), true)), u<9>>);
static_assert(same<decltype(+u<8>().concat(s<5>())), u<13>>);
static_assert(same<decltype(std::declval<u<8>&>()[3] + u<1>()), u<2>>);
// The free functions give plain values of the width they name.
static_assert(same<decltype(slice(s<8>(), 7_w, 4_w)), u<4>> && same<decltype(cat(s<3>(), u<5>())), u<8>>);
static_assert(same<decltype(resize(s<4>(), 9_w)), s<9>> && same<decltype(resize(u<4>(), 3_w)), u<3>>);
static_assert(same<decltype(Native::lit(1, 24_w)), u<24>> &&
              same<decltype(select(u<1>(), s<9>(), s<9>())), s<9>>);

template <class A>
inline constexpr bool plain_data =
    std::is_trivially_copyable_v<A>&& std::is_trivially_destructible_v<A>&& std::is_standard_layout_v<A>;
static_assert(plain_data<u<1>> && plain_data<s<24>> && plain_data<u<64>> && plain_data<s<128>> &&
              plain_data<u<512>>);
static_assert(sizeof(u<1>) == 8 && sizeof(s<64>) == 8 && sizeof(u<65>) == 16 && sizeof(s<129>) == 24);

template <class A, class B>
concept addable = requires(A a, B b) {
  a + b;
};
template <class A, class N>
concept shiftable = requires(A a, N n) {
  a << n;
};
template <class C, class T>
concept selectable = requires(C c, T t) {
  select(c, t, t);
};
template <class A, class V>
concept writable = requires(A a, V v) {
  a = v;
};
// No floats, no strings, no conversion to C++ integers, no shift by a signed value.
static_assert(!addable<u<8>, double> && !std::is_constructible_v<u<8>, float>);
static_assert(!std::is_constructible_v<u<8>, const char*> && !std::is_convertible_v<u<8>, int>);
static_assert(shiftable<u<8>, int> && shiftable<u<8>, u<3>> && !shiftable<u<8>, s<3>>);
// select() takes a bit. It refuses a bool, which another domain may not have, and a word.
static_assert(selectable<u<1>, s<8>> && !selectable<bool, s<8>> && !selectable<u<2>, s<8>>);
// A part of a temporary is read only.
static_assert(writable<decltype(std::declval<u<8>&>()(3, 0)), int>);
static_assert(!writable<decltype(u<8>()(3, 0)), int> && !writable<decltype((u<8>(), u<8>())), int>);
static_assert(writable<decltype((std::declval<u<8>&>(), std::declval<s<8>&>())), int>);

constexpr u<16> swapped_bytes(const u<16>& x) {
  u<16> out;
  out.range(15, 8) = x(7, 0);
  out(7, 0) = x.range(15, 8);
  out[0] = 1;
  out.invert(1);
  return out;
}
static_assert(swapped_bytes(0x12c0) == 0xc011);
static_assert((u<4>(5), u<4>(6)) == 0x56 && s<4>(-1).concat(u<4>(6)) == 0xf6);
static_assert(s<100>(-7) * s<100>(9) == -63 && u<128>(-1) % 1000 == 455);
static_assert(s<24>(-9) / s<8>(2) == -4 && s<24>(-9) % s<8>(2) == -1 && (s<24>(-9) >> 1) == -5);
static_assert((u<200>(1) << 199) / (u<200>(1) << 190) == 512);
static_assert(slice(s<24>(-1), 23_w, 20_w) == 15 && cat(u<1>(1), s<2>(-2)) == 6 &&
              resize(s<4>(-3), 8_w) == -3);
static_assert(select(u<1>(1), u<4>(3), u<4>(9)) == 3 &&
              select(u<1>(s<8>(-1) < u<8>(0)), u<4>(3), u<4>(9)) == 3);
static_assert(~u<1>(1) == 0 && ~u<1>(0) == 1 && as("hit", u<1>(1)) == 1 && as("near", 'x', s<4>(-8)) == -8);

TEST(ApIntTypes, ConstantExpressionsAgreeWithRunTime) {
  volatile int opaque = 0x12c0;
  const int value = opaque;
  EXPECT_EQ(swapped_bytes(value), 0xc011);
}

TEST(ApIntTypes, DefaultIsZero) {
  EXPECT_TRUE(u<24>().is_zero());
  EXPECT_TRUE(s<300>().is_zero());
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_types_test
