#include "cli/options/talk_options.hpp"

#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "host/talk.hpp"

namespace hitpipe::cli {

void add_talk_options(CLI::App& program) {
  CLI::Option* const quiet = program.add_flag_callback(
      quiet_option, [] { host::set_talk(host::Talk::quiet); },
      "Errors alone on standard error: no progress, no notes");
  CLI::Option* const verbose = program.add_flag_callback(
      verbose_option, [] { host::set_talk(host::Talk::verbose); },
      "Steps on standard error, and the programs that are started");
  exclude(verbose, quiet, "one says less, the other more");
  for (CLI::App* const command : program.get_subcommands({})) add_talk_options(*command);
}

}  // namespace hitpipe::cli
