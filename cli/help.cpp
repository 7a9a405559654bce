#include "cli/help.hpp"

#include <sstream>

namespace hitpipe::cli {

namespace {

constexpr std::size_t page_width = 80;
constexpr std::size_t name_width = 33;  // the longest name with its value: --format text|csv|json=text

/// The words of a text in lines of at most `width` characters; a longer word has a line of its own.
std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string lines;
  std::size_t column = 0;
  for (std::string word; words >> word; column += word.size()) {
    if (column > 0 && column + 1 + word.size() > width) {
      lines += '\n';
      column = 0;
    } else if (column > 0) {
      lines += ' ';
      ++column;
    }
    lines += word;
  }
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
  return wrapped(app->get_description(), page_width) + "\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  CLI::detail::format_help(out, command->get_name(),
                           wrapped(command->get_description(), page_width - name_width), name_width);
  return out.str();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), page_width - name_width);
}

}  // namespace hitpipe::cli
