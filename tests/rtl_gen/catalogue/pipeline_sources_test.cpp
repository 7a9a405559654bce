// Where the C++ of a design is: a graph has values from its own headers and shared ones only, and no two
// headers of hls define the same name.
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hls/pipelines/int_slabs.hpp"
#include "rtl_gen/catalogue/design_of.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::pipeline_sources_test {
namespace {

/// It has the datapath of int_slabs.
struct Borrowed : hls::IntSlabs {
  static constexpr const char* name = "borrowed";
  static constexpr const char* header = __FILE__;
};

struct Shared : Borrowed {
  using Shares = hls::IntSlabs;
};

TEST(PipelineSources, ValueFromAnotherPipelineRejected) {
  const std::string message = message_of([] {
    const Design design = design_of<Borrowed>();
    static_cast<void>(design.trace(design.default_format));
  });
  EXPECT_TRUE(std::regex_match(
      message,
      std::regex("design borrowed: its value \\w+ comes from hls/pipelines/int_slabs.hpp:\\d+, not from "
                 "catalogue/pipeline_sources_test.cpp or a shared header; give its functions a namespace of "
                 "their own, or name the other pipeline in `Shares`")))
      << message;
}

TEST(PipelineSources, ValueFromAPipelineThatIsNamedAccepted) {
  const Design design = design_of<Shared>();
  EXPECT_EQ(design.trace(design.default_format).outputs().size(), 1U);
}

TEST(PipelineSources, ValueInsideAUnitIsLookedAtToo) {
  Graph body("unit");
  const NodeId a = body.input("a", 4, false);
  const NodeId inverted = body.invert(a);
  body.annotate(inverted, "turned", {"hls/pipelines/other.hpp", 7});
  body.output("out", inverted);
  Graph graph("caller");
  const std::array<NodeId, 1> operands{graph.input("a", 4, false)};
  graph.output("out", graph.call(std::make_shared<const Submodule>(Submodule{"unit", 4, body}), operands));
  EXPECT_THROW(check_sources(graph, {"hls/pipelines/caller.hpp"}), std::runtime_error);
  EXPECT_NO_THROW(check_sources(graph, {"hls/pipelines/caller.hpp", "hls/pipelines/other.hpp"}));
}

std::vector<std::filesystem::path> headers(const char* folder) {
  std::vector<std::filesystem::path> found;
  for (const std::string tree : {HITPIPE_SOURCE "/hls/", HITPIPE_SOURCE "/tests/foreign_design/hls/"})
    for (const auto& entry : std::filesystem::directory_iterator(tree + folder))
      if (entry.path().extension() == ".hpp") found.push_back(entry.path());
  return found;
}

bool is_shared(const std::filesystem::path& header) {
  return header.stem().string().ends_with("_parts");
}

/// What clang-format leaves at the start of a line is in a namespace, and in nothing else.
TEST(PipelineSources, EachPipelineHasANamespaceNamedAsItsFile) {
  std::size_t pipelines = 0;
  for (const std::filesystem::path& path : headers("pipelines")) {
    if (is_shared(path)) continue;
    ++pipelines;
    const std::string own = path.stem().string();
    const std::regex outside("|(#|//).*|namespace (hitpipe|hls) \\{|\\}  // namespace (hitpipe|hls)|using " +
                             own + "::\\w+;");
    bool inside = false;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      if (line == "namespace " + own + " {" || line == "}  // namespace " + own) {
        inside = !inside;
      } else if (!inside) {
        EXPECT_TRUE(std::regex_match(line, outside)) << path << ": " << line;
      }
    }
    EXPECT_FALSE(inside) << path;
  }
  EXPECT_GE(pipelines, designs().size());
}

TEST(PipelineSources, NoTwoSharedHeadersDefineTheSameName) {
  std::map<std::string, std::set<std::string>> files_of;
  const std::regex definition(
      "(?:template <.*> )?(?:struct (\\w+)|constexpr .*?(\\w+)[({].*|using (\\w+) =.*).*");
  for (const char* const folder : {"box", "pipelines"}) {
    for (const std::filesystem::path& path : headers(folder)) {
      if (std::string(folder) == "pipelines" && !is_shared(path)) continue;
      std::ifstream file(path);
      for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, definition)) continue;
        for (std::size_t i = 1; i < match.size(); ++i)
          if (match[i].matched) files_of[match[i]].insert(path.filename());
      }
    }
  }
  for (const auto& [name, files] : files_of) {
    if (name == "operator") continue;
    EXPECT_EQ(files.size(), 1U) << name << " is in " << testing::PrintToString(files);
  }
  EXPECT_TRUE(files_of.contains("IntSlabsOperands"));
  EXPECT_TRUE(files_of.contains("plane_distances"));
}

}  // namespace
}  // namespace hitpipe::rtl::pipeline_sources_test
