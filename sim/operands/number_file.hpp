// Numbers as a user writes them: decimal (-0.25, 1e-3) or in C's hexadecimal form (-0x1p-2). Infinities and
// NaN are no numbers.
// The lines of a file or of standard input, read piece by piece. A line has at most 64 KiB, so memory does
// not depend on the file.
// A CSV file of numbers. Its first line names the columns, which may have any order. Empty lines and lines
// that start with '#' are left out. Blanks around a cell do not count. A cell may be in quotes (RFC 4180), but
// not go on in another line.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::sim {

enum class Rounding { down, up };

/// The nearest double, which is infinite beyond the largest; nothing if the word is no number.
[[nodiscard]] std::optional<double> read_double(std::string_view word);
/// The nearest binary32. `word` must be a number.
[[nodiscard]] float nearest_binary32(std::string_view word);
/// The nearest double on this side of the number. `word` must be a number.
[[nodiscard]] double read_double(std::string_view word, Rounding side);

/// The nearest binary32 on this side of a sum of two doubles. The sum is exact, |rest| is at most an ulp of
/// `most` and most is within the range of binary32.
[[nodiscard]] float to_binary32(double most, double rest, Rounding side);

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

struct NumberLine {
  std::uint64_t number = 0;  ///< in the file, from 1
  std::string text;
};

class NumberFile {
 public:
  /// Reads the header. All `needed` columns must be there, `optional` columns may be, and no others. Throws
  /// std::runtime_error, one line that names the file and the line, as all functions do.
  NumberFile(const std::string& file, std::vector<std::string> needed,
             std::vector<std::string> optional = {});

  /// The next line with numbers; nothing at the end of the file.
  [[nodiscard]] std::optional<NumberLine> next();

  /// The words of a line by column, first the needed and then the optional ones; a column that the file does
  /// not have is empty. Any thread may ask.
  void words(const NumberLine& line, std::span<std::string_view> out) const;
  [[nodiscard]] std::size_t columns() const { return names_.size(); }
  [[nodiscard]] const std::string& column(std::size_t i) const { return names_[i]; }

  [[nodiscard]] const std::string& name() const { return reader_.name(); }
  [[nodiscard]] std::optional<double> share() const { return reader_.share(); }
  /// Says what is wrong with a line.
  [[noreturn]] void reject(const NumberLine& line, const std::string& why) const;

 private:
  void read_header(std::size_t needed);

  LineReader reader_;
  std::vector<std::string> names_;
  std::vector<std::size_t> place_of_cell_;  ///< in names_, of each cell of a line
};

}  // namespace hitpipe::sim
