// The file is checked before, during and after Assimp reads it. Assimp's copy is freed before equal positions
// are joined.
#include "sw_ref/scene/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/mat4x4.hpp>

#include "host/outputs.hpp"
#include "host/text.hpp"
#include "sw_ref/reject.hpp"
#include "sw_ref/scene/obj_material.hpp"
#include "sw_ref/scene/ply_check.hpp"
#include "sw_ref/scene/triangle_numbers.hpp"

namespace hitpipe::ref {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Assimp accepts a text STL that ends between two facets. For a binary file the facet count at byte 80 gives
/// the size, and Assimp checks that.
void check_stl(const std::filesystem::path& file, std::uintmax_t size) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 84> head{};
  in.read(head.data(), head.size());
  std::uint32_t facets = 0;
  std::memcpy(&facets, head.data() + 80, sizeof facets);
  const bool text = std::string_view(head.data(), 5) == "solid" && size != 84 + 50 * std::uintmax_t{facets};
  if (!text) return;
  constexpr std::uintmax_t longest_end = 4096;
  std::string end(static_cast<std::size_t>(std::min(size, longest_end)), '\0');
  in.clear();
  in.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  in.read(end.data(), static_cast<std::streamsize>(end.size()));
  if (end.find("endsolid") == std::string::npos)
    reject("is cut short; a text STL must end with \"endsolid\"");
}

/// Assimp allocates the bytes that a chunk of a GLB announces before it checks that the file has them.
void check_glb(const std::filesystem::path& file, std::uintmax_t size) {
  std::ifstream in(file, std::ios::binary);
  const auto word = [&] {
    std::array<char, 4> bytes{};  // little-endian
    in.read(bytes.data(), bytes.size());
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << 8U * i;
    return value;
  };
  constexpr std::uint32_t magic = 0x46546C67;  // "glTF"
  if (word() != magic) return;
  const bool only_one = word() < 2;  // a version 1 file has bare bytes behind its first chunk
  constexpr std::uintmax_t header = 12;
  constexpr std::uintmax_t chunk_header = 8;
  for (std::uintmax_t at = header; at + chunk_header <= size;) {
    in.seekg(static_cast<std::streamoff>(at));
    const std::uint32_t length = word();
    at += chunk_header;
    if (length > size - at)
      reject(fmt::format("is cut short; the chunk at byte {} announces {} bytes, {} are left",
                         at - chunk_header, length, size - at));
    if (only_one) break;
    at += length;
  }
}

void check_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) reject("no such file; give a .obj, .ply, .stl, .gltf or .glb file");
  if (!std::filesystem::is_regular_file(status))
    reject("is not a regular file; give a .obj, .ply, .stl, .gltf or .glb file");
  const std::string extension = lower_extension(file);
  if (extension != ".obj" && extension != ".ply" && extension != ".stl" && extension != ".gltf" &&
      extension != ".glb")
    reject(fmt::format("unknown extension \"{}\"; allowed are .obj, .ply, .stl, .gltf and .glb",
                       host::shortened(extension)));
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (size == 0 || error) reject("is empty; at least one triangle is needed");
  if (extension == ".ply") check_ply(file);
  if (extension == ".stl") check_stl(file, size);
  if (extension == ".glb") check_glb(file, size);
}

/// Checks that every index of a face names a vertex. Assimp does not guarantee this for any format.
void check_indices(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        if (face.mIndices[k] >= mesh.mNumVertices)
          reject(fmt::format("face {} refers to vertex {}; the mesh has {} vertices", f, face.mIndices[k],
                             mesh.mNumVertices));
      }
    }
  }
}

bool has_polygon(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes, [](const aiMesh* mesh) {
    return std::any_of(mesh->mFaces, mesh->mFaces + mesh->mNumFaces,
                       [](const aiFace& face) { return face.mNumIndices > 3; });
  });
}

glm::dmat4 to_glm(const aiMatrix4x4& m) {
  return {
      {m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

bool is_finite_point(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void append(Mesh& out, const aiMesh& mesh, const glm::dmat4& transform) {
  const std::size_t base = out.vertices.size();
  if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max())
    reject("has more than 4294967295 vertices, which is the most allowed");
  out.vertices.reserve(base + mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    if (!is_finite_point(glm::dvec3(p.x, p.y, p.z)))
      reject(fmt::format("a vertex lies at ({}, {}, {}); coordinates must be finite", p.x, p.y, p.z));
    const glm::dvec3 moved(transform * glm::dvec4(p.x, p.y, p.z, 1.0));
    // Adding +0 turns -0 into +0, so that equal positions have equal bits.
    const glm::vec3 position = glm::vec3(moved) + 0.0F;
    if (!is_finite_point(glm::dvec3(position)))
      reject(
          fmt::format("a node transform moves a vertex to ({}, {}, {}); coordinates must stay below 3.4e38",
                      moved.x, moved.y, moved.z));
    out.vertices.push_back(position);
  }
  const auto offset = static_cast<std::uint32_t>(base);
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    out.triangles.emplace_back(offset + face.mIndices[0], offset + face.mIndices[1],
                               offset + face.mIndices[2]);
  }
}

std::string material_name(const aiScene& scene, const aiMesh& mesh) {
  return mesh.mMaterialIndex < scene.mNumMaterials ? scene.mMaterials[mesh.mMaterialIndex]->GetName().C_Str()
                                                   : "";
}

/// Only OBJ files have materials that are read.
std::optional<Material> surface(const aiScene& scene, const aiMesh& mesh, bool is_obj) {
  if (!is_obj || mesh.mMaterialIndex >= scene.mNumMaterials) return std::nullopt;
  return obj_material(*scene.mMaterials[mesh.mMaterialIndex]);
}

/// Adds all meshes of the node tree, each moved by the product of the transforms above it.
Mesh flatten(const aiScene& scene, bool is_obj, std::vector<MeshGroup>& groups) {
  Mesh out;
  std::size_t faces = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) faces += scene.mMeshes[m]->mNumFaces;
  out.triangles.reserve(faces);
  std::vector<std::pair<const aiNode*, glm::dmat4>> pending{{scene.mRootNode, glm::dmat4(1.0)}};
  while (!pending.empty()) {
    const auto [node, above] = pending.back();
    pending.pop_back();
    const glm::dmat4 transform = above * to_glm(node->mTransformation);
    for (unsigned m = 0; m < node->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene.mMeshes[node->mMeshes[m]];
      const auto first = static_cast<std::uint32_t>(out.triangles.size());
      append(out, mesh, transform);
      groups.push_back({mesh.mName.C_Str(), material_name(scene, mesh), surface(scene, mesh, is_obj), first,
                        static_cast<std::uint32_t>(out.triangles.size()) - first});
    }
    for (unsigned c = node->mNumChildren; c-- > 0;) pending.emplace_back(node->mChildren[c], transform);
  }
  return out;
}

/// If the reader for the file's extension does not recognise the file, Assimp would try all its other
/// readers.
void keep_readers_of(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::istringstream extensions(importer.GetImporterInfo(i)->mFileExtensions);
    const std::istream_iterator<std::string> first(extensions);
    if (std::find(first, {}, extension) != std::istream_iterator<std::string>()) continue;
    const std::unique_ptr<Assimp::BaseImporter> reader(importer.GetImporter(i));
    importer.UnregisterLoader(reader.get());
  }
}

