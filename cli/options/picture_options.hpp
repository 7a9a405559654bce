// How wide the plots of a command are.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/report/picture.hpp"

namespace hitpipe::cli {

/// --plot-width, with a unit: for a paper. Without it `form` stays.
CLI::Option* add_plot_width_option(CLI::App& command, PictureForm& form, const std::string& when = "");

}  // namespace hitpipe::cli
