// Numbers in the text of mesh files.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace hitpipe::ref {

/// For a decimal number whose value no type holds: true if it is too large, false if it is too close to 0.
inline bool decimal_is_large(std::string_view digits) {
  const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
  std::int64_t power = 0;
  if (e < digits.size()) {
    std::string_view exponent = digits.substr(e + 1);
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    const auto result = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
    if (result.ec == std::errc::result_out_of_range) return !exponent.starts_with('-');
  }
  const std::string_view mantissa = digits.substr(0, e);
  const auto point = static_cast<std::int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  return point - static_cast<std::int64_t>(mantissa.find_first_of("123456789")) + power > 0;
}

/// The number that the whole word is, rounded once; nothing if it is none. A number that is too large is
/// infinite. "nan" and "inf" are numbers here; a caller that needs finite ones has to look.
template <class Number>
[[nodiscard]] std::optional<Number> decimal(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  Number number{};
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error != std::errc::result_out_of_range) return number;
  const bool negative = word.starts_with('-');
  number = decimal_is_large(word.substr(negative ? 1 : 0)) ? std::numeric_limits<Number>::infinity() : 0;
  return negative ? -number : number;
}

}  // namespace hitpipe::ref
