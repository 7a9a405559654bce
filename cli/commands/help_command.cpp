#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/text/help.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

CLI::App* add_help_command(CLI::App& program, int& /*exit_code*/) {
  CLI::App* const command = program.add_subcommand("help", "Print what a command does and takes");
  const auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("command", *words, "The command, for example core rtl. Without it: all commands")
      ->type_name("COMMAND");
  add_examples(*command, {"hitpipe help rtl", "hitpipe help core trace"});
  command->callback([&program, words] {
    const CLI::App* named = &program;
    std::string above;
    for (const std::string& word : *words) {
      above += (above.empty() ? "" : " ") + named->get_name();
      const auto commands = named->get_subcommands({});
      const auto found = std::find_if(commands.begin(), commands.end(),
                                      [&](const CLI::App* each) { return each->get_name() == word; });
      if (found == commands.end())
        throw std::runtime_error(fmt::format("{} has no command {}; there are: {}", above,
                                             host::shortened(word), command_names(*named)));
      named = *found;
    }
    fmt::print("{}", named->get_formatter()->make_help(named, full_name(*named), CLI::AppFormatMode::Normal));
  });
  return command;
}

}  // namespace hitpipe::cli
