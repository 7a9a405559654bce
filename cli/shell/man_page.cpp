#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/shell/options.hpp"
#include "cli/text/help.hpp"
#include "cli/version.hpp"

namespace hitpipe::cli {

namespace {

/// Text as roff takes it: its own signs escaped, no line that begins like a request.
std::string roff(const std::string& text) {
  std::string kept;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (kept.empty() || kept.back() == '\n')) kept += "\\&";
    if (c == '\\')
      kept += "\\e";
    else if (c == '-')
      kept += "\\-";
    else
      kept += c;
  }
  return kept;
}

std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line.append(line.empty() ? "" : " ").append(word);
  return line;
}

/// Lines that stay as they are.
std::string as_written(const std::string& text) {
  return fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text));
}

std::string entry(const CLI::Option& option, const HelpFormatter& help) {
  std::vector<std::string> names = names_of(option);
  std::string value = in_one_line(help.make_option_opts(&option));
  if (names.empty()) {
    names.push_back(option.get_type_name());
    value = option.get_items_expected_max() > 1 ? "..." : "";
  }
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(fmt::format("{}", fmt::join(names, ", "))),
                     value.empty() ? "" : fmt::format(" {}", roff(value)),
                     roff(in_one_line(option.get_description())));
}

std::string entries(const CLI::App& command, const HelpFormatter& help) {
  std::string text;
  for (const CLI::Option* const option : options_of(command)) text += entry(*option, help);
  return text;
}

std::string section(const CLI::App& command, const HelpFormatter& help) {
  const std::string usage = in_one_line(help.make_usage(&command, full_name(command)));
  return fmt::format(".SS {}\n{}.\n.PP\n\\fB{}\\fR\n{}{}", roff(full_name(command)),
                     roff(in_one_line(command.get_description())),
                     roff(usage.substr(std::string("Usage: ").size())), entries(command, help),
                     command.get_footer().empty() ? "" : as_written(command.get_footer()));
}

}  // namespace

std::string man_page(const CLI::App& program) {
  const auto& help = *std::dynamic_pointer_cast<HelpFormatter>(program.get_formatter());
  const std::string footer = program.get_footer();
  const std::string codes = "Exit codes:\n";
  const std::size_t at = footer.find(codes);
  std::string text = fmt::format(
      ".TH HITPIPE 1 \"\" \"{}\" \"User Commands\"\n"
      ".SH NAME\nhitpipe \\- hardware for ray tracing from one C++ source\n"
      ".SH SYNOPSIS\n\\fBhitpipe\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR...]\n"
      ".SH DESCRIPTION\n{}\n.SH OPTIONS\n{}.SH COMMANDS\n",
      program_version(), roff(program.get_description()), entries(program, help));
  for (const CLI::App* const command : commands_of(program))
    if (command != &program) text += section(*command, help);
  text += fmt::format(".SH EXAMPLES\n{}", as_written(footer.substr(0, at)));
  if (at != std::string::npos)
    text += fmt::format(".SH EXIT STATUS\n{}", as_written(footer.substr(at + codes.size())));
  return text;
}

}  // namespace hitpipe::cli
