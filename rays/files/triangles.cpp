#include "rays/files/triangles.hpp"

#include <array>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/files/polygon.hpp"

namespace hitpipe::ref {

namespace {

std::uint32_t triangles_in(std::uint32_t corners) {
  return corners < 3 ? 0 : corners - 2;
}

/// The sum of corners - 2 over the faces.
std::uint64_t expected_triangles(const FileMesh& mesh) {
  if (mesh.sizes.empty()) return mesh.corners.size() / 3;
  std::uint64_t count = 0;
  for (const std::uint32_t size : mesh.sizes) count += triangles_in(size);
  return count;
}

}  // namespace

std::vector<glm::uvec3> triangles_of(FileMesh& mesh) {
  const std::uint64_t expected = expected_triangles(mesh);
  if (expected >= std::numeric_limits<std::uint32_t>::max())
    reject(fmt::format("has {} triangles; allowed are 1 to 4294967294", expected));
  std::vector<glm::uvec3> triangles;
  triangles.reserve(expected);
  const std::span<const std::uint32_t> corners = mesh.corners;
  if (mesh.sizes.empty()) {
    for (std::size_t i = 0; i < corners.size(); i += 3)
      triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  }
  std::vector<std::array<std::uint32_t, 3>> parts;
  std::size_t at = 0;
  for (std::size_t face = 0; face < mesh.sizes.size(); ++face) {
    const std::span<const std::uint32_t> polygon = corners.subspan(at, mesh.sizes[face]);
    at += polygon.size();
    if (polygon.size() == 3) triangles.emplace_back(polygon[0], polygon[1], polygon[2]);
    if (polygon.size() <= 3) continue;
    parts.clear();
    if (const std::string fault = triangulate(mesh.positions, polygon, parts); !fault.empty())
      reject(fmt::format("face {} with {} corners {}; allowed are flat faces that do not cross themselves",
                         face, polygon.size(), fault));
    for (const auto& [a, b, c] : parts) triangles.emplace_back(a, b, c);
  }
  if (triangles.size() != expected)
    throw std::logic_error(
        fmt::format("{} triangles were made of faces that have {}", triangles.size(), expected));
  mesh.corners = {};
  return triangles;
}

std::vector<std::uint32_t> first_numbers(const FileMesh& mesh) {
  std::vector<std::uint32_t> first;
  first.reserve(mesh.sizes.size());
  std::uint32_t count = 0;
  for (const std::uint32_t size : mesh.sizes) {
    first.push_back(count);
    count += triangles_in(size);
  }
  return first;
}

}  // namespace hitpipe::ref
