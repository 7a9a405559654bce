// Mesh files: the mesh from each format, and one message for each way in which a file can be bad.
#include "rays/files/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/message_of.hpp"

namespace hitpipe::ref::mesh_file_test {
namespace {

class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("hitpipe_mesh_file_{}_{}", test->name(), ::getpid());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  SourceMesh load(const std::string& name, const std::string& bytes) const {
    return load_mesh(write(name, bytes));
  }

  /// The reason why the file is refused. Also checks that the message begins with the file's name.
  std::string reason(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = write(name, bytes);
    return reason(file);
  }
  static std::string reason(const std::filesystem::path& file) {
    const std::string message = message_of<std::exception>([&] { return load_mesh(file); });
    const std::string prefix = fmt::format("mesh file \"{}\": ", file.string());
    EXPECT_THAT(message, testing::StartsWith(prefix));
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0);
    return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
  }

  std::filesystem::path folder_;
};

const std::string obj_corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string ply(const std::string& vertices, const std::string& faces, const std::string& body,
                const std::string& format = "ascii") {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment made by a test\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n{}",
      format, vertices, faces, body);
}
const std::string ply_corners = "0 0 0\n1 0 0\n0 1 0\n";

template <class T>
std::string bytes(T value, bool big_endian = false) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(out.begin(), out.end());
  return out;
}

std::string binary_triangle(bool big_endian, std::int32_t last_index) {
  std::string body;
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) body += bytes(x, big_endian);
  body += '\3';
  for (const std::int32_t index : {0, 1, last_index}) body += bytes(index, big_endian);
  return body;
}

std::string binary_stl(std::uint32_t announced, const std::vector<std::array<float, 9>>& facets) {
  std::string out(80, '\0');
  out += bytes(announced);
  for (const auto& facet : facets) {
    out += bytes(0.F) + bytes(0.F) + bytes(1.F);
    for (const float x : facet) out += bytes(x);
    out += std::string(2, '\0');
  }
  return out;
}

std::string text_stl(const std::string& second_vertex) {
  return fmt::format(
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex {}\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid s\n",
      second_vertex);
}

/// A triangle (0 0 0), (1 0 0), (0 1 0) under two nodes: scaled by 2, then moved by 10 along x.
const std::string gltf_head =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"translation":[10,0,0],"children":[1]},{"scale":[2,2,2],"mesh":0}],)";
const std::string gltf_buffer =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA";
std::string gltf(int mode = 4, const std::string& buffer = gltf_buffer, unsigned vertices = 3) {
  return fmt::format(
      R"({}"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":{}}}]}}],
        "buffers":[{{"byteLength":42,"uri":"{}"}}],
        "bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},
                     {{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}]}})",
      gltf_head, mode, buffer, vertices);
}

TEST_F(MeshFile, TextPlyIsReadWithEitherLineEnd) {
  std::string text = ply("3", "1", ply_corners + "3 0 1 2\n");
  EXPECT_EQ(load("lf.ply", text).triangles.size(), 1U);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
  const SourceMesh mesh = load("crlf.ply", text);
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.corners(0).b, glm::dvec3(1, 0, 0));
}

TEST_F(MeshFile, BinaryPlyIsReadInEitherByteOrder) {
  const SourceMesh little = load("l.ply", ply("3", "1", binary_triangle(false, 2), "binary_little_endian"));
  const SourceMesh big = load("b.ply", ply("3", "1", binary_triangle(true, 2), "binary_big_endian"));
  ASSERT_EQ(little.triangles.size(), 1U);
  ASSERT_EQ(big.triangles.size(), 1U);
  EXPECT_EQ(little.corners(0).c, glm::dvec3(0, 1, 0));
  EXPECT_EQ(big.corners(0).c, glm::dvec3(0, 1, 0));
}

TEST_F(MeshFile, StlCornersAreJoined) {
  const SourceMesh text = load("t.stl", text_stl("1 0 0"));
  EXPECT_EQ(text.vertices.size(), 3U);
  const SourceMesh binary =
      load("b.STL", binary_stl(2, {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, -0.F, 1, -0.F}}));
  EXPECT_EQ(binary.triangles.size(), 2U);
  EXPECT_EQ(binary.vertices.size(), 4U);  // 6 corners, two shared, one of them written with -0
}

