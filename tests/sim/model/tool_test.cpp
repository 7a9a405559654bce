// A tool is what its variable names, and is known by what it prints about its version.
#include "sim/model/tool.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::tool_test {
namespace {

class FindTool : public testing::Test {
 protected:
  [[nodiscard]] Tool found(const std::string& script, const std::string& option) const {
    const EnvironmentValue variable("SOME_TOOL", folder_.write_program("tool", "#!/bin/sh\n" + script));
    return find_tool("SOME_TOOL", "no-such-tool", "some-package", option);
  }

  const TemporaryFolder folder_;
};

TEST_F(FindTool, AsksWithTheToolsOwnOption) {
  const Tool tool = found("[ $# = 1 ] && [ $1 = -V ] && printf 'Tool 1.2\\nof a maker\\n'", "-V");
  EXPECT_EQ(tool.version, "Tool 1.2\nof a maker");
  EXPECT_EQ(tool.release(), "Tool 1.2");
}

TEST_F(FindTool, TakesAVersionOnStandardErrorWhereNoneIsOnStandardOutput) {
  EXPECT_EQ(found("echo 'Tool 3' >&2", "--version").version, "Tool 3");
  EXPECT_EQ(found("echo 'a warning' >&2; echo 'Tool 3'", "--version").version, "Tool 3");
}

TEST_F(FindTool, WithoutAVersionRejected) {
  const std::string name = (folder_.path() / "tool").string();
  const auto rejected = [&](const std::string& why) {
    return fmt::format(
        "{}: cannot be run ({}); install the package some-package or set SOME_TOOL to the program", name,
        why);
  };
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)found("exit 0", "--version"); }),
            rejected("it does not say its version"));
  EXPECT_EQ(message_of<std::runtime_error>([&] {
              (void)found("echo 'unknown option' >&2; echo 'try --help' >&2; exit 1", "--version");
            }),
            rejected("it failed with exit code 1: unknown option"));
}

}  // namespace
}  // namespace hitpipe::sim::tool_test
