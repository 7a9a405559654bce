// The commands, in the order of the help. To add one, add its name here and write commands/NAME_command.cpp.
#pragma once

namespace CLI {
class App;
}

#define HITPIPE_COMMANDS(COMMAND) \
  COMMAND(designs)                \
  COMMAND(libraries)              \
  COMMAND(scenes)                 \
  COMMAND(rtl)                    \
  COMMAND(area)                   \
  COMMAND(implement)              \
  COMMAND(bvh)                    \
  COMMAND(render)                 \
  COMMAND(compare)                \
  COMMAND(cosim)                  \
  COMMAND(sweep)                  \
  COMMAND(table)                  \
  COMMAND(reproduce)              \
  COMMAND(check)                  \
  COMMAND(operands)               \
  COMMAND(board)                  \
  COMMAND(stiffness)              \
  COMMAND(rescale)                \
  COMMAND(fit)                    \
  COMMAND(report)

namespace hitpipe::cli {

/// The function of each command adds it, with its options, to the program. A command that has run leaves its
/// exit code in `exit_code`. Errors are std::exception with one line of text.
#define HITPIPE_DECLARE_COMMAND(name) void add_##name##_command(CLI::App& program, int& exit_code);
HITPIPE_COMMANDS(HITPIPE_DECLARE_COMMAND)
#undef HITPIPE_DECLARE_COMMAND

/// Adds all commands.
inline void add_commands(CLI::App& program, int& exit_code) {
#define HITPIPE_ADD_COMMAND(name) add_##name##_command(program, exit_code);
  HITPIPE_COMMANDS(HITPIPE_ADD_COMMAND)
#undef HITPIPE_ADD_COMMAND
}

}  // namespace hitpipe::cli
