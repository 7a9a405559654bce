// The layout of help: what is required in the usage line, names on the left, descriptions on the right,
// examples at the end, no line wider than 80 columns.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace hitpipe::cli {

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter();

  [[nodiscard]] std::string make_usage(const CLI::App* app, std::string name) const override;
  [[nodiscard]] std::string make_description(const CLI::App* app) const override;
  [[nodiscard]] std::string make_subcommand(const CLI::App* command) const override;
  [[nodiscard]] std::string make_option_desc(const CLI::Option* option) const override;

  /// Options of which a command needs one. They stand in its usage line as (ONE | OTHER).
  std::map<const CLI::App*, std::vector<const CLI::Option*>> choices;
};

/// Refuses a command line that has none of these options.
void needs_one_of(CLI::App& command, const std::vector<CLI::Option*>& options);

/// Command lines that the command's help ends with.
void add_examples(CLI::App& command, const std::vector<std::string>& lines);

inline constexpr const char* quiet_option = "--quiet";
inline constexpr const char* verbose_option = "--verbose";
/// The names of both. They change nothing of a result, so no file names them.
[[nodiscard]] const std::vector<std::string>& talk_options();

/// "hitpipe core rtl".
[[nodiscard]] std::string full_name(const CLI::App& command);

/// Of the commands of a program or of a command: "rtl, area, trace".
[[nodiscard]] std::string command_names(const CLI::App& command);

}  // namespace hitpipe::cli
