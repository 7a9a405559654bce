// Buffers and accessors of glTF: every kind of numbers, and one message for each fault.
#include "rays/files/gltf_accessor.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/files.hpp"
#include "host/outputs.hpp"
#include "tests/rays/files/gltf_files.hpp"

namespace hitpipe::ref::gltf_accessor_test {
namespace {

using nlohmann::json;
using Corners = std::vector<std::uint32_t>;
const Corners square{0, 1, 2, 1, 3, 2};

TEST(GltfAccessor, IndicesOfEachTypeAreRead) {
  for (const auto& [type, bytes] :
       std::vector<std::pair<int, std::string>>{{5121, little<std::uint8_t>({0, 1, 2, 1, 3, 2})},
                                                {5125, little<std::uint32_t>({0, 1, 2, 1, 3, 2})}}) {
    json file = square_gltf();
    file["meshes"][0]["primitives"][0]["indices"] = add_accessor(file, bytes, type, 6, "SCALAR");
    EXPECT_EQ(read(file).corners, square);
  }
  json none = square_gltf();
  none["meshes"][0]["primitives"][0].erase("indices");
  none["accessors"][0]["count"] = 3;
  EXPECT_EQ(read(none).corners, (Corners{0, 1, 2}));
}

TEST(GltfAccessor, StrideAndOffsetsAreFollowed) {
  json file = square_gltf();
  const std::size_t view =
      add_view(file, "skip" + floats({9, 0, 0, 1, 9, 9, 1, 0, 1, 9, 9, 0, 1, 1, 9, 9, 1, 1, 1}));
  file["bufferViews"][view]["byteOffset"] = 4;
  file["bufferViews"][view]["byteLength"] = 76;
  file["bufferViews"][view]["byteStride"] = 20;
  file["accessors"][0]["bufferView"] = view;
  file["accessors"][0]["byteOffset"] = 4;
  EXPECT_EQ(read(file).positions, (std::vector<glm::dvec3>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}));
}

TEST(GltfAccessor, QuantisedPositionsNeedTheirExtension) {
  struct Case {
    int type;
    bool normalised;
    std::string bytes;
    glm::dvec3 last;
  };
  for (const Case& c : {Case{5120, false, little<std::int8_t>({-128, 127, 3}), {-128, 127, 3}},
                        Case{5120, true, little<std::int8_t>({-128, 127, -127}), {-1, 1, -1}},
                        Case{5121, true, little<std::uint8_t>({255, 51, 0}), {1, 0.2, 0}},
                        Case{5122, false, little<std::int16_t>({-32768, 5, 0}), {-32768, 5, 0}},
                        Case{5122, true, little<std::int16_t>({-32768, 32767, 0}), {-1, 1, 0}},
                        Case{5123, true, little<std::uint16_t>({65535, 13107, 0}), {1, 0.2, 0}}}) {
    json file = square_gltf();
    const std::size_t size = c.bytes.size();
    const std::size_t stride = (size + 3) / 4 * 4;
    const std::size_t accessor =
        add_accessor(file, std::string(3 * stride, '\0') + c.bytes + "xx", c.type, 4, "VEC3");
    file["bufferViews"].back()["byteStride"] = stride;
    file["accessors"][accessor]["normalized"] = c.normalised;
    file["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
    EXPECT_EQ(reason(file), "accessors[2]: is for positions and has the componentType " +
                                std::to_string(c.type) +
                                "; allowed are 5126, and 5120 to 5123 with KHR_mesh_quantization");
    file["extensionsUsed"] = file["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(read(file).positions[3], c.last);
  }
}

TEST(GltfAccessor, SparseElementsReplaceOthersOrZeros) {
  json file = square_gltf();
  const std::size_t indices = add_view(file, little<std::uint16_t>({1, 3}));
  const std::size_t values = add_view(file, floats({5, 6, 7, 8, 9, 10}));
  file["accessors"][0]["sparse"] = {{"count", 2},
                                    {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                    {"values", {{"bufferView", values}}}};
  EXPECT_EQ(read(file).positions, (std::vector<glm::dvec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}, {8, 9, 10}}));
  file["accessors"][0].erase("bufferView");
  EXPECT_EQ(read(file).positions, (std::vector<glm::dvec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 0}, {8, 9, 10}}));
  json late = file;
  late["accessors"][0]["count"] = 3;
  EXPECT_EQ(reason(late), "accessors[0].sparse.indices: entry 1 is 3; allowed are 2 to 2, in rising order");
  late["accessors"][0]["sparse"]["count"] = 4;
  EXPECT_EQ(reason(late), "accessors[0].sparse.count: must be a whole number of 0 to 3");
  json halved = file;
  halved["accessors"][0]["sparse"].erase("values");
  EXPECT_EQ(reason(halved), "accessors[0].sparse: needs the key \"values\"");
  file["accessors"][0].erase("sparse");
  EXPECT_EQ(read(file).positions, std::vector<glm::dvec3>(4));
}

TEST(GltfAccessor, PrimitivesThatUseAFewOfManyPositionsGetThoseAlone) {
  json file = square_gltf();
  file["accessors"][1]["count"] = 3;
  file["bufferViews"][1]["byteOffset"] = 54;
  file["bufferViews"][1]["byteLength"] = 6;
  const FileMesh mesh = read(file);
  EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.corners, (Corners{0, 1, 2}));
}

