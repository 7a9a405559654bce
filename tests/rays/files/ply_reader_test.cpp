// PLY files of each kind that the format allows, and one message for each way in which one can be bad.
#include "rays/files/ply_reader.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"

namespace hitpipe::ref::ply_reader_test {
namespace {

using Corners = std::vector<std::uint32_t>;

const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string rows = "0 0 0\n1 0 0\n0 1 0\n";

std::string file(const std::string& elements, const std::string& body, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}
std::string triangle(const std::string& body, const std::string& format = "ascii") {
  return file("element vertex 3\n" + vertex + faces, body, format);
}
const std::string whole = triangle(rows + "3 0 1 2\n");

std::string reason(const std::string& bytes) {
  return message_of([&] { static_cast<void>(read_ply(bytes)); });
}

std::string with(const std::string& old_text, const std::string& new_text) {
  std::string changed = whole;
  return changed.replace(changed.find(old_text), old_text.size(), new_text);
}

template <class T>
std::string bytes(T value, bool big) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(out.begin(), out.end());
  return out;
}

std::string binary_body(bool big, std::int32_t last_index, float first_x = 0) {
  std::string body;
  for (const float x : {first_x, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) body += bytes(x, big);
  body += '\3';
  for (const std::int32_t index : {0, 1, last_index}) body += bytes(index, big);
  return body;
}

TEST(ReadPly, TextIsReadWithEachLineEnd) {
  for (const char* const end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : whole) text += c == '\n' ? end : std::string(1, c);
    const FileMesh mesh = read_ply(text);
    EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
    EXPECT_TRUE(mesh.sizes.empty());
  }
}

TEST(ReadPly, EveryScalarTypeIsReadInEachByteOrder) {
  const std::string properties =
      "property char a\nproperty int8 x\nproperty uchar b\nproperty uint16 y\nproperty double c\n"
      "property float64 z\nproperty list ushort float32 d\n";
  const std::string face =
      "element face 2\nproperty list char double e\nproperty list int32 uint8 vertex_index\nproperty short "
      "f\n";
  for (const bool big : {false, true}) {
    std::string body;
    for (const double z : {0.1, 0.2, 0.3}) {
      body += "\1\xFE\2" + bytes<std::uint16_t>(65000, big) + bytes(7.0, big) + bytes(z, big);
      body += bytes<std::uint16_t>(2, big) + bytes(1.F, big) + bytes(2.F, big);
    }
    for (const std::int32_t size : {3, 4}) {
      body +=
          '\1' + bytes(5.0, big) + bytes(size, big) + std::string("\0\1\2\0", static_cast<std::size_t>(size));
      body += bytes<std::int16_t>(-1, big);
    }
    const FileMesh mesh = read_ply(file("element vertex 3\n" + properties + face, body,
                                        big ? "binary_big_endian" : "binary_little_endian"));
    EXPECT_EQ(mesh.positions,
              (std::vector<glm::dvec3>{{-2, 65000, 0.1}, {-2, 65000, 0.2}, {-2, 65000, 0.3}}));
    EXPECT_EQ(mesh.corners, (Corners{0, 1, 2, 0, 1, 2, 0}));
    EXPECT_EQ(mesh.sizes, (Corners{3, 4}));
  }
}

TEST(ReadPly, TextNumbersAreRoundedToTheirTypeOnce) {
  std::string mixed = triangle("1e-50 +0.1 1e-400\n1 0 0\n0 1 0\n3 0 1 2\n");
  mixed.replace(mixed.find("float z"), 7, "double z");
  EXPECT_EQ(read_ply(mixed).positions[0], glm::dvec3(0, 0.1F, 0));
  mixed.replace(mixed.find("float y"), 7, "double y");
  EXPECT_EQ(read_ply(mixed).positions[0], glm::dvec3(0, 0.1, 0));
}

TEST(ReadPly, ElementsHaveAnyOrder) {
  const std::string camera = "element camera 1\nproperty float focal\nproperty list uchar int pixels\n";
  const FileMesh mesh =
      read_ply(file(camera + faces + "element note 2\nproperty uchar a\nelement vertex 3\n" + vertex +
                        "element edge 1\nproperty int a\n",
                    "1.5 2 7 8\n3 0 2 1\n1\n2\n" + rows + "9\n"));
  EXPECT_EQ(mesh.positions[1], glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.corners, (Corners{0, 2, 1}));
}

TEST(ReadPly, BinaryBodyThatBeginsWithALineEndIsRead) {
  const float x = std::bit_cast<float>(0x3C23D70AU);  // 0.01; its lowest byte is a line feed
  const FileMesh little = read_ply(triangle(binary_body(false, 2, x), "binary_little_endian"));
  EXPECT_EQ(little.positions[0].x, x);
  const FileMesh big =
      read_ply(triangle(binary_body(true, 2, std::bit_cast<float>(0x0A0D0A0DU)), "binary_big_endian"));
  EXPECT_EQ(big.positions[0].x, std::bit_cast<float>(0x0A0D0A0DU));
  std::string header = triangle("", "binary_little_endian");
  std::replace(header.begin(), header.end(), '\n', '\r');  // then the line feed behind it is a number's
  EXPECT_EQ(read_ply(header + binary_body(false, 2, x)).positions[0].x, x);
}

TEST(ReadPly, LinesOfATextBodyMayEndAnywhere) {
  for (const char* const body : {"\n0 0 0\n \t\n1 0 0\n0 1 0\n\n3 0 1 2\n\n\n", "0 0 0 1 0 0 0 1 0 3 0 1 2",
                                 "0\r\n0\r\n0\r\n1 0\n\n0 0\v1\f0 3\r0\r1\r2\r"}) {
    const FileMesh mesh = read_ply(triangle(body));
    EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << body;
    EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
  }
  EXPECT_EQ(reason(triangle("0 0\r\n0\r\n\r\n1 0 x")), "line 13: \"x\" is not a number");
  EXPECT_EQ(reason(triangle("0\r0\n\r0\r1 0 x")), "line 14: \"x\" is not a number");
}

TEST(ReadPly, FacesWithoutThreeCornersHaveTheirPlace) {
  const FileMesh mesh =
      read_ply(file("element vertex 3\n" + vertex + "element face 3\nproperty list uchar int vertex_index\n",
                    rows + "3 0 1 2\n0\n2 0 1\n"));
  EXPECT_EQ(mesh.sizes, (Corners{3, 0, 2}));
  EXPECT_EQ(
      read_ply(file("element vertex 3\n" + vertex + "element face 0\nproperty list uchar int vertex_index\n",
                    rows))
          .faces(),
      0U);
}

TEST(ReadPly, IndicesThatAreNoVertexAreRefused) {
  EXPECT_EQ(reason(triangle(rows + "3 0 1 3\n")),
            "line 13: face 0 refers to vertex 3; the file has vertices 0 to 2");
  EXPECT_EQ(reason(triangle(rows + "3 0 -1 2\n")),
            "line 13: face 0 refers to vertex -1; the file has vertices 0 to 2");
  EXPECT_EQ(reason(triangle(rows + "3 0 1.5 2\n")),
            "line 13: face 0 refers to vertex 1.5; the file has vertices 0 to 2");
  EXPECT_EQ(reason(triangle(rows + "3 0 nan 2\n")),
            "line 13: face 0 refers to vertex nan; the file has vertices 0 to 2");
  EXPECT_EQ(reason(file("element vertex 0\n" + vertex + faces, "3 0 0 0\n")),
            "line 10: face 0 refers to vertex 0; the file has no vertex");
  const std::string binary = triangle(binary_body(true, 7), "binary_big_endian");
  EXPECT_EQ(reason(binary), fmt::format("byte {}: face 0 refers to vertex 7; the file has vertices 0 to 2",
                                        binary.size() - 4));
}

TEST(ReadPly, CoordinatesThatAreNotFiniteAreRefused) {
  EXPECT_EQ(reason(triangle("0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n")),
            "line 11: vertex 1 lies at (nan, 0, 0); coordinates must be finite");
  EXPECT_EQ(reason(triangle("0 0 0\n0 1e39 -inf\n0 1 0\n3 0 1 2\n")),
            "line 11: vertex 1 lies at (0, inf, -inf); coordinates must be finite");
  const std::string head = triangle("", "binary_little_endian");
  EXPECT_EQ(
      reason(head + bytes(0x7FC00000U, false) + binary_body(false, 2).substr(4)),
      fmt::format("byte {}: vertex 0 lies at (nan, 0, 0); coordinates must be finite", head.size() + 8));
}

TEST(ReadPly, AVertexThatNoFaceUsesMayBeAnything) {
  const std::string four = "element vertex 4\n" + vertex + faces;
  for (const char* const odd : {"nan nan nan", "0 inf 0", "1e99 0 0", "-1 0 0", "0.5 0 0"}) {
    std::string text = file(four, fmt::format("{}\n{}3 1 2 3\n", odd, rows));
    EXPECT_EQ(read_ply(text).corners, (Corners{1, 2, 3})) << odd;
    text.replace(text.find("float x"), 7, "uchar x");
    EXPECT_EQ(read_ply(text).corners, (Corners{1, 2, 3})) << odd;
  }
  EXPECT_EQ(reason(file(four, rows + "0 0 nan\n3 1 2 3\n")),
            "line 13: vertex 3 lies at (0, 0, nan); coordinates must be finite");
}

TEST(ReadPly, TextThatIsNotANumberOfItsTypeIsRefused) {
  for (const char* const word : {"q", "0x10", "4,5", "1.5.2", "+-1", "1e", "comment"})
    EXPECT_EQ(reason(triangle(fmt::format("0 0 0\n1 {} 0\n0 1 0\n3 0 1 2\n", word))),
              fmt::format("line 11: \"{}\" is not a number", word));
  std::string whole_numbers = triangle("0 0 0\n1 300 0\n0 1 0\n3 0 1 2\n");
  whole_numbers.replace(whole_numbers.find("float y"), 7, "uchar y");
  EXPECT_EQ(reason(whole_numbers), "line 11: y of vertex 1 is 300; allowed are the numbers of type uchar");
  whole_numbers.replace(whole_numbers.find("300"), 3, "0.5");
  EXPECT_EQ(reason(whole_numbers), "line 11: y of vertex 1 is 0.5; allowed are the numbers of type uchar");
}

TEST(ReadPly, ThereIsOneNumberForEachProperty) {
  EXPECT_EQ(reason(triangle("0 0\n1 0 0\n0 1 0\n3 0 1 2\n")),
            "line 13: \"1\" stands behind the last element; the header must announce all numbers");
  EXPECT_EQ(reason(triangle("0 0 0\n0 1 0 7\n0 1 0\n3 0 1 2\n")),
            "line 13: \"3\" stands behind the last element; the header must announce all numbers");
  EXPECT_EQ(reason(whole + "3 2 1 0\n"),
            "line 14: \"3\" stands behind the last element; the header must announce all numbers");
}

TEST(ReadPly, BytesBehindTheLastElementAreLineEnds) {
  const std::string binary = triangle(binary_body(false, 2), "binary_little_endian");
  EXPECT_EQ(read_ply(binary + "\r\n").corners, (Corners{0, 1, 2}));
  EXPECT_EQ(reason(binary + "rest"),
            fmt::format("byte {}: 4 bytes stand behind the last element; allowed are none, or line ends",
                        binary.size()));
}

TEST(ReadPly, FilesCutShortAreRefusedAtEveryLength) {
  const std::string text = whole.substr(0, whole.size() - 2);
  const std::string binary = triangle(binary_body(false, 2), "binary_little_endian");
  for (const std::string& file : {text, binary}) {
    for (std::size_t length = 0; length < file.size(); ++length)
      EXPECT_NE(reason(file.substr(0, length)), "no exception") << length << " bytes";
  }
  EXPECT_EQ(reason(text.substr(0, text.size() - 1)), "cut short in element face 0; the header announces 1");
  EXPECT_EQ(reason(binary.substr(0, binary.size() - 1)),
            "cut short in element face 0; the header announces 1");
}

TEST(ReadPly, CountsBeyondTheFileAreRefused) {
  EXPECT_EQ(reason(file("element vertex 4000000000\n" + vertex + faces, rows)),
            "cut short in element vertex 3; the header announces 4000000000");
  EXPECT_EQ(reason(triangle(rows + "4000000000 0 1 2\n")),
            "cut short in element face 0; the header announces 1");
  EXPECT_EQ(reason(with("vertex 3", "vertex -3")),
            "PLY element \"vertex\" has the count \"-3\"; allowed are 0 to 4294967295");
  EXPECT_EQ(reason(with("vertex 3", "vertex 4294967296")),
            "PLY element \"vertex\" has the count \"4294967296\"; allowed are 0 to 4294967295");
  EXPECT_EQ(reason(triangle(rows + "-1 0 1 2\n")),
            "line 13: element face 0 has a list of -1 entries; allowed are 0 and more");
  EXPECT_EQ(reason(triangle(rows + "2.5 0 1 2\n")),
            "line 13: element face 0 has a list of 2.5 entries; allowed are 0 and more");
}

TEST(ReadPly, HeaderFaultsAreRefused) {
  const std::string elements =
      "the PLY header must announce one element vertex with x, y, z and one element face with a list "
      "vertex_indices";
  const std::string words =
      " in the PLY header; allowed are comment, obj_info, element, property and end_header";
  EXPECT_EQ(reason(with("ply", "plx")), "the file does not begin with the line \"ply\"");
  EXPECT_EQ(reason(with("ascii", "binary")),
            "the second line must be \"format\" with ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(reason(with("ascii 1.0", "ascii 2.0")), "PLY version \"2.0\" is not read; allowed is 1.0");
  EXPECT_EQ(reason(with("element vertex", "remark\nelement vertex")), "unexpected word \"remark\"" + words);
  EXPECT_EQ(reason(with("end_header\n", "")), "unexpected word \"0\"" + words);
  EXPECT_EQ(reason(with("float y", "half y")),
            "unknown PLY type \"half\"; allowed are char, uchar, short, ushort, int, uint, float, double");
  EXPECT_EQ(reason(with("float y", "float")), "a PLY property has no name; give type and name");
  EXPECT_EQ(reason(with("float y", "float y w")),
            "unexpected word \"w\" in line 5 of the PLY header; allowed is the end of the line");
  EXPECT_EQ(reason(with("list uchar", "list float")),
            "a PLY list is counted in \"float\"; allowed are integer types");
  EXPECT_EQ(reason(with("uchar int", "uchar float")),
            "PLY list \"vertex_indices\" has the type \"float\"; allowed are integer types");
  EXPECT_EQ(reason(with("float z", "float z\nproperty float x")),
            "PLY element \"vertex\" has the property \"x\" twice");
  EXPECT_EQ(reason(with("vertex_indices", "vertex_index\nproperty list uchar int vertex_indices")),
            "PLY element \"face\" has the property \"vertex_indices\" twice");
  for (const auto& [old_text, new_text] : std::vector<std::pair<std::string, std::string>>{
           {"float z", "float w"},
           {"vertex_indices", "corners"},
           {"list uchar int", "int"},
           {faces, ""},
           {faces, faces + faces},
           {"element face", "element vertex 1\nproperty int a\nelement face"}})
    EXPECT_EQ(reason(with(old_text, new_text)), elements);
  EXPECT_EQ(reason(with("element face", "element material 1\nelement face")),
            "PLY element \"material\" has no property");
  EXPECT_EQ(reason(with("element face", "element tristrips")),
            "PLY triangle strips are not read; give the triangles as element face");
  EXPECT_EQ(reason(whole.substr(0, 40)),
            "the PLY header has no end; \"end_header\" must follow the properties");
  EXPECT_EQ(reason("ply\n" + std::string(5000, 'x')),
            "the PLY header has a line of more than 4096 characters");
}

}  // namespace
}  // namespace hitpipe::ref::ply_reader_test
