// Text in lines of at most 80 columns.
#pragma once

#include <string>

namespace hitpipe::cli {

inline constexpr std::size_t line_width = 80;

/// Breaks text into lines of at most `width`. The first line starts at `column`; later lines are indented. A
/// longer word has a line of its own. Ends the last line.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t indent, std::size_t column = 0,
                                  std::size_t width = line_width);

}  // namespace hitpipe::cli
