// The figures that the thesis prints, as data: printed/*.csv, compiled in. Its author measured the times on a
// Pentium 4, 3.0 GHz.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::thesis {

/// One row of a printed table; its cells by column name.
class PrintedRow {
 public:
  using Columns = std::shared_ptr<const std::vector<std::string>>;
  PrintedRow(Columns columns, std::vector<std::string> cells);

  /// The cell as text, "" if nothing is printed. Throws std::out_of_range for an unknown column.
  [[nodiscard]] const std::string& text(std::string_view column) const;
  /// The cell as a number; nothing if nothing is printed. Throws as text() does.
  [[nodiscard]] std::optional<double> number(std::string_view column) const;

 private:
  Columns columns_;
  std::vector<std::string> cells_;
};

class PrintedTable {
 public:
  /// Text with a header line, then one row a line, without quotes. Throws std::logic_error for a row that is
  /// cut short.
  explicit PrintedTable(std::string_view csv);

  [[nodiscard]] const std::vector<std::string>& columns() const { return *columns_; }
  [[nodiscard]] const std::vector<PrintedRow>& rows() const { return rows_; }

  /// The row whose leading columns hold these texts; null if none.
  [[nodiscard]] const PrintedRow* find(const std::vector<std::string_view>& keys) const;

 private:
  PrintedRow::Columns columns_;
  std::vector<PrintedRow> rows_;
};

/// The table of a number, "3.1" to "6.7" or "B.1" to "B.8", or "scenes" (figures 4.1, 4.2, 5.4). Throws
/// std::out_of_range for any other.
[[nodiscard]] const PrintedTable& printed_table(std::string_view number);

}  // namespace hitpipe::thesis