/// Assimp's files. It knows which were opened: a mesh may have others, with materials or vertices.
class OpenedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit OpenedFiles(std::vector<std::string>& names) : names_(&names) {}
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    names_->emplace_back(name);
    return Assimp::DefaultIOSystem::Open(name, mode);
  }

 private:
  std::vector<std::string>* names_;
};

Mesh import(const std::filesystem::path& file, std::vector<MeshGroup>& groups) {
  Assimp::Importer importer;
  std::vector<std::string> opened;
  importer.SetIOHandler(new OpenedFiles(opened));  // which the importer deletes
  keep_readers_of(importer, lower_extension(file).substr(1));
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  for (const std::string& name : opened) host::never_replace(name);
  if (!scene || !scene->mRootNode) {
    std::string why = importer.GetErrorString();
    if (why.starts_with("No suitable reader")) why = "it does not begin as one";
    reject(fmt::format("cannot be read, it must be a complete {} file ({})", lower_extension(file).substr(1),
                       why));
  }
  check_indices(*scene);
  if (has_polygon(*scene)) {
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (!scene) reject("has polygons that cannot be cut into triangles; give triangles");
  }
  return flatten(*scene, lower_extension(file) == ".obj", groups);
}

/// The groups without the triangles that were dropped.
void renumber(std::vector<MeshGroup>& groups, const std::vector<std::uint32_t>& dropped) {
  const auto kept_below = [&](std::uint32_t number) {
    const auto gone = std::lower_bound(dropped.begin(), dropped.end(), number) - dropped.begin();
    return number - static_cast<std::uint32_t>(gone);
  };
  for (MeshGroup& group : groups) {
    const std::uint32_t end = kept_below(group.first + group.count);
    group.first = kept_below(group.first);
    group.count = end - group.first;
  }
}

std::uint64_t hash(const glm::vec3& p) {
  constexpr std::uint64_t odd =
      0x9E3779B97F4A7C15U;  // 2^64 divided by the golden ratio, as in Fibonacci hashing
  std::uint64_t h = std::bit_cast<std::uint32_t>(p.x) * odd;
  h = (std::rotl(h, 27) ^ std::bit_cast<std::uint32_t>(p.y)) * odd;
  h = (std::rotl(h, 27) ^ std::bit_cast<std::uint32_t>(p.z)) * odd;
  return h ^ h >> 32U;
}

/// Keeps each position that a triangle uses once, in the order of first appearance.
void join_positions(Mesh& mesh) {
  constexpr std::uint32_t none = ~0U;
  constexpr std::uint32_t used = none - 1;
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), none);
  for (const glm::uvec3& t : mesh.triangles) renumbered[t.x] = renumbered[t.y] = renumbered[t.z] = used;
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
  for (glm::uvec3& t : mesh.triangles) t = {renumbered[t.x], renumbered[t.y], renumbered[t.z]};
}

/// Text that this reader or Assimp quotes from a broken file can contain line breaks and other control
/// characters.
std::string one_line_of_mesh_file(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
  return text;
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& file) {
  std::vector<MeshGroup> groups;
  return load_mesh(file, groups);
}

Mesh load_mesh(const std::filesystem::path& file, std::vector<MeshGroup>& groups) {
  groups.clear();
  try {
    check_file(file);
    Mesh mesh = import(file, groups);
    if (mesh.triangles.empty()) reject("has no triangle; at least one is needed");
    drop_degenerate(mesh);
    renumber(groups, mesh.dropped);
    if (mesh.triangles.empty())
      reject(fmt::format("has only triangles without area ({}); at least one with area is needed",
                         mesh.dropped.size()));
    join_positions(mesh);
    return mesh;
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("mesh file \"{}\": does not fit into memory; give a smaller mesh", file.string()));
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("mesh file \"{}\": {}", file.string(), one_line_of_mesh_file(error.what())));
  }
}

}  // namespace hitpipe::ref
