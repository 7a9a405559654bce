// Wrong use of the program: one line that says what was wrong, where, and what is allowed; exit code 2; no
// file. Each case is a line of words and the message. DIR is a folder, OUT a place in it where nothing may
// appear, DESIGNS the list of designs, COMMANDS_OF_CORE that of the commands of `core`. A message that ends in ";" goes
// on with the help of its command, and of one that ends in "..." only the beginning is compared.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "cli/commands.hpp"
#include "host/text.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli {

struct WrongUse {
  std::string words;
  std::string message;
};

class WrongUseOf : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("file", "");
    folder_.write("two.csv", "a,b\n");
    folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::filesystem::create_directory(folder_.path() / "results");
  }
  void TearDown() override { EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "results")); }

  [[nodiscard]] std::string filled(std::string text) const {
    const std::pair<std::string, std::string> places[] = {{"OUT", folder_.path() / "results/out"},
                                                          {"DIR", folder_.path()},
                                                          {"DESIGNS", rtl::design_names()},
                                                          {"COMMANDS_OF_CORE", commands_of_core()}};
    for (const auto& [name, value] : places)
      for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + value.size()))
        text.replace(at, name.size(), value);
    return text;
  }
  static std::string commands_of_core() {
    std::string names;
#define HITPIPE_ADD_NAME(purpose, name) names += std::string(names.empty() ? "" : ", ") + #name;
    HITPIPE_CORE_COMMANDS(HITPIPE_ADD_NAME)
#undef HITPIPE_ADD_NAME
    return names;
  }
  /// A word '' is empty.
  void rejected(const std::vector<std::string>& words, std::string message,
                const Variables& variables = {}) const {
    std::vector<std::string> arguments;
    for (const std::string& word : words) arguments.push_back(word == "''" ? "" : filled(word));
    message = filled(message);
    if (message.ends_with(';'))
      message += " see hitpipe " +
                 (words.empty()             ? ""
                  : words.front() == "core" ? "core " + words.at(1) + " "
                                            : words.front() + " ") +
                 "--help";
    const Outcome outcome = run_hitpipe(arguments, variables);
    const std::string line = fmt::format("{}", fmt::join(arguments, " "));
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_EQ(outcome.out, "") << line;
    std::string expected = "hitpipe: " + message + "\n", said = outcome.err;
    if (message.ends_with("...")) {
      expected.resize(expected.size() - 4);
      EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << line;
      said.resize(std::min(said.size(), expected.size()));
    }
    EXPECT_EQ(said, expected) << line;
  }
  void rejected(const std::vector<WrongUse>& cases) const {
    for (const auto& [words, message] : cases) rejected(host::words_of(words), message);
  }
  /// By the commands that read a scene.
  void scene_rejected(const std::string& options, const std::string& message) const {
    rejected({{"cosim int_slabs --width 8 --height 8 --out OUT --scene " + options, message},
              {"render --width 8 --height 8 --out OUT.png --scene " + options, message}});
  }
  void mesh_rejected(const std::string& name, const std::string& text, const std::string& message) const {
    folder_.write(name, text);
    scene_rejected("DIR/" + name, "mesh file \"DIR/" + name + "\": " + message);
  }

  const sim::TemporaryFolder folder_;
};

}  // namespace hitpipe::cli
