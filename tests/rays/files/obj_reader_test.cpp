// OBJ: what each line gives, and one message for each way in which a line can be wrong.
#include "rays/files/obj_reader.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/files/obj_words.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::ref::obj_reader_test {
namespace {

using Indices = std::vector<std::uint32_t>;
using Positions = std::vector<glm::dvec3>;

FileMesh read(std::string_view text) {
  return read_obj(text, "none/mesh.obj");
}
std::string reason(std::string_view text) {
  return message_of([&] { return read(text); });
}
const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

void expect_triangle(std::string_view text) {
  const FileMesh mesh = read(text);
  EXPECT_EQ(mesh.positions, (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << text;
  EXPECT_EQ(mesh.corners, (Indices{0, 1, 2})) << text;
  EXPECT_TRUE(mesh.sizes.empty());
}

TEST(ObjReader, NumbersOfAnySpelling) {
  const FileMesh mesh = read("v .5 -.5 +1.\nv 1e5 1E-2 +1.5e+1\nv 0.1 1e-400 -0\n");
  EXPECT_EQ(mesh.positions, (Positions{{0.5, -0.5, 1}, {1e5, 0.01, 15}, {0.1, 0, 0}}));
}

TEST(ObjReader, VerticesWithWeightOrColour) {
  const FileMesh mesh = read("v 1 2 3 0.5\nv 4 5 6 0.1 0.2 0.3\nv 7 8 9 1 0.1 nan 0.3\n");
  EXPECT_EQ(mesh.positions, (Positions{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(ObjReader, CornersOfAnySpelling) {
  for (const char* const face :
       {"f 1 2 3", "f -3 -2 -1", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/9/9 2/9/9 3/-9/-9", "f 1/ 2/ 3/",
        "f 1// 2// 3//", "  \tf\t1  2 3 \t", "fo 1 2 3", "f 1 2 \\\n3", "f +1 2 3"})
    expect_triangle(three + face + "\n");
  expect_triangle(three + "f 1 2 3");    // without a last line end
  expect_triangle("f 1 2 3\n" + three);  // before its vertices
  expect_triangle("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n");
}

TEST(ObjReader, LinesOfAnySpelling) {
  expect_triangle("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_triangle("v 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\nf 1 2 \\\r\n 3\r\n");
  expect_triangle("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3");
  expect_triangle("\n\n  # c\n" + three + "f 1 2 3 # first\n");
  expect_triangle("v 0 0 0 # corner 1\nv 1 0 0#2\nv 0 1 0\n#f 1 2\nf 1 2 3\n");
  expect_triangle("# a\\\nv 0 0 0\nv 1 0 0 # b\\\nv 0 1 0\nf 1 2 3\n");
  expect_triangle("v 0 \\\n 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\\\n");
}

TEST(ObjReader, RelativeIndicesCountFromTheirLine) {
  const FileMesh mesh =
      read("v 0 0 0\nv 4 0 0\nv 0 3 0\nf -3 -2 -1\nv 5 0 0\nv 5 .5 0\nv 5 0 1\nf -3 -2 -1\n");
  EXPECT_EQ(mesh.corners, (Indices{0, 1, 2, 3, 4, 5}));
}

TEST(ObjReader, FacesKeepTheirPlaces) {
  const FileMesh mesh = read(three + "v 1 1 0\nf 1 2 3\nf 1\nf 1 2 4 3\nl 1 2 3\np 1\nf 2 3\n");
  EXPECT_EQ(mesh.corners, (Indices{0, 1, 2, 0, 0, 1, 3, 2, 1, 2}));
  EXPECT_EQ(mesh.sizes, (Indices{3, 1, 4, 2}));
}

TEST(ObjReader, GroupsHaveTheLastNameAndMaterial) {
  const FileMesh mesh = read(three +
                             "f 1 2 3\no ball\nusemtl red  ball\nf 1 2 3\nf 1 2 3\ng top left \nf 1 2 3\n"
                             "g unused\nusemtl blue\ng\nf 1 2 3\nusemtl\nf 1 2 3\n");
  ASSERT_EQ(mesh.groups.size(), 4U);
  const std::vector<std::string> names{"", "ball", "top left", ""};
  const std::vector<std::string> materials{"", "red  ball", "red  ball", "blue"};
  const std::vector<std::size_t> firsts{0, 1, 3, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.groups[i].name, names[i]);
    EXPECT_EQ(mesh.groups[i].material, materials[i]);
    EXPECT_EQ(mesh.groups[i].first_face, firsts[i]);
    EXPECT_FALSE(mesh.groups[i].surface);
  }
}

TEST(ObjReader, EveryLineIsKnownOrRefused) {
  for (const std::string_view word : obj_skipped)
    expect_triangle(fmt::format("{}{} 1 2 3\nf 1 2 3\n", three, word));
  for (const std::string_view word : obj_refused)
    EXPECT_EQ(reason(fmt::format("{}{} 1 2 3\nf 1 2 3\n", three, word)),
              fmt::format("line 4: \"{}\" is not read; give the geometry as faces (f)", word));
  EXPECT_EQ(reason(three + "face 1 2 3\n"),
            "line 4: unknown word \"face\"; allowed are those of Wavefront's OBJ specification");
  EXPECT_EQ(reason(three + "1/1/1\n"),
            "line 4: unknown word \"1/1/1\"; allowed are those of Wavefront's OBJ specification");
  EXPECT_EQ(reason("F 1 2 3\n"),
            "line 1: unknown word \"F\"; allowed are those of Wavefront's OBJ specification");
}

TEST(ObjReader, BadNumbersAreRefused) {
  for (const char* const word : {"4,5", "1.5.2", "0x10", "1e", "--1", "+-1", "x", "1f", "."})
    EXPECT_EQ(
        reason(fmt::format("v 0 0 0\n\nv 0 {} 0\n", word)),
        fmt::format("line 3: \"{}\" is not a number; allowed are decimal numbers such as -1.5e3", word));
  EXPECT_EQ(reason("v 1 2 3 4 5 6 7 8\n"),
            "line 1: a vertex has 8 numbers; allowed are 3, with a weight 4, with a colour 6 or 7");
  for (const int count : {0, 1, 2, 5}) {
    std::string line = "v";
    for (int i = 0; i < count; ++i) line += " 1";
    EXPECT_EQ(
        reason(line),
        fmt::format("line 1: a vertex has {} numbers; allowed are 3, with a weight 4, with a colour 6 or 7",
                    count));
  }
  EXPECT_EQ(reason("v 1 inf 0\nf 1\n"), "line 1: a vertex lies at (1, inf, 0); coordinates must be finite");
  EXPECT_EQ(reason("v nan 0 0\nf 1 1 1\n"),
            "line 1: a vertex lies at (nan, 0, 0); coordinates must be finite");
  EXPECT_EQ(reason("v 1 \\\n0 1e400\nf -1\n"),
            "line 1: a vertex lies at (1, 0, inf); coordinates must be finite");
}

TEST(ObjReader, BadCornersAreRefused) {
  for (const char* const corner : {"1.5", "x", "/1", "1/x", "1/1/x", "1/1/1/1", "1-2", "1,2", "+-1"})
    EXPECT_EQ(reason(fmt::format("{}f 1 2 {}\n", three, corner)),
              fmt::format("line 4: \"{}\" is no corner of a face; allowed are v, v/vt, v//vn and v/vt/vn "
                          "with whole numbers",
                          corner));
  EXPECT_EQ(reason(three + "f\n"), "line 4: a face has no corner; allowed are 1 and more");
  EXPECT_EQ(
      reason(three + "f 0 1 2\n"),
      "line 4: a face refers to vertex 0; the first has number 1, and the last before a line number -1");
  EXPECT_EQ(reason(three + "f 1 2 -4\nv 1 1 1\n"),
            "line 4: a face refers to vertex -4; 3 are before this line");
  EXPECT_EQ(reason(three + "f 1 2 4\n"), "line 4: a face refers to vertex 4; the file has vertices 1 to 3");
  EXPECT_EQ(reason("f 1\n"), "line 1: a face refers to vertex 1; the file has no vertex");
  EXPECT_EQ(reason("v 0 0 0\nf 1 2\n"), "line 2: a face refers to vertex 2; the file has vertex 1");
  EXPECT_EQ(reason(three + "f 1 2 99999999999999999999\n"),
            "line 4: a face refers to vertex 9223372036854775807; the file has vertices 1 to 3");
}

TEST(ObjReader, LineNumbersCountJoinedLines) {
  EXPECT_EQ(reason("v 0 0 \\\n0\r\n\r\n# a\\\rv 1 0\n"),
            "line 5: a vertex has 2 numbers; allowed are 3, with a weight 4, with a colour 6 or 7");
}

TEST(ObjReader, OtherEncodingsAreRefused) {
  using namespace std::string_view_literals;
  for (const std::string_view text :
       {"\xFF\xFEv\0 \0"sv, "\xFE\xFF\0v\0 "sv, "v\0 \0000\0"sv, "\0v\0 \0000"sv})
    EXPECT_EQ(reason(text), "is UTF-16 or UTF-32, not text in UTF-8 or ASCII; save it as UTF-8");
}

TEST(ObjReader, LongNamesOfManyGroupsAreRefused) {
  std::string text = "v 0 0 0\ng " + std::string(1'000'000, 'n') + "\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("usemtl {}\nf 1\n", i);
  EXPECT_EQ(reason(text), "line 52: the names of groups are too long for this file");
}

class ObjWithMaterials : public testing::Test {
 protected:
  /// The albedo's red of each group; -1 without a surface.
  [[nodiscard]] std::vector<float> reds(const std::string& head,
                                        const std::vector<std::string>& names) const {
    std::string text = head + three;
    for (const std::string& name : names) text += fmt::format("usemtl {}\nf 1 2 3\n", name);
    std::vector<float> found;
    for (const FileMesh::Group& group : read_obj(text, folder_.path() / "mesh.obj").groups)
      found.push_back(group.surface ? group.surface->albedo.x : -1.0F);
    return found;
  }
  const sim::TemporaryFolder folder_;
};

TEST_F(ObjWithMaterials, AreFoundByName) {
  folder_.write("a.mtl", "newmtl one\nKd 0.25 0 0\nnewmtl no colour\nnewmtl #2 b\nKd 0.5 0 0\n");
  folder_.write("b c.mtl", "newmtl three\nKd 0.75 0 0\n");
  const std::vector<std::string> names{"one", "#2 b", "three", "no colour", "unknown", "one # comment"};
  EXPECT_EQ(reds("mtllib a.mtl\nmtllib b c.mtl\n", names),
            (std::vector<float>{0.25F, 0.5F, 0.75F, -1, -1, 0.25F}));
  EXPECT_EQ(reds("mtllib none.mtl a.mtl\nmtllib .\\b c.mtl\n", names),
            (std::vector<float>{0.25F, 0.5F, 0.75F, -1, -1, 0.25F}));
  EXPECT_EQ(reds("mtllib .\n", {"one"}), (std::vector<float>{-1}));
}

TEST_F(ObjWithMaterials, OfTheirOwnNameStandInForAMissingFile) {
  folder_.write("mesh.mtl", "newmtl one\nKd 0.25 0 0\n");
  EXPECT_EQ(reds("mtllib none.mtl\n", {"one"}), (std::vector<float>{0.25F}));
  EXPECT_EQ(reds("", {"one"}), (std::vector<float>{-1}));
}

TEST_F(ObjWithMaterials, ANoteSaysWhatIsLeftOut) {
  const auto said = [&](const std::string& text) {
    folder_.write("a.mtl", text);
    testing::internal::CaptureStderr();
    EXPECT_EQ(reds("mtllib a.mtl\n", {"one"}).size(), 1U);
    std::string out = testing::internal::GetCapturedStderr();
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = 0; (at = out.find(folder)) != std::string::npos;) out.erase(at, folder.size());
    return out;
  };
  EXPECT_EQ(said("newmtl one\nKd 0.25 0.25 0.25\nTr 0\nillum 2.0\n"), "");
  EXPECT_EQ(said("newmtl one\nKd 0.25 x 0\n"),
            "hitpipe: mtl file \"a.mtl\": line 2: \"x\" behind Kd is not a number; this value is left out\n");
  EXPECT_EQ(
      said("newmtl one\nKd spectral a.rfl\nNi\nillum 11\n"),
      "hitpipe: mtl file \"a.mtl\": line 2: \"spectral\" behind Kd is not a number; this value and 2 more "
      "are left out\n");
  EXPECT_EQ(said("\xFF\xFEn"),
            "hitpipe: mtl file \"a.mtl\": is UTF-16 or UTF-32, not text in UTF-8 or ASCII; save it as UTF-8; "
            "its materials are left out\n");
  EXPECT_EQ(
      said("newmtl one\nKd 1 1 1\nTr 1.000\n"),
      "hitpipe: mesh file \"mesh.obj\": material \"one\" is wholly transparent, as it has Tr 1 and no d; "
      "write d 1 if it is opaque\n");
  EXPECT_EQ(
      said("newmtl one\nTr 0.25\nnewmtl unused\nTr 1\n"),
      "hitpipe: mesh file \"mesh.obj\": material \"one\" is transparent, as it has Tr 0.25 and no d; write "
      "d 1 if it is opaque\n");
  EXPECT_EQ(said("newmtl one\nTr 1\nd 1\n"), "");
}

}  // namespace
}  // namespace hitpipe::ref::obj_reader_test
