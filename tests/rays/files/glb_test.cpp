// GLB files and one message for each fault of their chunks.
#include "rays/files/glb.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rays/files/gltf_files.hpp"

namespace hitpipe::ref::glb_test {
namespace {

const std::string binary_type = std::string("BIN\0", 4);

std::string word(std::uint32_t value) {
  return little<std::uint32_t>({value});
}
std::string chunk(const std::string& type, const std::string& bytes) {
  return word(static_cast<std::uint32_t>(bytes.size())) + type + bytes;
}
std::string glb(const std::string& chunks, std::uint32_t version = 2) {
  return "glTF" + word(version) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}
std::string json_chunk() {
  nlohmann::json file = square_gltf();
  file["buffers"][0].erase("uri");
  std::string text = file.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return chunk("JSON", text);
}
std::string reason(const std::string& bytes) {
  return message_of([&] { static_cast<void>(read_gltf(bytes, "m.glb")); });
}

TEST(Glb, BinaryChunkIsTheFirstBuffer) {
  const std::string rest = chunk(binary_type, square_bytes);
  for (const std::string& whole :
       {glb(json_chunk() + rest), glb(json_chunk() + rest + chunk("MORE", "1234"))}) {
    const FileMesh mesh = read_gltf(whole, "m.glb");
    EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    EXPECT_EQ(mesh.positions[3], glm::dvec3(1, 1, 0));
  }
}

TEST(Glb, FaultsOfTheChunksAreRefused) {
  const std::string json = chunk("JSON", "{}  ");
  for (const auto& [bytes, message] : std::vector<std::pair<std::string, std::string>>{
           {"{}", "does not begin with \"glTF\" as a GLB does"},
           {"glTF\2", "is cut short; the GLB header has 12 bytes, the file has 5"},
           {glb(json, 1), "glTF 1.0 is not read; allowed is 2.0"},
           {glb(json, 3), "GLB version 3 is not read; allowed is 2"},
           {glb(""), "is cut short; a GLB has a JSON chunk behind its header"},
           {glb(json + "abc"), "is cut short; the chunk header at byte 24 has 8 bytes, 3 are left"},
           {glb(word(0xFFFFFFFFU) + "JSON{}  "),
            "is cut short; the chunk at byte 12 announces 4294967295 bytes, 4 are left"},
           {glb(chunk("JSON", "{} ")), "the chunk at byte 12 announces 3 bytes; allowed are multiples of 4"},
           {glb(chunk(binary_type, "1234")),
            "the chunk at byte 12 is not JSON; the first chunk must be JSON, and no other"},
           {glb(json + json), "the chunk at byte 24 is JSON; the first chunk must be JSON, and no other"},
           {glb(json + chunk("MORE", "1234") + chunk(binary_type, "1234")),
            "the chunk at byte 36 is BIN; only the second chunk may be"},
           {glb(json) + chunk(binary_type, "1234"),
            "the GLB header announces 24 bytes, the file has 36; they must be equal"}})
    EXPECT_EQ(reason(bytes), message);
}

TEST(Glb, CutShortIsRefusedAtEveryLength) {
  const std::string whole = glb(json_chunk() + chunk(binary_type, square_bytes));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(reason(whole.substr(0, length)), "no exception") << length << " bytes";
}

TEST(Glb, BufferWithoutUriNeedsTheChunk) {
  EXPECT_EQ(reason(glb(json_chunk())),
            "buffers[0]: needs the key \"uri\"; only the first buffer of a GLB may be its BIN chunk");
  EXPECT_EQ(reason(glb(json_chunk() + chunk(binary_type, square_bytes.substr(0, 56)))),
            "buffers[0].byteLength: announces 60 bytes; the buffer has 56");
}

}  // namespace
}  // namespace hitpipe::ref::glb_test
