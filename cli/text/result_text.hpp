// Results of repeating a table of the thesis, as text, CSV or JSON.
#pragma once

#include <string>

#include "cli/text/table.hpp"
#include "sw_ref/thesis/result.hpp"

namespace hitpipe::cli {

/// Text: rows in groups by their first label, each with a line of our figures and a line of the thesis's;
/// then findings and notes. CSV: a line for each source. JSON: one object.
[[nodiscard]] std::string result_text(const ref::ResultTable& table, Format format);

}  // namespace hitpipe::cli
