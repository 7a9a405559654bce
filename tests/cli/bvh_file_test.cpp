// Hierarchies from files in the commands that take them: the file of docs/scenes.md, trees of another
// program, and our own.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/dump_bvh.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::bvh_file_test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string page() {
  return contents_of(std::filesystem::path(HITPIPE_SOURCE) / "docs/scenes.md");
}

/// The block of the page that begins with these characters.
std::string block(const std::string& start) {
  const std::string text = page();
  const std::size_t at = text.find("```\n" + start);
  EXPECT_NE(at, std::string::npos) << start;
  const std::size_t first = at + 4;
  return text.substr(first, text.find("```", first) - first);
}

json counts_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--format", "json"});
  const Outcome outcome = run_hitpipe(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
}

TEST(BvhFileOfTheDocs, IsReadAsPrinted) {
  const sim::TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", block("v 0 0 0")).string();
  const std::string bvh = folder.write("mesh.bvh", block("hitpipe-bvh 1")).string();
  const json figures = counts_of({"bvh", "--scene", mesh, "--bvh", bvh});
  EXPECT_EQ(figures.at("bvh"), bvh);
  EXPECT_EQ(figures.at("bvh_nodes"), 3);
  EXPECT_EQ(figures.at("bvh_boxes_grown"), 0);
  EXPECT_EQ(figures.at("leaves_by_triangles"), (json{"1:1", "2:1"}));
  const json row = counts_of(
      {"cosim", "int_slabs", "--scene", mesh, "--bvh", bvh, "--width", "16", "--height", "16", "--referee"});
  EXPECT_EQ(row.at("hierarchy"), "mesh.bvh");
  EXPECT_EQ(row.at("bvh_nodes"), 3);
  EXPECT_EQ(row.at("false_misses"), 0);
}

/// The bits of a record as the page places them, and what is in them.
TEST(BvhFileOfTheDocs, HasTheRecordsOfThePage) {
  const sim::TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", block("v 0 0 0")).string();
  const std::string bvh = folder.write("mesh.bvh", block("hitpipe-bvh 1")).string();
  const std::string out = (folder.path() / "mesh").string();
  const std::string words = "bvh --format json --scene " + mesh + " --bvh " + bvh + " --records " + out;
  const json row = json::parse(printed(words + ".hex"));
  EXPECT_EQ(contents_of(out + ".hex"), block("// int_major_pair"));
  EXPECT_EQ(row.at("records_of"), "int_major_pair 20+1/13");
  EXPECT_EQ(row.at("record_count"), 2);
  EXPECT_EQ(row.at("record_bytes"), 32);

  printed(words + ".bin --bits 12+1/12");
  const std::string bytes = contents_of(out + ".bin");
  ASSERT_EQ(bytes.size(), 2U * 26);
  const auto bits = [&](std::size_t record, int low, int count) {
    int value = 0;
    for (int i = count; i-- > 0;) {
      const auto byte =
          static_cast<unsigned char>(bytes[26 * record + static_cast<std::size_t>((low + i) / 8)]);
      value = 2 * value + (byte >> (low + i) % 8 & 1);
    }
    return value;
  };
  for (int plane = 0; plane < 6; ++plane) EXPECT_EQ(bits(0, 72 + plane, 1), 0) << "the root's own";
  EXPECT_EQ(bits(1, 72, 6), 1) << "the second child has the lower plane of x, the first all others";
  EXPECT_EQ(bits(1, 78, 2), 0) << "split along x";
  EXPECT_GT(bits(1, 0, 12) - (bits(1, 0, 12) >= 2048 ? 4096 : 0),
            bits(1, 36, 12) - (bits(1, 36, 12) >= 2048 ? 4096 : 0))
      << "the children lie apart";
  const int children[] = {1, 0, 2, 1};  // triangles, first entry
  for (int i = 0; i < 4; ++i) EXPECT_EQ(bits(1, 80 + 32 * i, 31), children[i]) << i;
  EXPECT_EQ(bits(0, 80, 31), 0) << "a branch";
  EXPECT_EQ(bits(0, 112, 31), 1) << "which is record 1";
  EXPECT_EQ(bits(0, 144, 31), 0x7fffffff) << "no second child";
}

TEST(BvhFileOfTheDocs, IsWrittenByTheProgramThatIsTestedHere) {
  const std::string code = contents_of(std::filesystem::path(HITPIPE_SOURCE) / "tests/cli/dump_bvh.hpp");
  EXPECT_THAT(page(), HasSubstr(code.substr(code.find("#include"))));
}

/// Hills far from the origin, as text. The program that builds trees of them reads the text on its own.
class Hills {
 public:
  Hills() {
    constexpr int side = 16;
    for (int y = 0; y <= side; ++y) {
      for (int x = 0; x <= side; ++x) {
        const double height = 3.0 * std::sin(0.7 * x) * std::cos(0.5 * y);
        text_ += "v";
        std::array<float, 3> vertex{};
        int axis = 0;
        for (const double own : {310.0 + 1.37 * x, -27.0 + height, 1.19 * y}) {
          const std::string word = fmt::format("{:.6f}", own);
          text_ += ' ' + word;
          vertex[static_cast<std::size_t>(axis++)] = std::strtof(word.c_str(), nullptr);
        }
        text_ += '\n';
        vertices_.push_back(vertex);
      }
    }
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const int a = y * (side + 1) + x;
        for (const auto& [i, j, k] :
             {std::array{a, a + 1, a + side + 2}, std::array{a, a + side + 2, a + side + 1}}) {
          text_ += fmt::format("f {} {} {}\n", i + 1, j + 1, k + 1);
          triangles_.push_back({i, j, k});
        }
      }
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

