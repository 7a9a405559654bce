// Help of every command, and the message for a command line that cannot be understood.
#include "cli/text/help.hpp"

#include <memory>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/commands.hpp"
#include "host/text.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::help_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Those of the program and those of `core`, in the order of the help.
#define HITPIPE_NAME(purpose, name) #name,
const std::vector<std::string> commands{HITPIPE_COMMANDS(HITPIPE_NAME)};
const std::vector<std::string> core_commands{HITPIPE_CORE_COMMANDS(HITPIPE_NAME)};
#undef HITPIPE_NAME

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// All commands that do something, each by its words.
std::vector<Words> all_commands() {
  std::vector<Words> all;
  for (const std::string& command : commands)
    if (command != "core") all.push_back({command});
  for (const std::string& command : core_commands) all.push_back({"core", command});
  return all;
}

/// With the program alone, and `core` alone.
std::vector<Words> all_helps() {
  std::vector<Words> all = all_commands();
  all.insert(all.end(), {{}, {"core"}});
  return all;
}

std::string help_of(Words words) {
  words.emplace_back("--help");
  return run_hitpipe(words).out;
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
  const std::string help = help_of(GetParam());
  for (const char* const word : {"NUMBER", "NONNEGATIVE", " AND ", "INT in"}) {
    EXPECT_THAT(help, Not(HasSubstr(word)));
  }
}

TEST_P(Help, IsThatOfTheCommandHelp) {
  Words words = GetParam();
  words.insert(words.begin(), "help");
  EXPECT_EQ(run_hitpipe(words).out, help_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Commands, Help, testing::ValuesIn(all_helps()), [](const auto& parameter) {
  return parameter.param.empty() ? "hitpipe" : joined(parameter.param, "_");
});

TEST(HelpOfTheProgram, ListsTheCommandsAndAFirstTry) {
  const std::string help = run_hitpipe({"--help"}).out;
  for (const std::string& command : commands)
    EXPECT_THAT(help, HasSubstr(command == "help" ? "`hitpipe help COMMAND`" : "\n  " + command + " "));
  for (const char* const purpose :
       {"Take a unit", "Judge it", "Choose it", "Put it onto a chip", "Take a whole core", "The thesis"})
    EXPECT_THAT(help, HasSubstr("\n\n" + std::string(purpose) + ":\n"));
  EXPECT_LE(lines_of(help).size(), 44U) << help;
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
  for (const Words& command : all_commands()) {
    const std::string help = help_of(command);
    const std::size_t at = help.find("\n  --seed ");
    if (at == std::string::npos) continue;
    const std::size_t next = help.find("\n  --", at + 1);
    said.push_back(help.substr(at, next - at));
  }
  ASSERT_EQ(said.size(), 8U);  // rtl, render, check, report, implement, board, core rtl, core trace
  for (const std::string& each : said) EXPECT_EQ(each, said[0]);
  EXPECT_THAT(said[0], HasSubstr("--seed N=1 "));
}

TEST(HelpOfCommands, SaysWhatIsRequired) {
  EXPECT_THAT(help_of({"rtl"}), HasSubstr("\nUsage: hitpipe rtl NAME --out FOLDER [OPTION...]\n"));
  EXPECT_THAT(help_of({"core", "rtl"}), HasSubstr("\nUsage: hitpipe core rtl --out FOLDER [OPTION...]\n"));
  EXPECT_THAT(help_of({"board"}),
              HasSubstr("\nUsage: hitpipe board [NAME] (--port DEVICE | --simulate) [OPTION...]\n"));
  EXPECT_THAT(help_of({"core"}), HasSubstr("\nUsage: hitpipe core COMMAND [OPTION...]\n"));
}

/// A command is understood with the options of each example, and runs nothing.
TEST(HelpOfCommands, EndsWithExamplesThatAreUnderstood) {
  CLI::App program("", "hitpipe");
  program.formatter(std::make_shared<HelpFormatter>());
  int exit_code = 0;
  add_commands(program, exit_code);
  const auto understood = [&](const std::string& line) {
    CLI::App* command = &program;
    std::string why = "it was not seen";
    for (const std::string& word : host::words_of(line.substr(std::string("hitpipe ").size())))
      if (!command->get_subcommands({}).empty()) command = command->get_subcommand(word);
    command->parse_complete_callback([command] {
      if (!command->remaining().empty()) throw CLI::ExtrasError(command->remaining());
      throw CLI::Success();
    });
    try {
      program.parse(line, true);
    } catch (const CLI::Success&) {
      why.clear();
    } catch (const CLI::ParseError& error) {
      why = error.what();
    }
    program.clear();
    return why;
  };
  EXPECT_NE(understood("hitpipe rtl int_slabs --colour 3"), "");
  for (const Words& command : all_helps()) {
    if (command.empty()) continue;
    const std::string help = help_of(command);
    const std::size_t at = help.find("\nExamples:\n");
    ASSERT_NE(at, std::string::npos) << help;
    const std::vector<std::string> lines = lines_of(help.substr(at + 1));
    EXPECT_GE(lines.size(), 3U) << help;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      EXPECT_TRUE(lines[i].starts_with("  hitpipe " + joined(command, " "))) << lines[i];
      EXPECT_EQ(understood(lines[i].substr(2)), "") << lines[i];
    }
  }
}

TEST(Version, BeginsWithOneLine) {
  const Outcome outcome = run_hitpipe({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out,
              testing::MatchesRegex("hitpipe [0-9]+\\.[0-9]+\\.[0-9]+ \\([0-9a-f]{8}\\)\n(.*\n){3}"));
}

TEST(CommandLine, WithoutCommandRejected) {
  expect_error({}, "a command is needed; there are: " + joined(commands, ", ") + "; see hitpipe --help");
}

TEST(CommandLine, WithUnknownCommandRejected) {
  expect_error({"follow"},
               "follow: no such command; there are: " + joined(commands, ", ") + "; see hitpipe --help");
}

TEST(CommandLine, WithUnknownFormatRejected) {
  for (const Words& command : all_commands()) {
    if (command == Words{"help"}) continue;
    Words words = command;
    if (command == Words{"list"}) words.emplace_back("designs");
    expect_error(with(words, {"--format", "xml"}),
                 "--format: xml is none of text, csv, json; see hitpipe " + joined(command, " ") + " --help");
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
