// gnuplot draws SVG for all plots of hitpipe.
#pragma once

#include <string>

namespace hitpipe::cli {

/// A gnuplot string that gnuplot takes literally.
[[nodiscard]] std::string gnuplot_string(const std::string& text);

/// The output of gnuplot for the program `script`. Throws std::runtime_error, one line that begins with
/// `command`, when gnuplot is missing or fails.
[[nodiscard]] std::string run_gnuplot(const std::string& command, const std::string& script);

}  // namespace hitpipe::cli