  /// A tree that halves the list of triangles, whatever lies where, with leaves of up to three.
  [[nodiscard]] std::string halved_tree(const std::filesystem::path& file) const {
    std::vector<Node> nodes(1);
    std::vector<int> order;
    fill(nodes, 0, order, 0, static_cast<int>(triangles_.size()));
    std::FILE* const out = std::fopen(file.c_str(), "w");
    dump(out, nodes, order);
    std::fclose(out);
    return file.string();
  }

 private:
  void fill(std::vector<Node>& nodes, std::size_t place, std::vector<int>& order, int first, int last) const {
    Node node{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.min[axis] = std::numeric_limits<float>::infinity();
      node.max[axis] = -node.min[axis];
      for (int t = first; t < last; ++t) {
        for (const int v : triangles_[static_cast<std::size_t>(t)]) {
          node.min[axis] = std::min(node.min[axis], vertices_[static_cast<std::size_t>(v)][axis]);
          node.max[axis] = std::max(node.max[axis], vertices_[static_cast<std::size_t>(v)][axis]);
        }
      }
    }
    if (last - first <= 3) {
      node.first = static_cast<int>(order.size());
      node.count = last - first;
      for (int t = last; t-- > first;) order.push_back(t);
    } else {
      const int middle = (first + last) / 2;
      for (int side = 0; side < 2; ++side) {
        node.child[side] = static_cast<int>(nodes.size());
        nodes.emplace_back();
        fill(nodes, nodes.size() - 1, order, side == 0 ? first : middle, side == 0 ? middle : last);
      }
    }
    nodes[place] = node;
  }

  std::string text_;
  std::vector<std::array<float, 3>> vertices_;
  std::vector<std::array<int, 3>> triangles_;
};

class ForeignTree : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(ForeignTree, GivesTheSamePictureWithoutAMiss) {
  const sim::TemporaryFolder folder;
  const Hills hills;
  const std::string mesh = folder.write("hills.obj", hills.text()).string();
  const std::string bvh = hills.halved_tree(folder.path() / "hills.bvh");
  std::vector<std::string> arguments{"cosim"};
  arguments.insert(arguments.end(), GetParam().begin(), GetParam().end());
  arguments.insert(arguments.end(),
                   {"--scene", mesh, "--width", "40", "--height", "30", "--referee", "--out"});
  const auto with = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> all = arguments;
    all.push_back((folder.path() / out).string());
    all.insert(all.end(), more.begin(), more.end());
    return counts_of(all);
  };
  const json ours = with("ours", {});
  const json theirs = with("theirs", {"--bvh", bvh});
  for (const json& row : {ours, theirs}) {
    for (const char* const none : {"rtl_mismatches", "false_misses", "different_triangles"})
      EXPECT_EQ(row.at(none), 0) << none;
  }
  EXPECT_EQ(theirs.at("hierarchy"), std::filesystem::path(bvh).filename().string());
  EXPECT_EQ(theirs.at("bvh_nodes"), 511);
  EXPECT_EQ(ours.at("hierarchy"), "median 6");
  EXPECT_NE(ours.at("bvh_nodes"), theirs.at("bvh_nodes"));
  EXPECT_NE(ours.at("box_tests"), theirs.at("box_tests"));
  for (const char* const same : {"rays_primary", "rays_shadow", "rays_secondary"})
    EXPECT_EQ(ours.at(same), theirs.at(same)) << same;
  EXPECT_EQ(contents_of(folder.path() / "ours" / "hills.png"),
            contents_of(folder.path() / "theirs" / "hills.png"));
  // Software walks the same tree.
  const json software =
      counts_of({"render", "--scene", mesh, "--bvh", bvh, "--width", "40", "--height", "30"});
  EXPECT_EQ(software.at("bvh_nodes"), 511);
  EXPECT_NEAR(theirs.at("extra_box_tests_pct").get<double>(),
              100.0 * (theirs.at("box_tests").get<double>() / software.at("box_tests").get<double>() - 1.0),
              1e-9);
}

INSTANTIATE_TEST_SUITE_P(Designs, ForeignTree,
                         testing::Values(std::vector<std::string>{"int_slabs", "--bits", "20/24"},
                                         std::vector<std::string>{"int_major_pair", "--bits", "12+1/12"}),
                         [](const auto& each) { return each.param[0]; });

TEST(BvhFile, OfOurOwnHierarchyGivesTheSameCounts) {
  const sim::TemporaryFolder folder;
  const std::string bvh = (folder.path() / "spheres.bvh").string();
  const json written = counts_of({"bvh", "--scene", "spheres", "--out", bvh});
  EXPECT_EQ(written.at("file"), bvh);
  const std::vector<std::string> cosim{"cosim",   "int_slabs", "--scene",  "spheres",
                                       "--width", "32",        "--height", "24"};
  const std::vector<std::string> from_file = with(cosim, {"--bvh", bvh});
  json built = counts_of(cosim);
  json read = counts_of(from_file);
  EXPECT_EQ(read.at("bvh_boxes_grown"), 0);
  for (json* const row : {&built, &read})
    for (const char* const other : {"hierarchy", "bvh_boxes_grown", "rtl_tests_per_s", "loop_tests_per_s"})
      row->erase(other);
  EXPECT_EQ(read, built);
  // What is read is written as it was.
  const std::string again = (folder.path() / "again.bvh").string();
  const json figures = counts_of({"bvh", "--scene", "spheres", "--bvh", bvh, "--out", again});
  EXPECT_EQ(contents_of(again), contents_of(bvh));
  EXPECT_EQ(figures.at("sah_cost"), written.at("sah_cost"));
}

}  // namespace
}  // namespace hitpipe::cli::bvh_file_test
