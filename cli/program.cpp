#include "cli/program.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.hpp"
#include "cli/text/help.hpp"
#include "sim/cosim/counts.hpp"

namespace hitpipe::cli {

namespace {

// Exit code 1: the command ran and found wrong hardware or a wrong picture.
constexpr int wrong_hardware = 1;
constexpr int asked_wrongly = 2;

/// Messages quote the user's words; control characters become blanks so that each message stays one line.
void print_error(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  fmt::print(stderr, "hitpipe: {}\n", text);
}

/// What is wrong with the command line, and which help tells more.
std::string usage_error(const CLI::App& program, const CLI::ParseError& error) {
  const auto commands = program.get_subcommands();
  if (!commands.empty())
    return fmt::format("{}; see hitpipe {} --help", error.what(), commands.front()->get_name());
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  const std::vector<std::string> unknown = program.remaining();
  return fmt::format("{}; there are: {}; see hitpipe --help",
                     unknown.empty() ? "a command is needed" : unknown.front() + ": no such command",
                     fmt::join(names, ", "));
}

}  // namespace

int run(int argc, char** argv) {
  CLI::App program("Ray-box hardware pipelines from one C++ source: emit, co-simulate, compare.", "hitpipe");
  program.set_version_flag("--version", "hitpipe " HITPIPE_VERSION, "Print the version and exit");
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.require_subcommand(1);
  program.formatter(std::make_shared<HelpFormatter>());
  int exit_code = 0;
  add_commands(program, exit_code);
  for (CLI::App* command : program.get_subcommands({})) command->group("Commands");
  program.footer(
      "hitpipe COMMAND --help tells more of each. A first try:\n"
      "  hitpipe cosim int_slabs --scene spheres --out out\n"
      "Exit codes:\n"
      "  0  good\n"
      "  1  the hardware or a picture is wrong\n"
      "  2  asked wrongly, or a file cannot be used");
  try {
    program.parse(argc, argv);
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
