// How wide the plots of a command are.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

/// --plot-width, with a unit: for a paper.
CLI::Option* add_plot_width_option(CLI::App& command, std::optional<double>& width_mm,
                                   const std::string& when = "");

}  // namespace hitpipe::cli
