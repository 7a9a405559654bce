// How readers and writers of files refuse: with one line that says what is wrong, where, and what is allowed.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hitpipe::ref {

[[noreturn]] inline void reject(const std::string& reason) {
  throw std::runtime_error(reason);
}

/// What a message quotes from a broken file can contain line breaks and other control characters.
[[nodiscard]] inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  return text;
}

}  // namespace hitpipe::ref
