// Lines of a vector file, which tests damage.
#pragma once

#include <cstddef>
#include <string>

namespace hitpipe::rtl {

/// Where the line of a vector begins, after comments.
inline std::size_t place_of_vector(const std::string& text, int vector) {
  std::size_t at = 0;
  while (text.compare(at, 2, "//") == 0 || vector-- > 0) at = text.find('\n', at) + 1;
  return at;
}

/// The text with one bit of a vector inverted. Bit 0 is the lowest of the last digit.
inline std::string with_bit_inverted(std::string text, int vector, int bit) {
  const std::size_t end = text.find('\n', place_of_vector(text, vector));
  char& digit = text[end - 1 - static_cast<std::size_t>(bit) / 4];
  digit = "0123456789abcdef"[std::stoi(std::string(1, digit), nullptr, 16) ^ (1 << bit % 4)];
  return text;
}

}  // namespace hitpipe::rtl
