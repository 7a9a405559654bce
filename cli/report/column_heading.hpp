// Headings of a page's columns in words: a column of a CSV file is called "clock_mhz", on a page "clock,
// MHz".
#pragma once

#include <string>
#include <string_view>

namespace hitpipe::cli {

/// Text that is no name of a column stays as it is.
[[nodiscard]] std::string column_heading(std::string_view column);

}  // namespace hitpipe::cli
