#include "rays/files/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/file_mesh.hpp"
#include "rays/files/gltf_reader.hpp"
#include "rays/files/obj_reader.hpp"
#include "rays/files/ply_reader.hpp"
#include "rays/files/polygon.hpp"
#include "rays/files/stl_reader.hpp"
#include "rays/scene/triangle_numbers.hpp"

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

/// Keeps each position that a triangle uses, a dropped one too, once, in the order of first appearance.
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

namespace fs = std::filesystem;
using Read = FileMesh (*)(std::string_view bytes, const fs::path& file);

struct Format {
  std::string_view extension;
  Read read;
};
constexpr std::array formats{
    Format{".obj", read_obj},
    Format{".ply", [](std::string_view bytes, const fs::path&) { return read_ply(bytes); }},
    Format{".stl", [](std::string_view bytes, const fs::path&) { return read_stl(bytes); }},
    Format{".gltf", read_gltf},
    Format{".glb", read_gltf},
};

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Read reader_by_name(const fs::path& file) {
  const std::string extension = lower_extension(file);
  const auto* const found = std::find_if(formats.begin(), formats.end(),
                                         [&](const Format& each) { return each.extension == extension; });
  if (found == formats.end())
    reject(fmt::format("unknown extension \"{}\"; allowed are .obj, .ply, .stl, .gltf and .glb",
                       host::shortened(extension)));
  return found->read;
}

/// Refuses what is no file of a known format.
Read reader_of(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) reject("no such file; give a .obj, .ply, .stl, .gltf or .glb file");
  if (!fs::is_regular_file(status))
    reject("is not a regular file; give a .obj, .ply, .stl, .gltf or .glb file");
  const Read reader = reader_by_name(file);
  if (fs::file_size(file, error) == 0 || error) reject("is empty; at least one triangle is needed");
  return reader;
}

FileMesh read(const fs::path& file) {
  const Read reader = reader_of(file);
  host::never_replace(file);
  const std::optional<std::string> bytes = host::contents_of(file);
  if (!bytes) reject("cannot be read");
  return reader(*bytes, file);
}

/// Positions that no triangle uses may lie anywhere. Adding +0 turns -0 into +0, so that equal positions have
/// equal bits.
std::vector<glm::dvec3> checked(std::vector<glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
  const auto fits = [](double x) { return std::abs(x) <= double{std::numeric_limits<float>::max()}; };
  for (const glm::uvec3& triangle : triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& p = positions[triangle[k]];
      if (!fits(p.x) || !fits(p.y) || !fits(p.z))
        reject(fmt::format("a vertex lies at ({}, {}, {}); coordinates must be finite and below 3.4e38", p.x,
                           p.y, p.z));
    }
  }
  for (glm::dvec3& p : positions) p += 0.0;
  return positions;
}

/// The file's groups as runs of triangles of the mesh.
std::vector<MeshGroup> groups_of(std::vector<FileMesh::Group> groups, const SourceMesh& mesh) {
  const TriangleNumbers numbers(mesh);
  std::vector<MeshGroup> made;
  for (FileMesh::Group& group : groups) {
    const std::uint32_t begin = numbers.kept_below(numbers.first_of(group.first_face));
    if (!made.empty()) made.back().count = begin - made.back().first;
    made.push_back({std::move(group.name), std::move(group.material), group.surface, begin});
  }
  made.back().count = static_cast<std::uint32_t>(mesh.triangles.size()) - made.back().first;
  return made;
}

SourceMesh mesh_of(FileMesh file, std::vector<MeshGroup>& groups) {
  if (file.groups.empty()) file.groups.push_back({});
  SourceMesh mesh;
  mesh.faces = first_numbers(file);
  mesh.triangles = triangles_of(file);
  mesh.vertices = checked(std::move(file.positions), mesh.triangles);
  if (mesh.triangles.empty()) reject("has no triangle; at least one is needed");
  drop(mesh, flat_triangles(mesh));
  mesh.without_area = static_cast<std::uint32_t>(mesh.dropped.size());
  groups = groups_of(std::move(file.groups), mesh);
  if (mesh.triangles.empty())
    reject(fmt::format("has only triangles without area ({}); at least one with area is needed",
                       mesh.dropped.size()));
  join_positions(mesh);
  return mesh;
}

/// Names the file in what `make` refuses.
template <class Make>
auto named(const fs::path& file, Make make) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("mesh file \"{}\": does not fit into memory; give a smaller mesh", file.string()));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("mesh file \"{}\": {}", file.string(), one_line(error.what())));
  }
}

}  // namespace

SourceMesh load_mesh(const fs::path& file) {
  std::vector<MeshGroup> groups;
  return load_mesh(file, groups);
}

SourceMesh load_mesh(const fs::path& file, std::vector<MeshGroup>& groups) {
  groups.clear();
  return named(file, [&] { return mesh_of(read(file), groups); });
}

SourceMesh load_mesh(std::string_view bytes, const fs::path& file, std::vector<MeshGroup>& groups) {
  groups.clear();
  return named(file, [&] { return mesh_of(reader_by_name(file)(bytes, file), groups); });
}

}  // namespace hitpipe::ref
