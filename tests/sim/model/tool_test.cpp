// A tool is what its variable names, and is known by what it prints about its version.
#include "sim/model/tool.hpp"

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
  for (const char* const script : {"exit 0", "echo 'unknown option' >&2; exit 1"})
    EXPECT_EQ(message_of<std::runtime_error>([&] { (void)found(script, "--version"); }),
              name + ": cannot be run; install the package some-package or set SOME_TOOL to the program");
}

}  // namespace
}  // namespace hitpipe::sim::tool_test
