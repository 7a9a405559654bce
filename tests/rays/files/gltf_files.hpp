// Small glTF files for tests, as JSON that a test changes.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "rays/files/gltf_reader.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref {

inline std::string base64(std::string_view bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k > bytes.size() - i ? '=' : digits[bits >> (18 - 6 * k) & 63U];
  }
  return out;
}

template <class Integer>
std::string little(const std::vector<Integer>& numbers) {
  std::string out;
  for (const Integer number : numbers) {
    for (std::size_t i = 0; i < sizeof number; ++i)
      out += static_cast<char>(static_cast<std::uint64_t>(number) >> 8U * i & 0xFFU);
  }
  return out;
}

inline std::string floats(const std::vector<float>& numbers) {
  std::vector<std::uint32_t> bits;
  for (const float number : numbers) bits.push_back(std::bit_cast<std::uint32_t>(number));
  return little(bits);
}

/// Where square_gltf() has its buffer: 4 corners of a square, then 6 indices of 2 bytes.
inline const std::string square_bytes =
    floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + little<std::uint16_t>({0, 1, 2, 1, 3, 2});

inline nlohmann::json square_gltf() {
  return nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"name": "square", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,)" +
                               base64(square_bytes) + R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})");
}

/// Adds a buffer and a view of it to the file; returns the number of the view.
inline std::size_t add_view(nlohmann::json& file, const std::string& bytes) {
  file["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "data:;base64," + base64(bytes)}});
  file["bufferViews"].push_back({{"buffer", file["buffers"].size() - 1}, {"byteLength", bytes.size()}});
  return file["bufferViews"].size() - 1;
}

/// Adds an accessor with a buffer of its own; returns its number.
inline std::size_t add_accessor(nlohmann::json& file, const std::string& bytes, int component_type, int count,
                                const std::string& type) {
  const std::size_t view = add_view(file, bytes);
  file["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return file["accessors"].size() - 1;
}

inline FileMesh read(const nlohmann::json& file) {
  return read_gltf(file.dump(), "m.gltf");
}
inline std::string reason(const nlohmann::json& file) {
  return message_of([&] { static_cast<void>(read(file)); });
}
/// With a value put at a JSON pointer.
inline std::string reason_with(const std::string& place, const nlohmann::json& value) {
  nlohmann::json file = square_gltf();
  file[nlohmann::json::json_pointer(place)] = value;
  return reason(file);
}
inline std::string reason_without(const std::string& owner, const std::string& key) {
  nlohmann::json file = square_gltf();
  file[nlohmann::json::json_pointer(owner)].erase(key);
  return reason(file);
}

}  // namespace hitpipe::ref
