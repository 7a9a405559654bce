// The lines of a file or of standard input, read piece by piece. A line has at most 64 KiB, so memory does
// not depend on the file.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::sim {

class LineReader {
 public:
  /// "-" is standard input. Throws std::runtime_error, one line, when the file cannot be opened.
  explicit LineReader(const std::string& file);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The next line without its end, which may be LF or CR LF; it is valid until the next call. Nothing at the
  /// end of the file. Throws std::runtime_error, one line.
  [[nodiscard]] std::optional<std::string_view> next();
  /// Of the line that next() gave, from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// The file's name as messages have it.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The share of the file that next() has given; nothing for a pipe.
  [[nodiscard]] std::optional<double> share() const;

 private:
  /// Moves what is left to the front and reads more behind it. False at the end of the file.
  bool fill();

  std::string name_;
  std::FILE* file_;
  std::uint64_t size_ = 0;   ///< of a file; 0: not known
  std::uint64_t given_ = 0;  ///< bytes
  std::uint64_t number_ = 0;
  std::vector<char> buffer_;
  std::size_t from_ = 0;  ///< in buffer_, what has not been given
  std::size_t to_ = 0;
};

}  // namespace hitpipe::sim
