// --quiet and --verbose.
#pragma once

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

/// Gives the program and each of its commands --quiet and --verbose.
void add_talk_options(CLI::App& program);

}  // namespace hitpipe::cli
