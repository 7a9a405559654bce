#include "rays/files/whole_mesh.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

/// A face with n >= 3 corners gives n - 2 triangles, one after the other; others give none. Takes `mesh.corners`
/// where all faces are triangles. A message names the face, counted from 0.
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

/// Of each face: the number of triangles before it. Empty where all faces are triangles.
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

std::uint64_t hash(const glm::dvec3& p) {
  constexpr std::uint64_t odd =
      0x9E3779B97F4A7C15U;  // 2^64 divided by the golden ratio, as in Fibonacci hashing
  std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) * odd;
  h = (std::rotl(h, 27) ^ std::bit_cast<std::uint64_t>(p.y)) * odd;
  h = (std::rotl(h, 27) ^ std::bit_cast<std::uint64_t>(p.z)) * odd;
  return h ^ h >> 32U;
}

/// Positions that no triangle uses may lie anywhere. Adding +0 turns -0 into +0, so that equal positions have
/// equal bits.
std::vector<glm::dvec3> checked(std::vector<glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
  for (const glm::uvec3& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& p = positions[triangle[k]];
      if (!fits_binary32(p))
        reject(fmt::format("a vertex lies at ({}, {}, {}); coordinates must be finite and below 3.4e38", p.x,
                           p.y, p.z));
    }
  }
  for (glm::dvec3& p : positions) p += 0.0;
  return positions;
}

}  // namespace

bool fits_binary32(const glm::dvec3& p) {
  const auto fits = [](double x) { return std::abs(x) <= double{std::numeric_limits<float>::max()}; };
  return fits(p.x) && fits(p.y) && fits(p.z);
}

SourceMesh whole_mesh(FileMesh file) {
  SourceMesh mesh;
  mesh.faces = first_numbers(file);
  mesh.triangles = triangles_of(file);
  mesh.vertices = checked(std::move(file.positions), mesh.triangles);
  return mesh;
}

void join_positions(SourceMesh& mesh) {
  constexpr std::uint32_t none = ~0U;
  constexpr std::uint32_t used = none - 1;
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), none);
  for (const auto* const all : {&mesh.triangles, &mesh.dropped_corners})
    for (const glm::uvec3& t : *all) renumbered[t.x] = renumbered[t.y] = renumbered[t.z] = used;
  // Open addressing at a load of at most one half; entries are new vertex numbers.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.vertices.size()), none);
  const std::uint64_t mask = table.size() - 1;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (renumbered[v] == none) continue;
    std::uint64_t slot = hash(mesh.vertices[v]) & mask;
    while (table[slot] != none && mesh.vertices[table[slot]] != mesh.vertices[v]) slot = (slot + 1) & mask;
    if (table[slot] == none) {
      mesh.vertices[kept] = mesh.vertices[v];
      table[slot] = kept++;
    }
    renumbered[v] = table[slot];
  }
  mesh.vertices.resize(kept);
  mesh.vertices.shrink_to_fit();
  for (auto* const all : {&mesh.triangles, &mesh.dropped_corners})
    for (glm::uvec3& t : *all) t = {renumbered[t.x], renumbered[t.y], renumbered[t.z]};
}

}  // namespace hitpipe::ref
