// The thesis beside our runs: every statement with its figures, and how far our figures are from the
// printed figures. Markdown for people, CSV with every figure.
#pragma once

#include <string>
#include <vector>

#include "thesis/result_text.hpp"

namespace hitpipe::thesis {

/// `command` is what a reader types to make the page again.
[[nodiscard]] std::string reproduction_page(const std::vector<ResultTable>& tables,
                                            const std::string& command);

/// One row a figure: table, row, column, thesis, ours, its interval, their ratio, verdict.
[[nodiscard]] std::vector<Row> reproduction_rows(const std::vector<ResultTable>& tables);

}  // namespace hitpipe::thesis
