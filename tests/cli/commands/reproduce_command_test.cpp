// `hitpipe reproduce`: the page and the CSV file beside it, and docs/reproduction.md, which it made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::cli::reproduce_command_test {
namespace {

using testing::HasSubstr;

const std::vector<std::string> quick{
    "reproduce", "--tables", "4.2,6.2,7.1,7.2", "--scene", "Bunny=spheres", "--scene", "Branch=spheres",
    "--width",   "16",       "--height",        "12",      "--repeats",     "1"};

TEST(ReproduceCommand, WritesThePageAndEveryFigure) {
  const sim::TemporaryFolder folder;
  std::vector<std::string> arguments = quick;
  const std::string out = (folder.path() / "page.md").string();
  arguments.insert(arguments.end(), {"--out", out});
  const Outcome outcome = run_hitpipe(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const std::string page = contents_of(out);
  EXPECT_THAT(page,
              HasSubstr("hitpipe reproduce --scene Branch=spheres --scene Bunny=spheres --width 16 --height "
                        "12 --repeats 1 --tables 4.2,6.2,7.1,7.2 --out " +
                        out));
  EXPECT_THAT(page,
              HasSubstr("| 4.2 | a ray visits first the child on the side that it comes from | orders that "
                        "are equal | 24 | 24 | agrees |"));
  EXPECT_THAT(page, HasSubstr("| 7.1 | area_mm2 | 19 | 19 | 0 | 0 | 1.00 |"));
  const auto rows = lines_of(contents_of(folder.path() / "page.csv"));
  EXPECT_EQ(rows[0], "table,row,column,thesis,ours,ours_low,ours_high,ratio,verdict");
  EXPECT_EQ(rows[1], "4.2,MMM x,first_child,1.0,1.0,,,1.0,agrees");
  // 24 orders, 16 rows of 10 figures, 19 circuits of 3, 6 units of 6.
  EXPECT_EQ(rows.size(), 1U + 24U + 160U + 57U + 36U);
}

TEST(ReproduceCommand, BadInputRejected) {
  const auto rejected = [](const std::vector<std::string>& arguments, const std::string& message) {
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, testing::StartsWith("hitpipe: " + message));
    EXPECT_EQ(lines_of(outcome.err).size(), 1U);
  };
  rejected({"reproduce", "--tables", "4.5"}, "4.5: no experiment of that number; there are 3.1,");
  rejected({"reproduce", "--tables", "4.2", "--out", "page.txt"}, "--out: page.txt does not end in .md");
}

/// What does not depend on the machine is the same in the page that is kept: the tables that take no time.
TEST(ReproduceCommand, KeptPageHasTodaysFigures) {
  const auto kept = lines_of(contents_of(HITPIPE_SOURCE "/docs/reproduction.md"));
  const auto today = lines_of(run_hitpipe({"reproduce", "--tables", "4.2,7.1,7.2"}).out);
  int compared = 0;
  for (const std::string& line : today) {
    if (!line.starts_with("| 4.2 |") && !line.starts_with("| 7.")) continue;
    EXPECT_THAT(kept, testing::Contains(line));
    ++compared;
  }
  EXPECT_GT(compared, 15);
}

}  // namespace
}  // namespace hitpipe::cli::reproduce_command_test
