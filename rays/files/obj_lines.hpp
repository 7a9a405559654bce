// Lines and words of OBJ and MTL files.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "host/reject.hpp"

namespace hitpipe::ref {

/// Gives the lines of a text one after the other. LF, CR LF and CR end a line. A line that ends in `\` goes
/// on in the next, but not inside a comment.
class ObjLines {
 public:
  /// Leaves out a byte order mark of UTF-8. Throws if the text is UTF-16 or UTF-32.
  explicit ObjLines(std::string_view text) : rest_(text) {
    const std::string_view start = text.substr(0, 4);
    if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF") || start.find('\0') != start.npos)
      reject("is UTF-16 or UTF-32, not text in UTF-8 or ASCII; save it as UTF-8");
    if (start.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  }

  /// False at the end. The line stays valid until the next call.
  bool next(std::string_view& line) {
    number_ += taken_;
    taken_ = 0;
    if (rest_.empty()) return false;
    line = take();
    if (!goes_on(line)) return true;
    joined_.clear();
    for (; goes_on(line); line = rest_.empty() ? std::string_view() : take()) {
      line.remove_suffix(1);
      joined_.append(line).push_back(' ');
    }
    joined_.append(line);
    line = joined_;
    return true;
  }

  /// Of the last line, or of the first of those that were joined; from 1.
  [[nodiscard]] std::size_t number() const { return number_; }

  [[noreturn]] void fail(const std::string& reason) const {
    reject(fmt::format("line {}: {}", number_, reason));
  }

 private:
  [[nodiscard]] static bool goes_on(std::string_view line) {
    return line.ends_with('\\') && line.find('#') == line.npos;
  }

  std::string_view take() {
    ++taken_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (!rest_.empty()) rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    return line;
  }

  std::string_view rest_;
  std::string joined_;
  std::size_t number_ = 1;
  std::size_t taken_ = 0;  // lines of the text that the last line was joined from
};

inline constexpr std::string_view obj_blanks = " \t\v\f";

/// Takes the next word from the front of a line; empty at its end, or where a comment begins.
inline std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(obj_blanks), line.size()));
  if (line.starts_with('#')) line = {};
  const std::string_view word = line.substr(0, line.find_first_of(" \t\v\f#"));
  line.remove_prefix(word.size());
  return word;
}

/// A name: the rest of a line without the blanks around it. It may hold blanks and #.
inline std::string_view rest_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(obj_blanks), line.size()));
  return line.substr(0, line.find_last_not_of(obj_blanks) + 1);
}

}  // namespace hitpipe::ref
