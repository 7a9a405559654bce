// Text in lines of at most 80 columns.
#pragma once

#include <string>

namespace hitpipe::cli {

/// The words of the text, the first from `column` on, later lines indented; ends its last line.
[[nodiscard]] std::string wrapped(const std::string& text, std::size_t indent, std::size_t column = 0);

}  // namespace hitpipe::cli
