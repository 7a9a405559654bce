#include "rays/files/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/gltf_reader.hpp"
#include "rays/files/join_positions.hpp"
#include "rays/files/obj_reader.hpp"
#include "rays/files/ply_reader.hpp"
#include "rays/files/stl_reader.hpp"
#include "rays/files/triangles.hpp"
#include "rays/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

namespace {

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

FileMesh read_mesh_file(const fs::path& file) {
  return named(file, [&] { return read(file); });
}

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
