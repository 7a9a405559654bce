// The command line. Each line of the input is one word. The commands do not run. Their options are parsed as
// the program parses them, and every word is also tried as a number format.
#include <cstdint>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/commands.hpp"
#include "cli/text/help.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) words.push_back(line);
  return words;
}

struct Understood {};

/// The exit code with which the program would end before or after a command.
int parse(std::vector<std::string> words) {
  CLI::App program("", "hitpipe");
  program.set_version_flag("--version", "hitpipe", "");
  program.set_help_flag("-h,--help", "");
  program.require_subcommand(1);
  program.formatter(std::make_shared<cli::HelpFormatter>());
  int exit_code = 0;
  cli::add_commands(program, exit_code);
  program.parse_complete_callback([] { throw Understood(); });  // comes before the command's own
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const Understood&) {
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    std::ostringstream err;
    exit_code = program.exit(error, out, err);
    expect((exit_code == 0 ? out : err).tellp() > 0, "the program says why it ends");
  } catch (const std::runtime_error& error) {  // of a file that cannot be written
    expect(*error.what() != 0, "the program says why it ends");
  }
  return exit_code;
}

void check_formats(const std::string& word) {
  for (const rtl::Design& design : rtl::designs()) {
    try {
      const Format format = design.parse_format(word);
      expect(format.valid(), "formats are valid");
      expect(design.parse_format(to_string(format)) == format, "formats are printed as they are read");
    } catch (const std::runtime_error& error) {
      expect(!std::string(error.what()).empty(), "a message says what is wrong");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::string> words = words_of({reinterpret_cast<const char*>(data), size});
  static_cast<void>(parse(words));
  for (const std::string& word : words) check_formats(word);
  return 0;
}
