#include "cli/wrap.hpp"

#include <sstream>

namespace hitpipe::cli {

namespace {

constexpr std::size_t line_width = 80;

}  // namespace

std::string wrapped(const std::string& text, std::size_t indent, std::size_t column) {
  std::string lines;
  std::istringstream words(text);
  for (std::string word; words >> word; column += word.size()) {
    if (column > indent && column + 1 + word.size() > line_width) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!lines.empty()) {
      lines += ' ';
      ++column;
    }
    lines += word;
  }
  return lines + "\n";
}

}  // namespace hitpipe::cli
