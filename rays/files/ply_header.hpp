// The header of a PLY file: its elements and their properties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hitpipe::ref {

struct PlyScalar {
  enum Kind { signed_int, unsigned_int, floating };
  std::string_view name;
  std::uint8_t bytes;
  Kind kind;
};

struct PlyProperty {
  std::string name;
  std::optional<PlyScalar> count;  ///< of a list
  PlyScalar type;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum Encoding { text, little_endian, big_endian };
  Encoding encoding = text;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  ///< the body begins behind them
  std::size_t lines = 0;
};

/// The lines of a header end with LF or CR LF. If the first line ends with CR alone, all end so. Exactly one
/// line end is behind "end_header". Elements of other names than vertex and face may have any property.
/// Refuses a header without one element vertex with x, y, z and one element face with one list
/// vertex_indices or vertex_index. Triangle strips are refused by name.
[[nodiscard]] PlyHeader read_ply_header(std::string_view bytes);

[[nodiscard]] bool is_ply_vertex_list(const PlyProperty& property);

}  // namespace hitpipe::ref
