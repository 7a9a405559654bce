// A table of the thesis run again, as people, spreadsheets and programs read it.
#pragma once

#include <string>

#include "cli/text/table.hpp"
#include "sw_ref/experiment/result.hpp"

namespace hitpipe::cli {

/// Text: rows grouped by their first label, each with a line of ours and a line of the thesis's figures, then
/// findings and notes. CSV: a line for each source. JSON: one object.
[[nodiscard]] std::string result_text(const ref::ResultTable& table, Format format);

}  // namespace hitpipe::cli
