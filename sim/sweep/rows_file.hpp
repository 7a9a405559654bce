// The CSV file that holds a sweep's whole state: the header and the finished rows, each of which says what it
// was measured on. It is replaced as a whole or grows by a row; only a run that is killed while it writes can
// leave half a row at the end.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/sweep/row.hpp"

namespace hitpipe::sim {

/// A name as a cell of the file: each control character becomes a blank. A scene's name can come from a file
/// name, which may hold any.
[[nodiscard]] std::string printable(std::string text);

/// The first line, with its end.
[[nodiscard]] std::string rows_header();

/// The header and a line for each row.
[[nodiscard]] std::string to_csv(std::span<const SweepRow> rows);

/// Throws std::runtime_error, one line that names `source`, for text that to_csv() cannot have written, and
/// for rows with different subjects.
[[nodiscard]] std::vector<SweepRow> parse_rows(const std::string& text, const std::string& source);

/// Throws what parse_rows() throws, and std::runtime_error when the file cannot be read.
[[nodiscard]] std::vector<SweepRow> read_rows(const std::filesystem::path& file);

/// Replaces the file as a whole. Throws std::runtime_error when it cannot be written.
void write_rows(const std::filesystem::path& file, std::span<const SweepRow> rows);

}  // namespace hitpipe::sim
