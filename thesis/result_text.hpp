// Results of repeating a table of the thesis, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "thesis/result.hpp"

namespace hitpipe::thesis {

/// Named values in the order in which they are printed.
using Row = nlohmann::ordered_json;

/// Rows in groups by their first label, each with a line of our figures and a line of the thesis's; then
/// findings and notes.
[[nodiscard]] std::string result_text(const ResultTable& table);

/// A row for each source of figures. All have the same keys.
[[nodiscard]] std::vector<Row> result_rows(const ResultTable& table);

/// The whole table as one object.
[[nodiscard]] Row result_record(const ResultTable& table);

}  // namespace hitpipe::thesis