TEST_F(MeshFile, GltfNodeTransformsAreApplied) {
  const SourceMesh mesh = load("m.gltf", gltf());
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.corners(0).a, glm::dvec3(10, 0, 0));
  EXPECT_EQ(mesh.corners(0).b, glm::dvec3(12, 0, 0));
  EXPECT_EQ(mesh.corners(0).c, glm::dvec3(10, 2, 0));
}

TEST_F(MeshFile, GlbIsRead) {
  std::string json = gltf();
  const std::string uri = ",\"uri\":\"" + gltf_buffer + "\"";
  json.erase(json.find(uri), uri.size());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string buffer = binary_triangle(false, 2).substr(0, 36);
  for (const std::uint16_t index : std::array<std::uint16_t, 4>{0, 1, 2, 0}) buffer += bytes(index);
  const auto length = static_cast<std::uint32_t>(json.size());
  const std::string whole = "glTF" + bytes(2U) + bytes(28 + length + 44) + bytes(length) + "JSON" + json +
                            bytes(44U) + std::string("BIN\0", 4) + buffer;
  EXPECT_EQ(load("m.glb", whole).triangles.size(), 1U);
  EXPECT_EQ(reason("a.glb", whole.substr(0, whole.size() / 2)),
            fmt::format("the GLB header announces {} bytes, the file has {}; they must be equal",
                        whole.size(), whole.size() / 2));
  EXPECT_EQ(reason("b.glb", whole + "abcdefghi"),
            fmt::format("the GLB header announces {} bytes, the file has {}; they must be equal",
                        whole.size(), whole.size() + 9));
}

TEST_F(MeshFile, PolygonsAreTriangulatedAndLinesDropped) {
  const SourceMesh mesh = load("m.obj", obj_corners + "v 1 1 0\nv 0.5 0.5 1\nf 1 2 4 3\nl 1 5\nf -5 -4 -1\n");
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.dropped.size(), 0U);
}

TEST_F(MeshFile, DegenerateTrianglesAreDroppedAndCounted) {
  const SourceMesh mesh = load("m.obj", obj_corners + "v 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\nf 2 4 3\n");
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.dropped.size(), 2U);
}

