#include "cli/text/help.hpp"

#include <algorithm>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::size_t name_width = 33;  // the longest name with its value: --format text|csv|json=text
constexpr std::size_t command_width = 13;

/// Without the last line end, because CLI adds one.
std::string in_lines(const std::string& text, std::size_t width) {
  std::string lines = host::wrapped(text, 0, 0, width);
  lines.pop_back();
  return lines;
}

/// The option as one types it: "--out FOLDER", or "NAME..." without a name of its own.
std::string typed(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (!option.get_positional())
    return option.get_name() + (option.get_items_expected_max() == 0 ? "" : " " + type);
  return type + (option.get_items_expected_max() > 1 ? "..." : "");
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(name_width);
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_usage(const CLI::App* app, std::string name) const {
  std::vector<std::string> required;
  std::vector<std::string> more;
  for (const CLI::Option* const option : app->get_options()) {
    if (option->get_required())
      required.push_back(typed(*option));
    else if (option->get_positional())
      required.push_back("[" + typed(*option) + "]");
    else if (more.empty())
      more.emplace_back("[OPTION...]");
  }
  if (const auto choice = choices.find(app); choice != choices.end()) {
    std::vector<std::string> words;
    for (const CLI::Option* const option : choice->second) words.push_back(typed(*option));
    required.push_back(fmt::format("({})", fmt::join(words, " | ")));
  }
  if (!app->get_subcommands({}).empty()) required.emplace_back("COMMAND");
  required.insert(required.end(), more.begin(), more.end());
  return host::wrapped(fmt::format("Usage: {} {}", name, fmt::join(required, " ")), 0, 4);
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return host::wrapped(app->get_description(), 0);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_name(),
                           in_lines(command->get_description(), host::line_width - command_width),
                           command_width);
  return out.str();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return in_lines(option->get_description(), host::line_width - name_width);
}

void needs_one_of(CLI::App& command, const std::vector<CLI::Option*>& options) {
  auto& choice = std::dynamic_pointer_cast<HelpFormatter>(command.get_formatter())->choices[&command];
  choice.assign(options.begin(), options.end());
  command.parse_complete_callback([options] {
    if (std::any_of(options.begin(), options.end(),
                    [](const CLI::Option* each) { return each->count() > 0; }))
      return;
    std::vector<std::string> names;
    for (const CLI::Option* const each : options) names.push_back(each->get_name());
    throw CLI::RequiredError(fmt::format("{}", fmt::join(names, " or ")));
  });
}

void add_examples(CLI::App& command, const std::vector<std::string>& lines) {
  command.footer(fmt::format("Examples:\n  {}", fmt::join(lines, "\n  ")));
}

const std::vector<std::string>& talk_options() {
  static const std::vector<std::string> names{quiet_option, verbose_option};
  return names;
}

std::string full_name(const CLI::App& command) {
  const CLI::App* const parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + " " + command.get_name();
}

std::string command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* const each : command.get_subcommands({})) names.push_back(each->get_name());
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace hitpipe::cli
