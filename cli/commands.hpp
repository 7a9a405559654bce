// The commands in the order of the help, each with what a user wants of it; the help lists none without. To add one,
// add its line here and write commands/NAME_command.cpp.
#pragma once

#include <CLI/CLI.hpp>

#define HITPIPE_COMMANDS(COMMAND)          \
  COMMAND("Take a unit", rtl)              \
  COMMAND("Take a unit", operands)         \
  COMMAND("Take a unit", list)             \
  COMMAND("Judge it", check)               \
  COMMAND("Judge it", cosim)               \
  COMMAND("Judge it", render)              \
  COMMAND("Judge it", bvh)                 \
  COMMAND("Choose it", area)               \
  COMMAND("Choose it", sweep)              \
  COMMAND("Choose it", fit)                \
  COMMAND("Choose it", report)             \
  COMMAND("Put it onto a chip", implement) \
  COMMAND("Put it onto a chip", board)     \
  COMMAND("Take a whole core", core)       \
  COMMAND("The thesis", table)             \
  COMMAND("", help)

/// The commands of `core`; the files are commands/core_NAME_command.cpp.
#define HITPIPE_CORE_COMMANDS(COMMAND)     \
  COMMAND("Take it", rtl)                  \
  COMMAND("Take it", image)                \
  COMMAND("Judge it", trace)               \
  COMMAND("Judge it", replay)              \
  COMMAND("Choose it", area)               \
  COMMAND("Choose it", fit)                \
  COMMAND("Put it onto a chip", implement) \
  COMMAND("Put it onto a chip", board)

namespace hitpipe::cli {

/// The function of each command adds it, with its options, to the program and returns it. A command that has
/// run leaves its exit code in `exit_code`. Errors are std::exception with one line of text.
#define HITPIPE_DECLARE_COMMAND(purpose, name) \
  CLI::App* add_##name##_command(CLI::App& program, int& exit_code);
HITPIPE_COMMANDS(HITPIPE_DECLARE_COMMAND)
#undef HITPIPE_DECLARE_COMMAND
#define HITPIPE_DECLARE_COMMAND(purpose, name) \
  CLI::App* add_core_##name##_command(CLI::App& core, int& exit_code);
HITPIPE_CORE_COMMANDS(HITPIPE_DECLARE_COMMAND)
#undef HITPIPE_DECLARE_COMMAND

/// Adds all commands.
inline void add_commands(CLI::App& program, int& exit_code) {
#define HITPIPE_ADD_COMMAND(purpose, name) add_##name##_command(program, exit_code)->group(purpose);
  HITPIPE_COMMANDS(HITPIPE_ADD_COMMAND)
#undef HITPIPE_ADD_COMMAND
}

}  // namespace hitpipe::cli
