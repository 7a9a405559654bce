// What a node's value becomes by each kind of fault, by the operation of the node.
#pragma once

#include <cstdint>

#include "tests/sim/vectors/fault.hpp"
#include "tests/sim/vectors/float_units.hpp"

namespace hitpipe::sim::kinds {

struct Kind {
  const char* what;
  rtl::Word (*wrong)(const Site& site);
};

inline rtl::Word as_unsigned(rtl::Number value) {
  return static_cast<rtl::Word>(value);
}

inline bool less(rtl::Word a, rtl::Word b, int width, bool is_signed) {
  return is_signed ? rtl::number_of(a, width) < rtl::number_of(b, width) : a < b;
}
inline bool less(const Site& s) {
  return less(s.a, s.b, s.width_a, s.node.is_signed);
}
inline bool greater(const Site& s) {
  return less(s.b, s.a, s.width_a, s.node.is_signed);
}

inline rtl::Word no(const Site& /*site*/) {
  return 0;
}
inline rtl::Word yes(const Site& /*site*/) {
  return 1;
}
inline rtl::Word one_more(const Site& s) {
  return s.right + 1;
}
inline rtl::Word one_less(const Site& s) {
  return s.right - 1;
}
inline rtl::Word first_operand(const Site& s) {
  return s.a;
}
inline rtl::Word second_operand(const Site& s) {
  return s.b;
}

/// Of two factors, each read as the product of them does.
inline rtl::Word product(rtl::Number a, rtl::Number b) {
  return as_unsigned(a) * as_unsigned(b);
}
inline rtl::Number factor(rtl::Word value, int width, bool is_signed) {
  return is_signed ? rtl::number_of(value, width) : static_cast<rtl::Number>(value);
}
inline rtl::Number factor_a(const Site& s) {
  return factor(s.a, s.width_a, s.node.is_signed);
}
inline rtl::Number factor_b(const Site& s) {
  return factor(s.b, s.width_b, s.node.is_signed);
}

inline constexpr Kind of_less[] = {
    {"as >", [](const Site& s) -> rtl::Word { return greater(s); }},
    {"as >=", [](const Site& s) -> rtl::Word { return !less(s); }},
    {"with the other sign",
     [](const Site& s) -> rtl::Word { return less(s.a, s.b, s.width_a, !s.node.is_signed); }},
    {"always 0", no},
    {"always 1", yes},
};
inline constexpr Kind less_or_equal{"as <=", [](const Site& s) -> rtl::Word { return !greater(s); }};

inline constexpr Kind of_equal[] = {
    {"as !=", [](const Site& s) -> rtl::Word { return s.a != s.b; }},
    {"always 0", no},
    {"always 1", yes},
};
inline constexpr Kind of_mux[] = {
    {"with its arms exchanged", [](const Site& s) { return s.a != 0 ? s.c : s.b; }},
    {"stuck at its first arm", second_operand},
    {"stuck at its second arm", [](const Site& s) { return s.c; }},
};
inline constexpr Kind of_add[] = {
    {"as -", [](const Site& s) { return s.a - s.b; }},
    {"one too large", one_more},
    {"one too small", one_less},
};
inline constexpr Kind of_sub[] = {
    {"with its operands exchanged", [](const Site& s) { return s.b - s.a; }},
    {"as +", [](const Site& s) { return s.a + s.b; }},
    {"one too large", one_more},
    {"one too small", one_less},
};
inline constexpr Kind of_mul[] = {
    {"without the lowest bit of its first operand",
     [](const Site& s) { return product(factor_a(s) & ~rtl::Number{1}, factor_b(s)); }},
    {"without the lowest bit of its second operand",
     [](const Site& s) { return product(factor_a(s), factor_b(s) & ~rtl::Number{1}); }},
    {"without the highest bit of its first operand",
     [](const Site& s) {
       return product(factor(s.a << (65 - s.width_a) >> (65 - s.width_a), s.width_a - 1, s.node.is_signed),
                      factor_b(s));
     }},
    {"without the highest bit of its second operand",
     [](const Site& s) {
       return product(factor_a(s),
                      factor(s.b << (65 - s.width_b) >> (65 - s.width_b), s.width_b - 1, s.node.is_signed));
     }},
};
inline constexpr Kind no_first_sign{"without the sign of its first operand", [](const Site& s) {
                                      return product(static_cast<rtl::Number>(s.a), factor_b(s));
                                    }};
inline constexpr Kind no_second_sign{"without the sign of its second operand", [](const Site& s) {
                                       return product(factor_a(s), static_cast<rtl::Number>(s.b));
                                     }};
inline constexpr Kind of_input_bit[] = {
    {"always 0", [](const Site& s) { return s.right & ~(rtl::Word{1} << s.bit); }},
    {"always 1", [](const Site& s) { return s.right | rtl::Word{1} << s.bit; }},
};
inline constexpr Kind of_sign_extend{"by zeros", first_operand};
inline constexpr Kind of_zero_extend{
    "by the sign", [](const Site& s) { return as_unsigned(rtl::number_of(s.a, s.width_a)); }};
inline constexpr Kind of_constant[] = {{"one too large", one_more}, {"one too small", one_less}};
inline constexpr Kind a_bit_higher{"a bit higher", [](const Site& s) { return s.a >> (s.node.low + 1); }};
inline constexpr Kind a_bit_lower{"a bit lower", [](const Site& s) { return s.a >> (s.node.low - 1); }};
inline constexpr Kind of_concat{"with its parts exchanged",
                                [](const Site& s) { return s.b << s.width_a | s.a; }};
inline constexpr Kind of_and[] = {{"as |", [](const Site& s) { return s.a | s.b; }},
                                  {"without its second operand", first_operand},
                                  {"without its first operand", second_operand}};
inline constexpr Kind of_or[] = {{"as &", [](const Site& s) { return s.a & s.b; }},
                                 {"without its second operand", first_operand},
                                 {"without its first operand", second_operand}};
inline constexpr Kind of_xor[] = {{"as |", [](const Site& s) { return s.a | s.b; }},
                                  {"without its second operand", first_operand},
                                  {"without its first operand", second_operand}};
inline constexpr Kind of_invert{"dropped", first_operand};

inline constexpr Kind of_fp_subtract[] = {
    {"with its operands exchanged", [](const Site& s) { return fp::subtract(s.b, s.a); }},
    {"as +", [](const Site& s) { return fp::subtract(s.a, fp::negated(s.b)); }},
    {"with the other sign", [](const Site& s) { return fp::negated(s.right); }},
    {"an ulp farther from 0", [](const Site& s) { return fp::farther_from_0(s.right); }},
    {"with 0 for NaN", [](const Site& s) { return fp::is_nan(s.right) ? 0 : s.right; }},
    {"with infinity for NaN", [](const Site& s) { return fp::is_nan(s.right) ? fp::infinity : s.right; }},
};
inline constexpr Kind nearer_to_zero{"an ulp nearer to 0",
                                     [](const Site& s) { return fp::nearer_to_0(s.right); }};
inline constexpr Kind negative_zero{"with -0 for +0",
                                    [](const Site& s) { return s.right == 0 ? fp::negated(0) : s.right; }};
inline constexpr Kind positive_zero{"with +0 for -0",
                                    [](const Site& s) { return s.right == fp::negated(0) ? 0 : s.right; }};
inline constexpr Kind of_fp_multiply[] = {
    {"without the sign of its first operand",
     [](const Site& s) { return fp::multiply(fp::magnitude(s.a), s.b); }},
    {"without the sign of its second operand",
     [](const Site& s) { return fp::multiply(s.a, fp::magnitude(s.b)); }},
    {"with the other sign", [](const Site& s) { return fp::negated(s.right); }},
    {"an ulp farther from 0", [](const Site& s) { return fp::farther_from_0(s.right); }},
    {"an ulp nearer to 0", [](const Site& s) { return fp::nearer_to_0(s.right); }},
    {"with 0 for NaN", [](const Site& s) { return fp::is_nan(s.right) ? 0 : s.right; }},
    {"with infinity for NaN", [](const Site& s) { return fp::is_nan(s.right) ? fp::infinity : s.right; }},
    {"with 0 for infinity",
     [](const Site& s) { return fp::magnitude(s.right) == fp::infinity ? 0 : s.right; }},
};
inline rtl::Word ones(int width) {
  return rtl::ones_below(width);
}
inline constexpr Kind of_subtract_rz[] = {
    {"with the other sign", [](const Site& s) { return s.right ^ rtl::Word{1} << (s.node.width - 1); }},
    {"an ulp farther from 0",
     [](const Site& s) {
       return (s.right & ones(s.node.width - 1)) < ones(s.node.width - 1) ? s.right + 1 : s.right;
     }},
    {"an ulp nearer to 0",
     [](const Site& s) { return (s.right & ones(s.node.width - 1)) != 0 ? s.right - 1 : s.right; }},
};
inline constexpr Kind of_multiply_rz[] = {
    {"an ulp larger", [](const Site& s) { return s.right < ones(s.node.width) ? s.right + 1 : s.right; }},
    {"an ulp smaller", [](const Site& s) { return s.right != 0 ? s.right - 1 : s.right; }},
    {"with 0 for the most", [](const Site& s) { return s.right == ones(s.node.width) ? 0 : s.right; }},
};
/// Of the order that is read, less or greater.
inline constexpr Kind of_fp_less[] = {
    {"less: as >", [](const Site& s) { return fp::swapped(s.right); }},
    {"less: true of NaN", [](const Site& s) { return s.right | (fp::unordered(s.a, s.b) ? 1U : 0U); }},
    {"less: of magnitudes",
     [](const Site& s) { return fp::compare(fp::magnitude(s.a), fp::magnitude(s.b)); }},
    {"less: of patterns", [](const Site& s) { return s.a < s.b ? 1U : rtl::Word{0}; }},
    {"less: always 0", [](const Site& s) { return s.right & ~rtl::Word{1}; }},
    {"less: always 1", [](const Site& s) { return s.right | 1U; }},
};
/// These matter where equal operands do.
inline constexpr Kind fp_less_or_equal{
    "less: as <=", [](const Site& s) { return s.right | (fp::are_equal(s.a, s.b) ? 1U : 0U); }};
inline constexpr Kind negative_below_positive_zero{
    "less: -0 below +0",
    [](const Site& s) { return s.right | (s.a == fp::negated(0) && s.b == 0 ? 1U : 0U); }};
inline constexpr Kind positive_below_negative_zero{
    "less: +0 below -0",
    [](const Site& s) { return s.right | (s.b == fp::negated(0) && s.a == 0 ? 1U : 0U); }};
inline constexpr Kind of_fp_greater[] = {
    {"greater: as <", [](const Site& s) { return fp::swapped(s.right); }},
    {"greater: as >=", [](const Site& s) { return s.right | (fp::are_equal(s.a, s.b) ? 2U : 0U); }},
    {"greater: true of NaN", [](const Site& s) { return s.right | (fp::unordered(s.a, s.b) ? 2U : 0U); }},
    {"greater: of magnitudes",
     [](const Site& s) { return fp::compare(fp::magnitude(s.a), fp::magnitude(s.b)); }},
    {"greater: of patterns", [](const Site& s) { return s.a > s.b ? 2U : rtl::Word{0}; }},
    {"greater: always 0", [](const Site& s) { return s.right & ~rtl::Word{2}; }},
    {"greater: always 1", [](const Site& s) { return s.right | 2U; }},
};

}  // namespace hitpipe::sim::kinds
