// Text that tests change and count.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace hitpipe::rtl {

/// The text with `by` in place of the first `old`. Throws std::invalid_argument if `old` is not in it.
inline std::string replaced(std::string text, std::string_view old, std::string_view by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::invalid_argument("not in the text: " + std::string(old));
  return text.replace(at, old.size(), by);
}

/// How often the part is in the text.
inline int times(std::string_view text, std::string_view part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace hitpipe::rtl
