// A CSV file of numbers. Its first line names the columns, which may have any order. Empty lines and lines
// that start with '#' are left out. Blanks around a cell do not count.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/operands/line_reader.hpp"

namespace hitpipe::sim {

struct NumberLine {
  std::uint64_t number = 0;  ///< in the file, from 1
  std::string text;
};

class NumberFile {
 public:
  /// Reads the header. All `needed` columns must be there, `optional` ones may be, and no others. Throws
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
