#include "cli/program.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/options/talk_options.hpp"
#include "cli/text/help.hpp"
#include "cli/text/tools_text.hpp"
#include "cli/version.hpp"
#include "host/ending.hpp"
#include "host/text.hpp"
#include "sim/cosim/counts.hpp"

namespace hitpipe::cli {

namespace {

// Exit code 1: the command ran and found wrong hardware or a wrong picture.
constexpr int wrong_hardware = 1;
constexpr int asked_wrongly = 2;

/// Whoever wrote the message. A path may have 4096 bytes.
std::string without_long_words(const std::string& text) {
  constexpr std::size_t longest = 4096;
  std::string kept;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = std::string_view(text).substr(at, end - at);
    kept += (at > 0 ? " " : "") + (word.size() > longest ? host::shortened(word) : std::string(word));
    at = end + 1;
  }
  return kept;
}

/// Messages quote the user's words; control characters become blanks so that each message stays one line.
void print_error(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  fmt::print(stderr, "hitpipe: {}\n", without_long_words(text));
}

/// How many characters must be put in, taken out or replaced.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1],
                               std::min({diagonal + (a[i] == b[j] ? 0 : 1), row[j] + 1, row[j + 1] + 1}));
  }
  return row.back();
}

/// The option that the user may have meant: one that begins so, or else the most similar.
std::string nearest_option(const CLI::App& command, const std::string& given) {
  const std::string name = given.substr(0, given.find('='));
  std::string nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const CLI::Option* const option : command.get_options()) {
    if (option->get_positional()) continue;
    const std::string other = option->get_name();
    const std::size_t far = other.starts_with(name) ? 0 : distance(name, other);
    if (far < least) nearest = other;
    least = std::min(least, far);
  }
  return nearest;
}

/// Names the first option that does not exist, or the first word too many. Empty if there is none.
std::string not_expected(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  if (words.empty()) return "";
  const auto option =
      std::find_if(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
  if (option == words.end()) return fmt::format("{}: a word too many", host::shortened(words.front()));
  return fmt::format("{}: no such option; the nearest is {}", host::shortened(*option),
                     nearest_option(command, *option));
}

/// What is wrong with the command line, and which help tells more.
std::string usage_error(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* command = &program;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  std::string wrong;
  if (command->get_subcommands({}).empty()) {
    const std::string unknown = not_expected(*command);
    wrong = unknown.empty() ? error.what() : unknown;
  } else {
    const std::vector<std::string> unknown = command->remaining();
    wrong = fmt::format(
        "{}; there are: {}",
        unknown.empty() ? "a command is needed" : host::shortened(unknown.front()) + ": no such command",
        command_names(*command));
  }
  return fmt::format("{}; see {} --help", wrong, full_name(*command));
}

}  // namespace

void fill(CLI::App& program, int& exit_code) {
  program.name("hitpipe");
  program.description("Ray-box test units from one C++ source: emit, simulate, judge, price.");
  program.set_version_flag("--version", std::string(program_and_sources()),
                           "Print the version, and which tools are found");
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.require_subcommand(1);
  program.formatter(std::make_shared<HelpFormatter>());
  add_commands(program, exit_code);
  add_talk_options(program);
  program.footer(
      "`hitpipe help COMMAND` tells more of each. A first try:\n"
      "  hitpipe cosim int_slabs --scene spheres --out out\n"
      "Exit codes:\n"
      "  0  good\n"
      "  1  the hardware or a picture is wrong\n"
      "  2  asked wrongly, or a file cannot be used");
}

int run(int argc, char** argv) {
  host::end_by_signals_cleanly();
  CLI::App program;
  int exit_code = 0;
  fill(program, exit_code);
  try {
    program.alias(argv[0]);  // commands that print commands call it so
    std::vector<std::string> words(argv + 1, argv + argc);
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    program.parse(std::move(words));
  } catch (const CLI::CallForVersion&) {
    fmt::print("{}\n{}", program_and_sources(), tools_text());
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // help or version was asked for
    print_error(usage_error(program, error));
    return asked_wrongly;
  } catch (const sim::WrongHardware& error) {
    print_error(error.what());
    return wrong_hardware;
  } catch (const std::bad_alloc&) {
    print_error("not enough memory; ask for fewer pixels, triangles or rays in flight, or for fewer threads");
    return asked_wrongly;
  } catch (const std::exception& error) {
    print_error(error.what());
    return asked_wrongly;
  }
  if (std::fflush(stdout) != 0) {
    print_error("standard output: cannot be written");
    return asked_wrongly;
  }
  return exit_code;
}

}  // namespace hitpipe::cli
