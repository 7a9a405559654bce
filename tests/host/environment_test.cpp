// Environment variables that name programs.
#include "host/environment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::host {
namespace {

using sim::EnvironmentValue;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* name = "HITPIPE_TEST_VARIABLE";

TEST(Environment, UnsetAndEmptyVariablesGiveTheOther) {
  const EnvironmentValue unset(name, std::nullopt);
  EXPECT_EQ(environment(name, "other"), "other");
  const EnvironmentValue empty(name, "");
  EXPECT_EQ(environment(name, "other"), "other");
  const EnvironmentValue set(name, "it's set");
  EXPECT_EQ(environment(name, "other"), "it's set");
}

TEST(WordsOf, AreWhatBlanksSeparate) {
  EXPECT_THAT(words_of("  env\tg++  -O2\n"), ElementsAre("env", "g++", "-O2"));
  EXPECT_THAT(words_of(" "), IsEmpty());
}

TEST(ProgramOf, TakesArgumentsThatFollowTheProgram) {
  const EnvironmentValue variable(name, "env LANG=C g++");
  EXPECT_THAT(program_of(name, "c++"), ElementsAre("env", "LANG=C", "g++"));
}

TEST(ProgramOf, PathOfAFileIsOneWord) {
  const sim::TemporaryFolder folder;
  const std::string program = folder.write_program("it's a compiler", "").string();
  const EnvironmentValue variable(name, program);
  EXPECT_THAT(program_of(name, "c++"), ElementsAre(program));
}

TEST(ProgramOf, NothingButBlanksNamesNone) {
  const EnvironmentValue blank(name, " ");
  EXPECT_THAT(program_of(name, "c++"), ElementsAre("c++"));
  const EnvironmentValue unset(name, std::nullopt);
  EXPECT_THAT(program_of(name, "c++"), ElementsAre("c++"));
}

}  // namespace
}  // namespace hitpipe::host
