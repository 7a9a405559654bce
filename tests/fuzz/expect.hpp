// What a fuzz target demands in addition to not crashing. A failed demand prints a line and aborts. libFuzzer
// then reports the input that caused it.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace hitpipe::fuzz {

inline void expect(bool holds, std::string_view demand) {
  if (holds) return;
  std::fprintf(stderr, "broken: %.*s\n", static_cast<int>(demand.size()), demand.data());
  std::abort();
}

/// A message that a user sees.
inline void expect_one_line(std::string_view message) {
  expect(!message.empty() && message.find('\n') == std::string_view::npos, "a message is one line");
}

}  // namespace hitpipe::fuzz
