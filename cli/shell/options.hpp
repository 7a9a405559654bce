// The commands and options of the program as its man page and completions read them.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

/// The program's own App, then each command, in the order of the help.
[[nodiscard]] std::vector<const CLI::App*> commands_of(const CLI::App& program);

/// "core rtl"; "" for the program.
[[nodiscard]] std::string words_of(const CLI::App& command);

/// Those that help shows.
[[nodiscard]] std::vector<const CLI::Option*> options_of(const CLI::App& command);

/// {"-h", "--help"}.
[[nodiscard]] std::vector<std::string> names_of(const CLI::Option& option);

/// The words of a value such as text|csv|json, or the built-in names of a scene, library, memory, target, board or
/// design. Empty: any other value.
[[nodiscard]] std::vector<std::string> choices_of(const CLI::Option& option);
/// Whether the value may be a file too.
[[nodiscard]] bool takes_file(const CLI::Option& option);

/// What may follow the words of a command: commands, options, and names of designs and machines where it takes one.
struct Completion {
  std::string command;
  std::vector<const CLI::App*> commands;
  std::vector<const CLI::Option*> options;
  std::vector<std::string> units;
};
[[nodiscard]] std::vector<Completion> completions_of(const CLI::App& program);

/// Patterns of `case`: of a command and a word behind it that is another command, such as ' core'|'core rtl'.
[[nodiscard]] std::string command_pattern(const CLI::App& program);

[[nodiscard]] std::string man_page(const CLI::App& program);
[[nodiscard]] std::string bash_completion(const CLI::App& program);
[[nodiscard]] std::string zsh_completion(const CLI::App& program);

}  // namespace hitpipe::cli
