// Exact reference for the ap_int tests: Boost.Multiprecision integers, and rows of operations under test.
// Operands and results pass between exact integers and ap types as Raw limbs, which are written to and read
// from the storage itself. So nothing under test takes part, and a result that is not canonical shows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "hls/num/ap_int.hpp"

namespace hitpipe::hls::exact {

/// Room for any result (512 bits) shifted by any count (255), without memory management.
using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<1024, 1024, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;
/// A number of up to 512 bits in two's complement, the least significant limb first.
using Raw = std::array<std::uint64_t, 8>;

inline Integer power_of_two(int n) {
  return Integer(1) << static_cast<unsigned>(n);
}

/// x modulo 2^width, in 0..2^width-1.
inline Integer pattern(const Integer& x, int width) {
  const Integer modulus = power_of_two(width);
  const Integer rest = x % modulus;
  return rest < 0 ? Integer(rest + modulus) : rest;
}

/// x wrapped into the range of a width and sign.
inline Integer wrapped(const Integer& x, int width, bool is_signed) {
  const Integer bits = pattern(x, width);
  return is_signed && bits >= power_of_two(width - 1) ? Integer(bits - power_of_two(width)) : bits;
}

inline Raw to_raw(const Integer& x) {
  Integer bits = pattern(x, 512);
  Raw raw{};
  for (std::uint64_t& limb : raw) {
    limb = static_cast<std::uint64_t>(bits & ~std::uint64_t{0});
    bits >>= 64;
  }
  return raw;
}

inline Integer from_raw(const Raw& raw, bool is_signed) {
  Integer bits = 0;
  for (std::size_t i = raw.size(); i-- > 0;) bits = (bits << 64) | raw[i];
  return wrapped(bits, 512, is_signed);
}

/// An ap value of the number in raw, which must be in its range.
template <class A>
[[gnu::noinline]] A make(const Raw& raw) {
  using Word = typename A::word_type;
  if constexpr (words::bits<Word> == 64) {
    return A::exact(raw[0]);
  } else if constexpr (words::bits<Word> == 128) {
    return A::exact(static_cast<Word>(raw[1]) << 64 | raw[0]);
  } else {
    Word word;
    std::copy_n(raw.begin(), words::bits<Word> / 64, word.limb);
    return A::exact(word);
  }
}

/// The whole storage of x. Above it come the sign or zeros.
template <int W, bool S>
[[gnu::noinline]] Raw raw_of(const ap_base<W, S>& x) {
  using Word = typename ap_base<W, S>::word_type;
  constexpr std::size_t limbs = words::bits<Word> / 64;
  Raw raw{};
  if constexpr (limbs <= 2) {
    for (std::size_t i = 0; i < limbs; ++i) raw[i] = static_cast<std::uint64_t>(x.word() >> (64 * i));
  } else {
    std::copy_n(x.word().limb, limbs, raw.begin());
  }
  if (S && raw[limbs - 1] >> 63 != 0) std::fill(raw.begin() + limbs, raw.end(), ~std::uint64_t{0});
  return raw;
}

/// Width and sign of a type, as data.
struct Type {
  int width;
  bool is_signed;
};
template <class A>
inline constexpr Type type_of = {Shape<A>::width, Shape<A>::is_signed};

inline std::string name(const Type& t) {
  return (t.is_signed ? "ap_int<" : "ap_uint<") + std::to_string(t.width) + ">";
}

/// One operation on one pair of types, applied to numbers in their ranges.
struct Row {
  Type a;
  Type b;
  Type result;
  Raw (*apply)(const Raw& a, const Raw& b);
};

/// A Row of a captureless op(a, b), whose result is an ap value or a C++ integer.
template <class Op, class A, class B>
Row row() {
  using R = std::remove_cvref_t<decltype(Op{}(std::declval<const A&>(), std::declval<const B&>()))>;
  return {type_of<A>, type_of<B>, type_of<R>,
          [](const Raw& a, const Raw& b) { return raw_of(value_of(Op{}(make<A>(a), make<B>(b)))); }};
}

template <int... W>
struct Widths {};
/// Widths inside and at the end of each machine word.
using CrossedWidths = Widths<24, 64, 65, 128>;
/// The same, their neighbours, and those around the C++ integers'. Other widths take the same paths.
using EdgeWidths = Widths<1, 2, 24, 31, 32, 33, 62, 63, 64, 65, 66, 100, 127, 128>;

template <class F, int... W>
void with_types(F f, Widths<W...>) {
  (f.template operator()<ap_int<W>>(), ...);
  (f.template operator()<ap_uint<W>>(), ...);
}

/// op on every pair of CrossedWidths and signs.
template <class Op>
std::vector<Row> crossed_rows(Op) {
  std::vector<Row> all;
  with_types(
      [&all]<class A>() {
        with_types([&all]<class B>() { all.push_back(row<Op, A, B>()); }, CrossedWidths{});
      },
      CrossedWidths{});
  return all;
}
inline constexpr std::size_t crossed_row_count = 8 * 8;

/// The same, and op on every one of EdgeWidths and signs with some other width.
template <class Op>
std::vector<Row> rows(Op op) {
  std::vector<Row> all = crossed_rows(op);
  with_types(
      [&all]<class A>() {
        all.push_back(row<Op, A, ap_base<(A::width * 37 + 11) % 128 + 1, A::width % 4 < 2>>());
      },
      EdgeWidths{});
  return all;
}
inline constexpr std::size_t row_count = crossed_row_count + 2 * 14;

/// op(a) for EdgeWidths and both signs.
template <class Op>
std::vector<Row> rows_of_one(Op) {
  std::vector<Row> all;
  with_types(
      [&all]<class A>() {
        using R = std::remove_cvref_t<decltype(Op{}(std::declval<const A&>()))>;
        all.push_back({type_of<A>, type_of<A>, type_of<R>,
                       [](const Raw& a, const Raw&) { return raw_of(value_of(Op{}(make<A>(a)))); }});
      },
      EdgeWidths{});
  return all;
}
inline constexpr std::size_t one_row_count = 2 * 14;

/// Selects the variant of an operation and its two arguments i and j, all below 256. So one compiled row
/// serves all variants of an operation. Together they are the second operand, in hex 0xkkjjii.
struct Choice {
  int variant;
  int i;
  int j;

  explicit Choice(const Raw& raw)
      : variant(static_cast<int>(raw[0] >> 16)),
        i(static_cast<int>(raw[0] & 0xff)),
        j(static_cast<int>(raw[0] >> 8 & 0xff)) {}
  Choice(int variant_, int i_, int j_) : variant(variant_), i(i_), j(j_) {}
  Integer operand() const { return Integer(variant << 16 | j << 8 | i); }
};

/// op(a, choice) for EdgeWidths and both signs. The result is an ap_int<130>, which holds any value or
/// pattern.
template <class Op>
std::vector<Row> rows_of_choice(Op) {
  std::vector<Row> all;
  with_types(
      [&all]<class A>() {
        using R = ap_int<130>;
        all.push_back({type_of<A>, {24, false}, type_of<R>, [](const Raw& a, const Raw& choice) {
                         return raw_of(R(Op{}(make<A>(a), Choice(choice))));
                       }});
      },
      EdgeWidths{});
  return all;
}
inline constexpr std::size_t choice_row_count = 2 * 14;

}  // namespace hitpipe::hls::exact
