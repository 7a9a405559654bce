// The CSV file that is a sweep's whole state: a comment that says what was measured, the header, and finished
// rows. It is only ever replaced whole, so it never holds half a row.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::sim {

struct RowsFile {
  std::string about;  ///< without "# " and line end
  std::vector<SweepRow> rows;
};

/// The text of the file.
[[nodiscard]] std::string to_text(const RowsFile& rows);

/// Throws std::runtime_error, one line that names `source`, for what to_text() would not have written.
[[nodiscard]] RowsFile parse_rows(const std::string& text, const std::string& source);

/// Throws as parse_rows() does, and when the file cannot be read.
[[nodiscard]] RowsFile read_rows(const std::filesystem::path& file);

/// Through a file beside it that is renamed. Throws std::runtime_error, one line.
void write_rows(const std::filesystem::path& file, const RowsFile& rows);

}  // namespace hitpipe::sim
