// The options of the commands that map a module to a target.
#pragma once

#include <string>

#include "sim/implement/unit_implementation.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

/// --target, a built-in one or a file.
CLI::Option* add_target_option(CLI::App& command, std::string& target);
/// --out, --library and --name of what is mapped.
void add_implement_options(CLI::App& command, sim::ImplementOptions& options);
/// --seeds of the placement. `more` ends its help.
CLI::Option* add_seeds_option(CLI::App& command, int& seeds, const std::string& more = "");

}  // namespace hitpipe::cli
