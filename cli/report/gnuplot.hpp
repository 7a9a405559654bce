// gnuplot as a drawer of SVG, and what every plot of hitpipe needs of it.
#pragma once

#include <string>

namespace hitpipe::cli {

/// A gnuplot string that is taken as it is.
[[nodiscard]] std::string gnuplot_string(const std::string& text);

/// What gnuplot prints for the program `script`. Throws std::runtime_error, one line that begins with
/// `command`, when gnuplot is missing or fails.
[[nodiscard]] std::string run_gnuplot(const std::string& command, const std::string& script);

}  // namespace hitpipe::cli
