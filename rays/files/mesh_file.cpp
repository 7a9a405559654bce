#include "rays/files/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "rays/files/file_mesh.hpp"
#include "rays/files/gltf_reader.hpp"
#include "rays/files/obj_reader.hpp"
#include "rays/files/ply_reader.hpp"
#include "rays/files/stl_reader.hpp"
#include "rays/files/whole_mesh.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/scene/triangle_numbers.hpp"

namespace hitpipe::ref {

namespace {

namespace fs = std::filesystem;
using Read = FileMesh (*)(std::string_view bytes, const fs::path& file);

struct Format {
  std::string_view extension;
  Read read;
  FileInstances (*instances)(std::string_view bytes, const fs::path& file) = nullptr;
};
constexpr std::array formats{
    Format{".obj", read_obj},
    Format{".ply", [](std::string_view bytes, const fs::path&) { return read_ply(bytes); }},
    Format{".stl", [](std::string_view bytes, const fs::path&) { return read_stl(bytes); }},
    Format{".gltf", read_gltf, read_gltf_instances},
    Format{".glb", read_gltf, read_gltf_instances},
};

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Null if no format has the extension.
const Format* find_format(const fs::path& file) {
  const std::string extension = lower_extension(file);
  const auto* const found = std::find_if(formats.begin(), formats.end(),
                                         [&](const Format& each) { return each.extension == extension; });
  return found == formats.end() ? nullptr : found;
}

const Format& format_by_name(const fs::path& file) {
  const Format* const found = find_format(file);
  if (found == nullptr)
    reject(fmt::format("unknown extension \"{}\"; allowed are .obj, .ply, .stl, .gltf and .glb",
                       host::shortened(lower_extension(file))));
  return *found;
}

/// Refuses what is no file of a known format.
std::string bytes_of(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) reject("no such file; give a .obj, .ply, .stl, .gltf or .glb file");
  if (!fs::is_regular_file(status))
    reject("is not a regular file; give a .obj, .ply, .stl, .gltf or .glb file");
  static_cast<void>(format_by_name(file));
  if (fs::file_size(file, error) == 0 || error) reject("is empty; at least one triangle is needed");
  host::never_replace(file);
  std::optional<std::string> bytes = host::contents_of(file);
  if (!bytes) reject("cannot be read");
  return *std::move(bytes);
}

FileMesh read(const fs::path& file) {
  const std::string bytes = bytes_of(file);
  return format_by_name(file).read(bytes, file);
}

FileInstances instances_in(std::string_view bytes, const fs::path& file) {
  const Format& format = format_by_name(file);
  if (format.instances != nullptr) return format.instances(bytes, file);
  FileInstances one;
  one.meshes.push_back(format.read(bytes, file));
  one.instances.emplace_back();
  return one;
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
  std::vector<FileMesh::Group> runs = std::exchange(file.groups, {});
  if (runs.empty()) runs.push_back({});
  SourceMesh mesh = whole_mesh(std::move(file));
  if (mesh.triangles.empty()) reject("has no triangle; at least one is needed");
  drop(mesh, flat_triangles(mesh));
  mesh.without_area = static_cast<std::uint32_t>(mesh.dropped.size());
  groups = groups_of(std::move(runs), mesh);
  if (mesh.triangles.empty())
    reject(fmt::format("has only triangles without area ({}); at least one with area is needed",
                       mesh.dropped.size()));
  join_positions(mesh);
  return mesh;
}

/// Nothing of the instance is farther away than the box of its mesh.
void check_place(const OwnInstance& instance, const Bounds& box, std::size_t number) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dvec3 own;
    for (int axis = 0; axis < 3; ++axis) own[axis] = ((corner >> axis & 1U) != 0 ? box.max : box.min)[axis];
    const glm::dvec3 p = instance.linear * own + instance.move;
    if (!fits_binary32(p))
      reject(
          fmt::format("instance {} has a corner of its mesh's box at ({}, {}, {}); coordinates must be "
                      "finite and below 3.4e38",
                      number, p.x, p.y, p.z));
  }
}

OwnInstances instances_of(FileInstances file) {
  OwnInstances made;
  std::vector<Bounds> boxes;
  std::size_t triangles = 0;
  bool is_seen = false;
  for (FileMesh& each : file.meshes) {
    SourceMesh mesh = whole_mesh(std::exchange(each, {}));
    if (mesh.triangles.empty()) reject("has no triangle; at least one is needed");
    const auto whole = static_cast<std::uint32_t>(mesh.triangles.size());
    for (std::uint32_t i = 0; !is_seen && i < whole; ++i) is_seen = has_area(mesh.corners(i));
    triangles += whole;
    boxes.push_back(mesh_bounds(mesh));
    join_positions(mesh);
    made.meshes.push_back(std::move(mesh));
  }
  if (file.meshes.empty()) reject("has no triangle; at least one is needed");
  if (!is_seen)
    reject(fmt::format("has only triangles without area ({}); at least one with area is needed", triangles));
  for (std::size_t i = 0; i < file.instances.size(); ++i)
    check_place(file.instances[i], boxes[file.instances[i].mesh], i);
  made.instances = std::move(file.instances);
  return made;
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
  return named(file, [&] { return mesh_of(format_by_name(file).read(bytes, file), groups); });
}

OwnInstances load_instances(const fs::path& file) {
  return named(file, [&] {
    FileInstances in_file = instances_in(bytes_of(file), file);
    return instances_of(std::move(in_file));
  });
}

OwnInstances load_instances(std::string_view bytes, const fs::path& file) {
  return named(file, [&] { return instances_of(instances_in(bytes, file)); });
}

bool may_have_instances(const fs::path& file) {
  const Format* const format = find_format(file);
  return format != nullptr && format->instances != nullptr;
}

}  // namespace hitpipe::ref
