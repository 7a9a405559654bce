#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "cli/text/help.hpp"

namespace hitpipe::cli {

CLI::App* add_core_command(CLI::App& program, int& exit_code) {
  CLI::App* const core = program.add_subcommand("core", "A whole traversal core: its files, cost, answers");
  core->require_subcommand(1);
#define HITPIPE_ADD_COMMAND(purpose, name) add_core_##name##_command(*core, exit_code)->group(purpose);
  HITPIPE_CORE_COMMANDS(HITPIPE_ADD_COMMAND)
#undef HITPIPE_ADD_COMMAND
  add_examples(*core, {"hitpipe core rtl --out core", "hitpipe core trace --scene spheres --out out"});
  return core;
}

}  // namespace hitpipe::cli
