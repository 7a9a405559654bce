#include "sim/operands/number.hpp"

#include <cfenv>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>

#ifdef __FAST_MATH__
#error "directed rounding needs IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::sim {

namespace {

/// A number without its sign, as from_chars() takes it.
struct Digits {
  std::string_view text;
  std::chars_format form = std::chars_format::general;
  bool negative = false;
};

Digits digits_of(std::string_view word) {
  Digits digits{word};
  if (word.starts_with('-') || word.starts_with('+')) {
    digits.negative = word.front() == '-';
    digits.text.remove_prefix(1);
  }
  if (digits.text.starts_with("0x") || digits.text.starts_with("0X")) {
    digits.form = std::chars_format::hex;
    digits.text.remove_prefix(2);
  }
  return digits;
}

/// What from_chars() may also take: inf, nan and a second sign.
bool starts_as_number(const Digits& digits) {
  if (digits.text.empty()) return false;
  const char first = digits.text.front();
  const bool digit = first >= '0' && first <= '9';
  const bool letter = (first >= 'a' && first <= 'f') || (first >= 'A' && first <= 'F');
  return digit || first == '.' || (letter && digits.form == std::chars_format::hex);
}

/// The C library rounds text to the side that is set.
class RoundTo {
 public:
  explicit RoundTo(Rounding side) : before_(std::fegetround()) {
    std::fesetround(side == Rounding::down ? FE_DOWNWARD : FE_UPWARD);
  }
  ~RoundTo() { std::fesetround(before_); }
  RoundTo(const RoundTo&) = delete;
  RoundTo& operator=(const RoundTo&) = delete;

 private:
  int before_;
};

}  // namespace

std::optional<double> read_double(std::string_view word) {
  const Digits digits = digits_of(word);
  if (!starts_as_number(digits)) return std::nullopt;
  double value = 0;
  const char* const end = digits.text.data() + digits.text.size();
  const auto [stop, error] = std::from_chars(digits.text.data(), end, value, digits.form);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  // Too large or too small: from_chars() leaves the value alone.
  if (error != std::errc{}) return std::strtod(std::string(word).c_str(), nullptr);
  return digits.negative ? -value : value;
}

float nearest_binary32(std::string_view word) {
  const Digits digits = digits_of(word);
  float value = 0;
  const char* const end = digits.text.data() + digits.text.size();
  const auto [stop, error] = std::from_chars(digits.text.data(), end, value, digits.form);
  if (error != std::errc{}) return std::strtof(std::string(word).c_str(), nullptr);
  return digits.negative ? -value : value;
}

double read_double(std::string_view word, Rounding side) {
  const std::string text(word);
  const RoundTo rounding(side);
  return std::strtod(text.c_str(), nullptr);
}

float to_binary32(double most, double rest, Rounding side) {
  const auto nearest = static_cast<float>(most);
  const double above = most - nearest;  // exact: a binary32 is the nearest of 53 bits
  // Rounding is monotone, so the rounded sum has the sign of the exact one.
  const double beyond = above + rest;
  if (side == Rounding::down)
    return beyond < 0 ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
  return beyond > 0 ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

}  // namespace hitpipe::sim
