// The binary form of glTF: a header and chunks.
#pragma once

#include <optional>
#include <string_view>

namespace hitpipe::ref {

struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// True if the bytes begin with "glTF".
[[nodiscard]] bool is_glb(std::string_view bytes);

/// The chunks of a GLB of version 2. Chunks of other types are skipped, as the specification asks.
[[nodiscard]] GlbChunks read_glb(std::string_view bytes);

}  // namespace hitpipe::ref
