// The CSV file that holds a sweep's whole state: a comment that says what was measured, the header, and the
// finished rows. It is replaced as a whole or grows by a row; only a run that is killed while it writes can
// leave half a row at the end.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::sim {

struct RowsFile {
  std::string about;  ///< without "# " and the line end
  std::vector<SweepRow> rows;
};

/// A name as a cell or a comment of the file: each control character becomes a blank. A scene's name can come
/// from a file name, which may hold any.
[[nodiscard]] std::string printable(std::string text);

/// What a file begins with: the comment and the header, with the columns of intervals or without.
[[nodiscard]] std::string head_text(const std::string& about, bool intervals);

/// The header and a line for each row.
[[nodiscard]] std::string to_csv(std::span<const SweepRow> rows);

/// The text of the file: the comment, then to_csv().
[[nodiscard]] std::string to_text(const RowsFile& rows);

/// Throws std::runtime_error, one line that names `source`, for text that to_text() cannot have written.
[[nodiscard]] RowsFile parse_rows(const std::string& text, const std::string& source);

/// Throws what parse_rows() throws, and std::runtime_error when the file cannot be read.
[[nodiscard]] RowsFile read_rows(const std::filesystem::path& file);

/// Writes a file beside it and renames that. Throws std::runtime_error, one line.
void write_rows(const std::filesystem::path& file, const RowsFile& rows);

}  // namespace hitpipe::sim