TEST(GltfAccessor, RangesAreChecked) {
  EXPECT_EQ(reason_with("/accessors/0/count", 5),
            "accessors[0]: has 5 elements, which end at byte 60 of the bufferView; it has 48 bytes");
  EXPECT_EQ(reason_with("/accessors/0/count", 4000000000U),
            "accessors[0]: has 4000000000 elements, which end at byte 48000000000 of the bufferView; it has "
            "48 bytes");
  EXPECT_EQ(reason_with("/accessors/0/byteOffset", 4),
            "accessors[0]: has 4 elements, which end at byte 52 of the bufferView; it has 48 bytes");
  EXPECT_EQ(reason_with("/accessors/0/byteOffset", 2),
            "accessors[0]: begins at byte 2 of the buffer; allowed are multiples of 4");
  EXPECT_EQ(reason_with("/bufferViews/1/byteOffset", 56),
            "bufferViews[1]: has bytes 56 to 68; the buffer has 60 bytes");
  EXPECT_EQ(reason_with("/bufferViews/0/byteStride", 8),
            "accessors[0]: has elements of 12 bytes; the stride of its bufferView is 8");
  EXPECT_EQ(reason_with("/bufferViews/0/byteStride", 256),
            "bufferViews[0].byteStride: 256 is out of range; allowed are multiples of 4 from 4 to 252");
  EXPECT_EQ(reason_with("/accessors/0/bufferView", 2),
            "accessors[0].bufferView: must be a whole number of 0 to 1");
  EXPECT_EQ(reason_with("/accessors/0/componentType", 5124),
            "accessors[0].componentType: 5124 is not a type of components; allowed are 5120 to 5123, 5125 "
            "and 5126");
  EXPECT_EQ(reason_with("/accessors/0/type", "VEC5"),
            "accessors[0].type: must be SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
  EXPECT_EQ(reason_with("/accessors/0/type", "VEC2"),
            "accessors[0]: is for positions; its type must be VEC3");
  EXPECT_EQ(reason_with("/accessors/1/componentType", 5122),
            "accessors[1]: is for indices; it must be SCALAR, 5121, 5123 or 5125, and not normalized");
  EXPECT_EQ(reason_with("/buffers/0/byteLength", 61),
            "buffers[0].byteLength: announces 61 bytes; the buffer has 60");
  EXPECT_EQ(reason_without("/accessors/0", "count"), "accessors[0]: needs the key \"count\"");
  EXPECT_EQ(reason_without("", "bufferViews"),
            "accessors[0].bufferView: must name one of bufferViews, of which the file has none");
}

TEST(GltfAccessor, DataUrisMustBeBase64) {
  EXPECT_EQ(reason_with("/buffers/0/uri", "data:text/plain,abc"),
            "buffers[0].uri: is a data URI without \";base64,\"; allowed are data URIs with it");
  EXPECT_EQ(reason_with("/buffers/0/uri", "data:;base64,AA A"),
            "buffers[0].uri: character 2 of the base64 data is \" \"; allowed are letters, digits, + and /");
  EXPECT_EQ(reason_with("/buffers/0/uri", "data:;base64,AAAAA"),
            "buffers[0].uri: has 5 base64 digits; the last one has no bits of a byte");
}

TEST(GltfAccessor, FilesOfBuffersAreBesideTheMesh) {
  const host::ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  host::write_file(folder.path() / "my mesh.bin", square_bytes + "behind");
  host::write_file(folder.path() / "short.bin", square_bytes.substr(0, 50));
  const auto read_with = [&](const std::string& uri) {
    json file = square_gltf();
    file["buffers"][0]["uri"] = uri;
    return read_gltf(file.dump(), folder.path() / "m.gltf");
  };
  const auto reason_of = [&](const std::string& uri) {
    return message_of([&] { static_cast<void>(read_with(uri)); });
  };
  EXPECT_EQ(read_with("my%20mesh.bin").corners, square);
  const std::vector<std::string> inputs = host::inputs();  // which no output may replace
  EXPECT_EQ(std::count(inputs.begin(), inputs.end(), folder / "my mesh.bin"), 1);
  EXPECT_EQ(read_with("sub/../my mesh.bin").corners, square);
  EXPECT_EQ(reason_of("short.bin"), "buffers[0].byteLength: announces 60 bytes; the buffer has 50");
  EXPECT_EQ(reason_of("none.bin"), "buffer file \"none.bin\": no such file");
  EXPECT_EQ(reason_of("sub"), "buffer file \"sub\": is not a regular file");
  EXPECT_EQ(reason_of("a%2.bin"),
            "buffers[0].uri: \"a%2.bin\" has a % without two hexadecimal digits, 01 to FF");
  for (const std::string uri : {"http://a/b.bin", "/etc/hosts", "file:b.bin", ""})
    EXPECT_EQ(reason_of(uri), "buffers[0].uri: \"" + uri +
                                  "\" is not read; allowed are data URIs and names relative to the file");
}

}  // namespace
}  // namespace hitpipe::ref::gltf_accessor_test
