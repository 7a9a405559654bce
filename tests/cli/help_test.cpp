// Help of every command, and the message for a command line that cannot be understood.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/commands.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::help_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// All commands in the order of the help.
#define HITPIPE_NAME(purpose, name) #name,
const std::vector<std::string> commands{HITPIPE_COMMANDS(HITPIPE_NAME)};
#undef HITPIPE_NAME

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// The arguments for the program alone, and for each command.
std::vector<std::vector<std::string>> program_and_commands() {
  std::vector<std::vector<std::string>> all{{}};
  for (const std::string& command : commands) all.push_back({command});
  return all;
}

/// One line on standard error, nothing else, and exit code 2.
void expect_error(const std::vector<std::string>& arguments, const std::string& message) {
  const Outcome outcome = run_hitpipe(arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
}

class Help : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Help, FitsEightyColumns) {
  std::vector<std::string> arguments = GetParam();
  for (const char* const option : {"--help", "-h"}) {
    arguments.emplace_back(option);
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_LE(widest_line(outcome.out), 80U) << outcome.out;
    EXPECT_THAT(outcome.out, HasSubstr("Usage: hitpipe"));
    for (const std::string& line : lines_of(outcome.out)) EXPECT_FALSE(line.ends_with(' ')) << line;
    arguments.pop_back();
  }
}

/// The parser's own words for its checks must not appear.
TEST_P(Help, SaysNothingOfValidators) {
  std::vector<std::string> arguments = GetParam();
  arguments.emplace_back("--help");
  const std::string help = run_hitpipe(arguments).out;
  for (const char* const word : {"NUMBER", "NONNEGATIVE", " AND ", "INT in"}) {
    EXPECT_THAT(help, Not(HasSubstr(word)));
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, Help, testing::ValuesIn(program_and_commands()),
                         [](const auto& parameter) {
                           return parameter.param.empty() ? "hitpipe" : parameter.param.front();
                         });

TEST(HelpOfTheProgram, ListsTheCommandsAndAFirstTry) {
  const std::string help = run_hitpipe({"--help"}).out;
  for (const std::string& command : commands) EXPECT_THAT(help, HasSubstr("\n  " + command + " "));
  for (const char* const purpose :
       {"Take a unit", "Judge it", "Choose it", "Put it onto a chip", "The thesis"})
    EXPECT_THAT(help, HasSubstr("\n\n" + std::string(purpose) + ":\n"));
  EXPECT_LE(lines_of(help).size(), 40U) << help;
  EXPECT_THAT(help, HasSubstr("  hitpipe cosim int_slabs --scene spheres --out out\n"));
}

TEST(HelpOfTheProgram, TellsTheExitCodes) {
  const std::string help = run_hitpipe({"--help"}).out;
  for (const char* const line :
       {"0  good", "1  the hardware or a picture is wrong", "2  asked wrongly, or a file cannot be used"}) {
    EXPECT_THAT(help, HasSubstr("\n  " + std::string(line) + "\n"));
  }
}

/// The same option in every command.
TEST(HelpOfCommands, TellsTheSameOfEverySeed) {
  std::vector<std::string> said;
  for (const std::string& command : commands) {
    const std::string help = run_hitpipe({command, "--help"}).out;
    const std::size_t at = help.find("\n  --seed ");
    if (at == std::string::npos) continue;
    const std::size_t next = help.find("\n  --", at + 1);
    said.push_back(help.substr(at, next - at));
  }
  ASSERT_EQ(said.size(), 5U);  // rtl, check, report, implement, board
  for (const std::string& each : said) EXPECT_EQ(each, said[0]);
  EXPECT_THAT(said[0], HasSubstr("--seed N=1 "));
}

TEST(Version, IsOneLine) {
  const Outcome outcome = run_hitpipe({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, testing::MatchesRegex("hitpipe [0-9]+\\.[0-9]+\\.[0-9]+ \\([0-9a-f]{8}\\)\n"));
}

TEST(CommandLine, WithoutCommandRejected) {
  expect_error({}, "a command is needed; there are: " + listed(commands) + "; see hitpipe --help");
}

TEST(CommandLine, WithUnknownCommandRejected) {
  expect_error({"follow"},
               "follow: no such command; there are: " + listed(commands) + "; see hitpipe --help");
}

TEST(CommandLine, WithUnknownFormatRejected) {
  for (const std::string& command : commands) {
    expect_error(command == "list" ? std::vector<std::string>{command, "designs", "--format", "xml"}
                                   : std::vector<std::string>{command, "--format", "xml"},
                 "--format: xml is none of text, csv, json; see hitpipe " + command + " --help");
  }
}

TEST(StandardOutput, ThatIsFullRejected) {
  const sim::TemporaryFolder folder;
  const std::string err = (folder.path() / "err").string();
  const std::string command = std::string(HITPIPE_PROGRAM) + " list designs >/dev/full 2>" + err;
  EXPECT_NE(std::system(command.c_str()), 0);
  EXPECT_EQ(contents_of(err), "hitpipe: standard output: cannot be written\n");
}

}  // namespace
}  // namespace hitpipe::cli::help_test
