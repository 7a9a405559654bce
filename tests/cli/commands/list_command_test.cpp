// `hitpipe list`: designs, libraries and scenes as text, CSV and JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/component/library.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::list_command_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The names and how many there are, in each format; the heads and a line.
struct List {
  const char* what;
  std::vector<std::string> names;
  std::string key;
  std::string csv_head;
  std::string csv_line;
  std::string text;
};

TEST(ListCommand, SaysTheSameInEveryFormat) {
  std::vector<std::string> designs;
  for (const rtl::Design& design : rtl::designs()) designs.emplace_back(design.name);
  std::vector<std::string> scenes;
  for (const ref::BuiltInScene& scene : ref::built_in_scenes()) scenes.emplace_back(scene.name);
  const List lists[] = {
      {"designs", designs, "design", "design,bits,misses,what,formats",
       "int_slabs,n20/24,never,\"integer slabs test, figures 7.4-7.6\",n/t with n in 6..32 and t in 6..2n-1",
       "design             bits        misses    what\n"},
      {"libraries", rtl::built_in_names(), "library", "library,of,counts,source", "",
       "thesis_250nm\n"
       "  of      0.25 micron standard cells\n"
       "  counts  area in mm2\n"
       "  source  Mahovsky 2005, Table 7.1 (0.25 micron standard cells) and figure 7.6\n"
       "          (gates)\n"},
      {"scenes", scenes, "scene", "scene,triangles,least,most,lights,stands_for,what",
       "branch,312706,80000,10000000,2,Branch,a spruce branch with cones", "\nspheres "}};
  for (const List& list : lists) {
    const std::string words = std::string("list ") + list.what;
    const std::string text = printed(words);
    EXPECT_LE(widest_line(text), 80U) << text;
    EXPECT_THAT(text, HasSubstr(list.text));
    for (const std::string& name : list.names) EXPECT_THAT("\n" + text, HasSubstr("\n" + name));
    EXPECT_EQ(printed(words + " --format text"), text);
    const auto lines = lines_of(printed(words + " --format csv"));
    ASSERT_EQ(lines.size(), list.names.size() + 1);
    EXPECT_EQ(lines[0], list.csv_head);
    if (!list.csv_line.empty()) {
      EXPECT_EQ(lines[2], list.csv_line);
    }
    const json rows = json::parse(printed(words + " --format json"));
    ASSERT_EQ(rows.size(), list.names.size());
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].at(list.key), list.names[i]);
  }
}

}  // namespace
}  // namespace hitpipe::cli::list_command_test
