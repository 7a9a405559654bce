#include "rays/files/stl_reader.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/files/stl_text.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::size_t stl_header_bytes = 84;
constexpr std::size_t stl_facet_bytes = 50;

std::uint32_t stl_word(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;  // little-endian
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << 8U * i;
  return word;
}

/// Why a file is no text, which may have been meant as one.
[[noreturn]] void reject_stl(std::string_view bytes, const std::string& binary) {
  reject(fmt::format(
      "is neither a text STL ({}) nor a binary one whose length fits ({})",
      bytes.starts_with("solid") ? "it must have \"facet\" behind its name" : "it must begin with \"solid\"",
      binary));
}

FileMesh read_stl_binary(std::string_view bytes, std::size_t facets) {
  const std::size_t end = stl_header_bytes + stl_facet_bytes * facets;
  if (bytes.size() < end || bytes.size() - end >= stl_facet_bytes)
    reject_stl(bytes,
               fmt::format("it announces {} facets, which need {} bytes and up to 49 more; the file has {}",
                           facets, end, bytes.size()));
  FileMesh mesh;
  mesh.positions.reserve(3 * facets);
  mesh.corners.reserve(3 * facets);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    std::size_t at = stl_header_bytes + stl_facet_bytes * facet + 12;  // behind the normal
    for (int corner = 0; corner < 3; ++corner, at += 12) {
      const auto number = [&](std::size_t k) {
        return static_cast<double>(std::bit_cast<float>(stl_word(bytes, at + 4 * k)));
      };
      add_stl_corner(mesh, {number(0), number(1), number(2)}, "byte", at);
    }
  }
  return mesh;
}

}  // namespace

FileMesh read_stl(std::string_view bytes) {
  const bool has_header = bytes.size() >= stl_header_bytes;
  const std::size_t facets = has_header ? stl_word(bytes, stl_header_bytes - 4) : 0;
  const bool exact = has_header && bytes.size() == stl_header_bytes + stl_facet_bytes * facets;
  if (!exact && begins_as_stl_text(bytes)) return read_stl_text(bytes);
  if (!has_header)
    reject_stl(bytes, fmt::format("it must have 84 bytes or more; the file has {}", bytes.size()));
  return read_stl_binary(bytes, facets);
}

}  // namespace hitpipe::ref
