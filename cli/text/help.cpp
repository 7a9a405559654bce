#include "cli/text/help.hpp"

#include <sstream>

#include "cli/text/table.hpp"
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

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(name_width);
  label("Positionals", "Arguments");
  label("SUBCOMMAND", "COMMAND");
  label("OPTIONS", "OPTION...");
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

}  // namespace hitpipe::cli
