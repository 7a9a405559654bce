// STL files of each kind, and one message for each way in which one can be bad.
#include "rays/files/stl_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"

namespace hitpipe::ref::stl_reader_test {
namespace {

using Corners = std::vector<std::uint32_t>;
const std::vector<glm::dvec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string reason(const std::string& bytes) {
  return message_of([&] { static_cast<void>(read_stl(bytes)); });
}

std::string facet(const std::string& second = "1 0 0", const std::string& normal = "0 0 1") {
  return " facet normal " + normal + "\n  outer loop\n   vertex 0 0 0\n   vertex " + second +
         "\n   vertex 0 1 0\n  endloop\n endfacet\n";
}

std::string word(std::uint32_t value) {
  std::string out;
  for (unsigned i = 0; i < 4; ++i) out += static_cast<char>(value >> 8U * i & 0xFFU);
  return out;
}

std::string binary(std::uint32_t announced, const std::vector<float>& numbers, std::string header = "") {
  header.resize(80, ' ');
  std::string out = header + word(announced);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i % 9 == 0) out += word(0x7FC00000U) + word(0) + word(0x3F800000U);  // a normal with nan
    out += word(std::bit_cast<std::uint32_t>(numbers[i]));
    if (i % 9 == 8) out += "ab";
  }
  return out;
}
const std::vector<float> one{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(ReadStl, TextHasWordsInAnyCaseAndAnyPlace) {
  const std::string shouted =
      "SOLID\rFACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0\rVERTEX\r0 1 0 End Loop EndFacet "
      "ENDSOLID a";
  for (const std::string& text :
       {"solid a\n" + facet() + "endsolid a\n", "solid a\n" + facet() + "ENDSOLID a\n",
        "\n solid\n" + facet() + "end solid a", "solid a facet b\r\n" + facet() + "endsolid",
        "solid " + std::string(5000, 'x') + "\n" + facet() + "endsolid " + std::string(5000, 'x'),
        "\xEF\xBB\xBFsolid\n" + facet("+1.e0 -.0 0", "nan -nan(ind) -1.#IND") + "endsolid\n", shouted}) {
    const FileMesh mesh = read_stl(text);
    EXPECT_EQ(mesh.positions, triangle) << text;
    EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
  }
}

TEST(ReadStl, TextMayStandOnOneLine) {
  std::string one_line = facet();
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  for (const std::string& text :
       {"solid a" + one_line + "endsolid a", "solid" + one_line + "endsolid",
        "solid a" + one_line + "end solid a\n", "solid a facet b" + one_line + "endsolid a",
        "solid a facet\nnormal" + one_line.substr(13) + "endsolid a",
        "solid a\n" + one_line + "endsolid a solid b endsolid b", "\tSOLID a\v" + one_line + "ENDSOLIDa",
        "solid a\n" + facet() + "endsolid_a\n", "solida\n" + facet() + "end solida\n",
        "solid a endsolid b\n" + facet() + "endsolid a endsolid b"}) {
    const FileMesh mesh = read_stl(text);
    EXPECT_EQ(mesh.positions, triangle) << text;
  }
  const FileMesh three =
      read_stl("solid a b" + one_line + one_line + "endsolid a solid c endsolid solid solid e" + one_line +
               "endsolid e\nsolid f\nendsolid f");
  ASSERT_EQ(three.groups.size(), 4U);
  EXPECT_EQ(three.faces(), 3U);
  EXPECT_EQ(three.groups[0].name, "a b");
  EXPECT_EQ(three.groups[1].name, "c");
  EXPECT_EQ(three.groups[2].first_face, 2U);
  EXPECT_EQ(three.groups[3].name, "f");
  EXPECT_EQ(reason("solid a" + one_line + "endsoli"),
            "line 1: unexpected word \"endsoli\"; allowed is \"facet\" or \"endsolid\"");
}

TEST(ReadStl, TextNumbersAreDoubles) {
  EXPECT_EQ(read_stl("solid\n" + facet("0.1 1e-400 1e39") + "endsolid\n").positions[1],
            glm::dvec3(0.1, 0, 1e39));
}

TEST(ReadStl, SeveralSolidsAreGroups) {
  const FileMesh mesh =
      read_stl("solid  a b \n" + facet() + facet() + "endsolid a b\nsolid\nendsolid\n\nsolid c\n" + facet() +
               "end solid c d\n\n");
  EXPECT_EQ(mesh.faces(), 3U);
  ASSERT_EQ(mesh.groups.size(), 3U);
  EXPECT_EQ(mesh.groups[0].name, "a b");
  EXPECT_EQ(mesh.groups[1].name, "");
  EXPECT_EQ(mesh.groups[2].name, "c");
  EXPECT_EQ(mesh.groups[1].first_face, 2U);
  EXPECT_EQ(mesh.groups[2].first_face, 2U);
}

TEST(ReadStl, BinaryIsReadWhateverItsHeaderSays) {
  for (const char* const header : {"", "solid by CAD", "solid\nfacet normal "}) {
    const FileMesh mesh = read_stl(binary(1, one, header));
    EXPECT_EQ(mesh.positions, triangle);
    EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
    EXPECT_TRUE(mesh.groups.empty());
  }
  EXPECT_EQ(read_stl(binary(0, {})).faces(), 0U);
}

TEST(ReadStl, BytesBehindTheLastFacetAreSkippedIfTheyHoldNoFacet) {
  EXPECT_EQ(read_stl(binary(1, one, "solid by CAD") + std::string(8, '\0')).positions, triangle);
  EXPECT_EQ(read_stl(binary(1, one) + std::string(49, 'x')).positions, triangle);
  EXPECT_EQ(
      reason(binary(1, one) + std::string(50, 'x')),
      "is neither a text STL (it must begin with \"solid\") nor a binary one whose length fits (it announces "
      "1 facets, which need 134 bytes and up to 49 more; the file has 184)");
}

TEST(ReadStl, FilesCutShortAreRefusedAtEveryLength) {
  const std::string text = "solid a\n" + facet() + "endsolid";
  const std::string whole = binary(1, one, "solid by CAD");
  for (const std::string& file : {text, whole}) {
    for (std::size_t length = 0; length < file.size(); ++length)
      EXPECT_NE(reason(file.substr(0, length)), "no exception") << length << " bytes";
  }
  EXPECT_EQ(reason(text.substr(0, text.size() - 8)),
            "is cut short in line 9; a text STL must end with \"endsolid\"");
  EXPECT_EQ(reason("solid a\nfacet normal 0 0"),
            "is cut short in line 2; a text STL must end with \"endsolid\"");
  EXPECT_EQ(
      reason(whole.substr(0, 133)),
      "is neither a text STL (it must have \"facet\" behind its name) nor a binary one whose length fits (it "
      "announces 1 facets, which need 134 bytes and up to 49 more; the file has 133)");
  EXPECT_EQ(
      reason("; hello\nsolid a\n" + facet() + "endsolid\n"),
      "is neither a text STL (it must begin with \"solid\") nor a binary one whose length fits (it announces "
      "538976266 facets, which need 26948813384 bytes and up to 49 more; the file has 126)");
  EXPECT_EQ(
      reason("facet"),
      "is neither a text STL (it must begin with \"solid\") nor a binary one whose length fits (it must have "
      "84 bytes or more; the file has 5)");
}

TEST(ReadStl, OtherWordsAreRefused) {
  const auto with = [](const std::string& old_text, const std::string& new_text) {
    std::string changed = "solid a\n" + facet() + "endsolid\n";
    return reason(changed.replace(changed.find(old_text), old_text.size(), new_text));
  };
  EXPECT_EQ(with("  endloop", "vertex 1 1 0\n"),
            "line 7: unexpected word \"vertex\"; allowed is \"endloop\"");
  EXPECT_EQ(with("endloop", "end facet"), "line 7: unexpected word \"facet\"; allowed is \"loop\"");
  EXPECT_EQ(with("normal", "normals"), "line 2: unexpected word \"normals\"; allowed is \"normal\"");
  EXPECT_EQ(with("endfacet\n", "endfacet\nhello\n"),
            "line 9: unexpected word \"hello\"; allowed is \"facet\" or \"endsolid\"");
  EXPECT_EQ(with("endsolid\n", "endsolid\nfacet\n"),
            "line 10: unexpected word \"facet\"; allowed is \"solid\"");
  for (const char* const number : {"4,5", "0x10", "1.5.2", "x"})
    EXPECT_EQ(with("vertex 1", fmt::format("vertex {}", number)),
              fmt::format("line 5: \"{}\" is not a number", number));
  EXPECT_EQ(with("normal 0", "normal q"), "line 2: \"q\" is not a number");
}

TEST(ReadStl, CoordinatesThatAreNotFiniteAreRefused) {
  EXPECT_EQ(reason("solid a\n" + facet("0 0 nan") + "endsolid\n"),
            "line 5: a vertex lies at (0, 0, nan); coordinates must be finite");
  EXPECT_EQ(reason("solid a\n" + facet("1e400 0 0") + "endsolid\n"),
            "line 5: a vertex lies at (inf, 0, 0); coordinates must be finite");
  EXPECT_EQ(reason(binary(1, {0, 0, 0, 1, std::bit_cast<float>(0x7F800000U), 0, 0, 1, 0})),
            "byte 108: a vertex lies at (1, inf, 0); coordinates must be finite");
}

}  // namespace
}  // namespace hitpipe::ref::stl_reader_test
