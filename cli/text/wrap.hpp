// Text in lines of at most 80 columns.
#pragma once

#include <string>

namespace hitpipe::cli {

inline constexpr std::size_t line_width = 80;

/// The words of the text in lines of at most `width`, the first from `column` on, later lines indented; a
/// longer word has a line of its own. Ends its last line.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t indent, std::size_t column = 0,
                                  std::size_t width = line_width);

}  // namespace hitpipe::cli
