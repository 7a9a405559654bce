#include "rays/files/join_positions.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hitpipe::ref {

namespace {

std::uint64_t hash(const glm::dvec3& p) {
  constexpr std::uint64_t odd =
      0x9E3779B97F4A7C15U;  // 2^64 divided by the golden ratio, as in Fibonacci hashing
  std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) * odd;
  h = (std::rotl(h, 27) ^ std::bit_cast<std::uint64_t>(p.y)) * odd;
  h = (std::rotl(h, 27) ^ std::bit_cast<std::uint64_t>(p.z)) * odd;
  return h ^ h >> 32U;
}

}  // namespace

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
