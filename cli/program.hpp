// The program hitpipe as a function, for a program with designs of its own (docs/designs.md).
#pragma once

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// Gives it all commands and options. A command that has run leaves its exit code.
void fill(CLI::App& program, int& exit_code);

/// Parses the command line, runs the command and returns the exit code (docs/README.md). Errors go to
/// standard error, one line each.
[[nodiscard]] int run(int argc, char** argv);

}  // namespace hitpipe::cli
