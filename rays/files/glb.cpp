#include "rays/files/glb.hpp"

#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/files/little_endian.hpp"

namespace hitpipe::ref {

bool is_glb(std::string_view bytes) {
  return bytes.starts_with("glTF");
}

GlbChunks read_glb(std::string_view bytes) {
  constexpr std::size_t header = 12;
  constexpr std::size_t chunk_header = 8;
  constexpr std::uint32_t json_type = 0x4E4F534A;    // "JSON"
  constexpr std::uint32_t binary_type = 0x004E4942;  // "BIN" and a zero
  if (!is_glb(bytes)) reject("does not begin with \"glTF\" as a GLB does");
  if (bytes.size() < header)
    reject(fmt::format("is cut short; the GLB header has 12 bytes, the file has {}", bytes.size()));
  const auto word = [&](std::size_t at) { return little_endian<std::uint32_t>(bytes.data() + at); };
  if (const std::uint32_t version = word(4); version != 2)
    reject(version == 1 ? std::string("glTF 1.0 is not read; allowed is 2.0")
                        : fmt::format("GLB version {} is not read; allowed is 2", version));
  if (word(8) != bytes.size())
    reject(fmt::format("the GLB header announces {} bytes, the file has {}; they must be equal", word(8),
                       bytes.size()));
  GlbChunks chunks;
  std::size_t number = 0;
  for (std::size_t at = header; at < bytes.size(); ++number) {
    if (bytes.size() - at < chunk_header)
      reject(fmt::format("is cut short; the chunk header at byte {} has 8 bytes, {} are left", at,
                         bytes.size() - at));
    const std::uint32_t length = word(at);
    const std::uint32_t type = word(at + 4);
    if (length > bytes.size() - at - chunk_header)
      reject(fmt::format("is cut short; the chunk at byte {} announces {} bytes, {} are left", at, length,
                         bytes.size() - at - chunk_header));
    if (length % 4 != 0)
      reject(fmt::format("the chunk at byte {} announces {} bytes; allowed are multiples of 4", at, length));
    if ((number == 0) != (type == json_type))
      reject(fmt::format("the chunk at byte {} is {}; the first chunk must be JSON, and no other", at,
                         type == json_type ? "JSON" : "not JSON"));
    const std::string_view body = bytes.substr(at + chunk_header, length);
    if (number == 0) chunks.json = body;
    if (type == binary_type) {
      if (number != 1) reject(fmt::format("the chunk at byte {} is BIN; only the second chunk may be", at));
      chunks.binary = body;
    }
    at += chunk_header + length;
  }
  if (number == 0) reject("is cut short; a GLB has a JSON chunk behind its header");
  return chunks;
}

}  // namespace hitpipe::ref
