// Reads a text file word by word, in pieces, so that neither long files nor long lines take memory. Words are
// parted by blanks; # starts a comment that ends with its line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::ref {

class WordReader {
 public:
  static constexpr std::size_t longest_word = 256;

  /// Throws std::runtime_error, the reason without the file's name, when the file cannot be read. So do the
  /// functions below, and also for a longer word.
  explicit WordReader(const std::filesystem::path& file);

  /// Goes to the next line that has a word. False at the end of the file.
  bool next_line();
  /// The next word of the line; empty at its end. It is valid until the next call of a function.
  std::string_view word();
  /// Of the current line, from 1. At the end of the file, of the last line with a word.
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  static constexpr int end_of_file = -1;

  /// The byte at at_, or end_of_file.
  int peek();
  void refill();

  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::uint64_t line_ = 1;
  std::uint64_t last_with_words_ = 1;
  bool started_ = false;
};

/// A word of a file for a message: at most 40 characters, all of them printable.
[[nodiscard]] std::string quoted(std::string_view word);

}  // namespace hitpipe::ref
