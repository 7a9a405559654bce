// `hitpipe libraries`: the same list as text, CSV and JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/component/library.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::libraries_command_test {
namespace {

using testing::HasSubstr;

TEST(LibrariesCommand, DescribesEach) {
  const Outcome outcome = run_hitpipe({"libraries"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_LE(widest_line(outcome.out), 80U) << outcome.out;
  for (const std::string& name : rtl::built_in_names())
    EXPECT_THAT("\n" + outcome.out, HasSubstr("\n" + name + "\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("thesis_250nm\n"
                        "  of      0.25 micron standard cells\n"
                        "  counts  area in mm2\n"
                        "  source  Mahovsky 2005, Table 7.1 (0.25 micron standard cells) and figure 7.6\n"
                        "          (gates)\n"));
  EXPECT_THAT(outcome.out, HasSubstr("  counts  LUT, FF, SB_MAC16\n"));
}

TEST(LibrariesCommand, PrintsCsv) {
  const auto lines = lines_of(run_hitpipe({"libraries", "--format", "csv"}).out);
  ASSERT_EQ(lines.size(), rtl::built_in_names().size() + 1);
  EXPECT_EQ(lines[0], "library,of,counts,source");
}

TEST(LibrariesCommand, PrintsJson) {
  const auto list = nlohmann::json::parse(run_hitpipe({"libraries", "--format", "json"}).out);
  const auto names = rtl::built_in_names();
  ASSERT_EQ(list.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(list[i].at("library"), names[i]);
    EXPECT_EQ(list[i].at("source"), rtl::library_called(names[i]).source());
  }
}

}  // namespace
}  // namespace hitpipe::cli::libraries_command_test
