// What a command prints: rows of named values, as aligned text, CSV or JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// Keys in the order they are printed.
using Row = nlohmann::ordered_json;

enum class Format { text, csv, json };

/// Adds --format text|csv|json to a command.
void add_format_option(CLI::App& command, Format& format);

/// One line a row under a header; JSON: an array of objects. All rows have the keys of the first.
[[nodiscard]] std::string table_text(const std::vector<Row>& rows, Format format);

/// One line a value; CSV and JSON: one row, one object. A value may be an array of strings: one line each, in
/// CSV one cell with blanks between them.
[[nodiscard]] std::string record_text(const Row& row, Format format);

}  // namespace hitpipe::cli
