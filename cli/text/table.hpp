// What a command prints: rows of named values, as aligned text, CSV or JSON.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace hitpipe::cli {

/// Keys are in the order in which they are printed.
using Row = nlohmann::ordered_json;

enum class OutputFormat { text, csv, json };

struct Cell {
  std::string text;
  bool right = false;  ///< where it stands in a wider column
};

/// Columns as wide as their widest cells, with `gap` blanks between them. All rows have as many cells.
[[nodiscard]] std::string aligned(const std::vector<std::vector<Cell>>& rows, std::size_t gap = 2);

/// One line for each row, under a header. JSON: an array of objects. All rows have the keys of the first.
[[nodiscard]] std::string table_text(const std::vector<Row>& rows, OutputFormat format);

/// Text for few rows of many keys: one line for each key, one column for each row. The first key is not shown;
/// its values head the columns. A key that has a value in no row has no line.
[[nodiscard]] std::string columns_text(const std::vector<Row>& rows);

/// One line for each value. CSV: one row. JSON: one object. A value may be an array of strings: text has one
/// line for each, CSV has one cell with blanks between them.
[[nodiscard]] std::string record_text(const Row& row, OutputFormat format);

}  // namespace hitpipe::cli
