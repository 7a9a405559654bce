// `hitpipe designs`: the same list as text, CSV and JSON.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::designs_command_test {
namespace {

TEST(DesignsCommand, PrintsATable) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"designs"}, {"designs", "--format", "text"}}) {
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    const auto lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), rtl::designs().size() + 1);
    EXPECT_EQ(lines[0], "design             bits     may_miss  what");
    EXPECT_EQ(lines[2], "int_slabs          20/24    no        integer slabs test, figures 7.4-7.6");
    EXPECT_LE(widest_line(outcome.out), 80U);
  }
}

/// The first column is the name of the Verilog's top module too: scripts cut it out.
TEST(DesignsCommand, PrintsCsvWithTheNameFirst) {
  const Outcome outcome = run_hitpipe({"designs", "--format", "csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), rtl::designs().size() + 1);
  EXPECT_EQ(lines[0], "design,bits,may_miss,what,formats");
  EXPECT_EQ(
      lines[2],
      "int_slabs,20/24,no,\"integer slabs test, figures 7.4-7.6\",n/t with n in 6..32 and t in 6..2n-1");
}

TEST(DesignsCommand, PrintsJson) {
  const Outcome outcome = run_hitpipe({"designs", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto list = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(list.size(), rtl::designs().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].at("design"), rtl::designs()[i].name);
    EXPECT_EQ(list[i].at("what"), rtl::designs()[i].summary);
  }
}

}  // namespace
}  // namespace hitpipe::cli::designs_command_test
