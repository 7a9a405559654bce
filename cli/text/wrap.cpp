#include "cli/text/wrap.hpp"

#include <sstream>

namespace hitpipe::cli {

std::string wrapped(const std::string& text, std::size_t indent, std::size_t column, std::size_t width) {
  std::string lines;
  std::istringstream words(text);
  for (std::string word; words >> word; column += word.size()) {
    if (column > indent && column + 1 + word.size() > width) {
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
