// All that a pipeline does with integers, as a table that compares one value domain with another.
#pragma once

#include <tuple>
#include <type_traits>
#include <utility>

#include "hls/num/bits.hpp"
#include "hls/num/domain.hpp"

namespace hitpipe::hls::exact {

template <class Op>
struct DomainOperator {
  const char* name;
  Op apply;  ///< applied in a domain to two of its values
};
template <class Op>
DomainOperator(const char*, Op) -> DomainOperator<Op>;

/// b in the type of a.
template <class A, class B>
auto in_type_of(const A& a, const B& b) {
  const auto resized = resize(b, width_of(a));
  if constexpr (A::is_signed) {
    return as_signed(resized);
  } else {
    return as_unsigned(resized);
  }
}

// clang-format off
inline constexpr auto domain_operators = std::make_tuple(
    DomainOperator{"a + b", [](auto, const auto& a, const auto& b) { return a + b; }},
    DomainOperator{"a - b", [](auto, const auto& a, const auto& b) { return a - b; }},
    DomainOperator{"a * b", [](auto, const auto& a, const auto& b) { return a * b; }},
    DomainOperator{"a & b", [](auto, const auto& a, const auto& b) { return a & b; }},
    DomainOperator{"a | b", [](auto, const auto& a, const auto& b) { return a | b; }},
    DomainOperator{"a ^ b", [](auto, const auto& a, const auto& b) { return a ^ b; }},
    DomainOperator{"~a", [](auto, const auto& a, const auto&) { return ~a; }},
    DomainOperator{"a < b", []<class D>(D, const auto& a, const auto& b) { return typename D::bit(a < b); }},
    DomainOperator{"a > b", []<class D>(D, const auto& a, const auto& b) { return typename D::bit(a > b); }},
    DomainOperator{"a <= b", []<class D>(D, const auto& a, const auto& b) { return typename D::bit(a <= b); }},
    DomainOperator{"a >= b", []<class D>(D, const auto& a, const auto& b) { return typename D::bit(a >= b); }},
    DomainOperator{"a == b", []<class D>(D, const auto& a, const auto& b) { return typename D::bit(a == b); }},
    DomainOperator{"a != b", []<class D>(D, const auto& a, const auto& b) { return typename D::bit(a != b); }},
    DomainOperator{"slice", [](auto, const auto& a, const auto&) {
      return slice(a, width_of(a) - 1_w, width_of(a) / 2_w); }},
    DomainOperator{"bit_at", [](auto, const auto& a, const auto&) { return bit_at(a, width_of(a) / 2_w); }},
    DomainOperator{"sign", [](auto, const auto& a, const auto&) { return sign(a); }},
    DomainOperator{"any", []<class D>(D, const auto& a, const auto&) { return any<D>(a); }},
    DomainOperator{"spread", [](auto, const auto& a, const auto& b) { return spread(sign(a), width_of(b)); }},
    DomainOperator{"cat", [](auto, const auto& a, const auto& b) { return cat(a, b); }},
    DomainOperator{"select", []<class D>(D, const auto& a, const auto& b) {
      return select(typename D::bit(a < b), a, in_type_of(a, b)); }},
    DomainOperator{"resize up", [](auto, const auto& a, const auto&) { return resize(a, 64_w); }},
    DomainOperator{"resize down", [](auto, const auto& a, const auto&) { return resize(a, (width_of(a) + 1_w) / 2_w); }},
    DomainOperator{"resize to b", [](auto, const auto& a, const auto& b) { return resize(a, width_of(b)); }},
    DomainOperator{"as signed", [](auto, const auto& a, const auto&) { return as_signed(a); }},
    DomainOperator{"as unsigned", [](auto, const auto& a, const auto&) { return as_unsigned(a); }},
    DomainOperator{"lit", []<class D>(D, const auto& a, const auto&) { return a + D::lit(0x33, 5_w); }},
    DomainOperator{"lit of -3", []<class D>(D, const auto& a, const auto&) { return a - as_signed(D::lit(-3, 7_w)); }},
    DomainOperator{"as", [](auto, const auto& a, const auto& b) { return as("named", a) - as("named", 'x', b); }});
// clang-format on

/// The type of an operator's result in the native domain.
template <class Op, class A, class B>
using NativeResult = decltype(std::declval<const Op&>().apply(Native(), A(), B()));

/// Calls visit(operator) for all operators whose results on these types have at most 64 bits.
template <class A, class B, class Visit>
void for_each_operator(Visit&& visit) {
  const auto one = [&]<class Op>(const DomainOperator<Op>& op) {
    if constexpr (NativeResult<DomainOperator<Op>, A, B>::width <= 64) visit(op);
  };
  std::apply([&](const auto&... op) { (one(op), ...); }, domain_operators);
}

template <int W, bool S>
constexpr std::uint64_t pattern_of(const ap_base<W, S>& x) {
  return x.to_uint64() & ~std::uint64_t{0} >> (64 - W);
}

/// Calls check.template operator()<A, B>() for pairs of native types of many widths and signs. Products of
/// all but the last have at most 64 bits.
template <class Check>
void for_each_pair_of_types(Check&& check) {
  check.template operator()<ap_uint<1>, ap_uint<1>>();
  check.template operator()<ap_int<1>, ap_int<1>>();
  check.template operator()<ap_uint<1>, ap_int<1>>();
  check.template operator()<ap_int<1>, ap_uint<1>>();
  check.template operator()<ap_int<2>, ap_uint<5>>();
  check.template operator()<ap_uint<5>, ap_int<2>>();
  check.template operator()<ap_int<8>, ap_int<8>>();
  check.template operator()<ap_uint<8>, ap_uint<8>>();
  check.template operator()<ap_int<8>, ap_uint<8>>();
  check.template operator()<ap_uint<7>, ap_int<13>>();
  check.template operator()<ap_int<13>, ap_uint<7>>();
  check.template operator()<ap_int<24>, ap_int<24>>();
  check.template operator()<ap_uint<24>, ap_int<20>>();
  check.template operator()<ap_int<20>, ap_uint<24>>();
  check.template operator()<ap_uint<31>, ap_uint<31>>();
  check.template operator()<ap_int<32>, ap_int<32>>();
  check.template operator()<ap_uint<32>, ap_int<31>>();
  check.template operator()<ap_int<3>, ap_int<30>>();
  check.template operator()<ap_uint<30>, ap_uint<3>>();
  check.template operator()<ap_uint<16>, ap_int<33>>();
  check.template operator()<ap_int<63>, ap_int<63>>();
  check.template operator()<ap_int<64>, ap_int<64>>();
  check.template operator()<ap_uint<64>, ap_uint<64>>();
}
inline constexpr int type_pair_count = 23;

}  // namespace hitpipe::hls::exact
