// What hitpipe emits does not depend on the compiler that built it: g++ and clang++ give the same bytes.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::compilers_test {
namespace {

/// Files below a folder without the recorded graphs, where the compiler chooses the order of nodes.
std::vector<std::string> emitted_files(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().filename() == "recorded.txt") continue;
    names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void emit_with(const std::string& program, const std::filesystem::path& folder) {
  const ToolResult result = run_tool(".", "hitpipe", program, fmt::format("'{}'", folder.string()));
  ASSERT_EQ(result.status, 0) << program << ": " << result.output;
}

TEST(Compilers, EmitTheSameBytes) {
  const ScratchFolder folder;
  emit_with(HITPIPE_EMIT_ALL, folder / "one");
  emit_with(HITPIPE_EMIT_ALL_OTHER, folder / "other");
  const auto files = emitted_files(folder / "one");
  const auto wrappers = std::count_if(files.begin(), files.end(),
                                      [](const std::string& file) { return file.ends_with("_axis.v"); });
  EXPECT_GE(wrappers, 18)
      << "hitpipe's own: two integer designs in five formats, two with a major axis in two, four float ones";
  EXPECT_GE(files.size(), 17U * 7U);
  EXPECT_EQ(emitted_files(folder / "other"), files);
  for (const std::string& file : files) {
    EXPECT_TRUE(read_text(folder / "one" / file) == read_text(folder / "other" / file)) << file << " differs";
  }
}

}  // namespace
}  // namespace hitpipe::rtl::compilers_test