TEST_F(MeshFile, UnusedVerticesAreLeftOut) {
  const SourceMesh mesh = load("m.obj", "v 9 9 9\n" + obj_corners + "f 2 3 4\n");
  EXPECT_EQ(mesh.vertices, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  const SourceMesh odd = load("o.obj", "v nan 9 9\nv 1e99 0 -inf\n" + obj_corners + "v 1e400 0 0\nf 3 4 5\n");
  EXPECT_EQ(odd.vertices, mesh.vertices);
}

TEST_F(MeshFile, MissingFolderEmptyAndUnknownAreRejected) {
  EXPECT_EQ(reason(folder_ / "none.ply"), "no such file; give a .obj, .ply, .stl, .gltf or .glb file");
  EXPECT_EQ(reason(folder_), "is not a regular file; give a .obj, .ply, .stl, .gltf or .glb file");
  EXPECT_EQ(reason("m.obj", ""), "is empty; at least one triangle is needed");
  EXPECT_EQ(reason("m.xyz", "1"), "unknown extension \".xyz\"; allowed are .obj, .ply, .stl, .gltf and .glb");
}

/// The readers say what is wrong in a file (obj_reader_test.cpp and so on); the file's name stands before it.
TEST_F(MeshFile, WhatAReaderRefusesIsRejectedWithTheFile) {
  EXPECT_EQ(reason("i.obj", "v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n"),
            "line 2: a vertex lies at (1, inf, 0); coordinates must be finite");
  EXPECT_EQ(reason("a.ply", ply("3", "1", ply_corners + "3 0 1 3\n")),
            "line 14: face 0 refers to vertex 3; the file has vertices 0 to 2");
  EXPECT_EQ(reason("n.stl", text_stl("0 0 nan")),
            "line 5: a vertex lies at (0, 0, nan); coordinates must be finite");
  EXPECT_EQ(reason("m.gltf", gltf(4, "none.bin")), "buffer file \"none.bin\": no such file");
}

TEST_F(MeshFile, CoordinatesBeyondBinary32AreRejected) {
  EXPECT_EQ(reason("o.obj", "v 0 0 0\nv 1e99 0 0\nv 0 1 0\nf 1 2 3\n"),
            "a vertex lies at (1e+99, 0, 0); coordinates must be finite and below 3.4e38");
  std::string far_away = gltf();
  far_away.replace(far_away.find("[2,2,2]"), 7, "[1e38,1,1]");
  far_away.replace(far_away.find("\"translation\":[10,0,0]"), 22, "\"scale\":[10,1,1]");
  EXPECT_EQ(reason("t.gltf", far_away),
            "a vertex lies at (1e+39, 0, 0); coordinates must be finite and below 3.4e38");
}

TEST_F(MeshFile, PolygonThatCrossesItselfIsRejected) {
  EXPECT_EQ(reason("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4\nf 1 2 3 4\n"),
            "face 1 with 4 corners crosses itself or covers an area twice; allowed are flat faces that do "
            "not cross "
            "themselves");
}

TEST_F(MeshFile, GroupsCoverTheTrianglesThatAreLeft) {
  std::vector<MeshGroup> groups;
  const SourceMesh mesh = load_mesh(
      write("g.obj",
            obj_corners + "v 1 1 0\no one\nf 1 2 4 3\nl 1 2\no two\nf 1 1 2\nf 1 2 3\no three\nf 2 2 2\n"),
      groups);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.dropped, (std::vector<std::uint32_t>{2, 4}));
  EXPECT_EQ(mesh.without_area, 2U);
  EXPECT_EQ(groups[0].name, "one");
  EXPECT_EQ(groups[0].count, 2U);
  EXPECT_EQ(groups[1].name, "two");
  EXPECT_EQ(groups[1].first, 2U);
  EXPECT_EQ(groups[1].count, 1U);
  EXPECT_EQ(groups[2].count, 0U);
}

TEST_F(MeshFile, OtherFormatUnderAKnownNameIsNotGuessed) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_THAT(reason("a.gltf", off), testing::StartsWith("is no JSON: "));
  EXPECT_EQ(reason("b.glb", off), "does not begin with \"glTF\" as a GLB does");
  EXPECT_EQ(reason("c.obj", off),
            "line 1: unknown word \"OFF\"; allowed are those of Wavefront's OBJ specification");
}

TEST_F(MeshFile, FileWithoutTriangleIsRejected) {
  EXPECT_EQ(reason("a.obj", obj_corners + "l 1 2 3\n"), "has no triangle; at least one is needed");
  EXPECT_EQ(reason("b.ply", ply("3", "0", ply_corners)), "has no triangle; at least one is needed");
  EXPECT_EQ(reason("c.gltf", gltf(0)), "has no triangle; at least one is needed");
  EXPECT_EQ(reason("d.stl", "solid s\nendsolid s\n"), "has no triangle; at least one is needed");
  EXPECT_EQ(reason("e.obj", obj_corners + "f 1 1 2\nf 1 2 2\n"),
            "has only triangles without area (2); at least one with area is needed");
}

TEST_F(MeshFile, QuotedLineBreaksStayOutOfTheMessage) {
  EXPECT_EQ(reason("m.ply", "ply\nformat ascii 1.0\na\rb\n"),
            "unexpected word \"a\" in the PLY header; allowed are comment, obj_info, element, property and "
            "end_header");
  EXPECT_EQ(reason("n.ply",
                   "ply\nformat ascii 1.0\na\x01"
                   "b\n"),
            "unexpected word \"a b\" in the PLY header; allowed are comment, obj_info, element, property and "
            "end_header");
}

}  // namespace
}  // namespace hitpipe::ref::mesh_file_test
