#include "rays/files/gltf_reader.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/files/gltf_accessor.hpp"
#include "rays/files/gltf_document.hpp"
#include "rays/files/gltf_nodes.hpp"
#include "rays/files/gltf_primitive.hpp"
#include "rays/files/gltf_skin.hpp"

namespace hitpipe::ref {
namespace {

std::string gltf_name(const Place& place) {
  return place.has("name") ? place.at("name").word() : "";
}

class GltfScene {
 public:
  GltfScene(std::string_view bytes, const std::filesystem::path& file)
      : document_(bytes, file),
        accessors_(document_),
        nodes_(document_),
        skins_(document_, nodes_),
        checked_(document_.size("meshes"), false) {}

  FileMesh read() {
    nodes_.visit([&](const Place& node, std::size_t, const GltfTransform&) { measure(node); });
    mesh_.positions.reserve(positions_);
    mesh_.corners.reserve(corners_);
    nodes_.visit([&](const Place& node, std::size_t, const GltfTransform& own) { add(node, own); });
    return std::move(mesh_);
  }

 private:
  static void check_extensions(const Place& node) {
    if (!node.has("extensions")) return;
    const Place extensions = node.at("extensions");
    if (extensions.has("EXT_mesh_gpu_instancing"))
      extensions.fail("EXT_mesh_gpu_instancing is not read; give a node for each instance");
    if (!extensions.has("KHR_node_visibility")) return;
    const Place visibility = extensions.at("KHR_node_visibility");
    if (visibility.has("visible") && !visibility.at("visible").truth())
      visibility.fail("hidden nodes are not read; give a file without them");
  }

  static std::vector<double> weights(const Place& node, const Place& mesh) {
    const Place& owner = node.has("weights") ? node : mesh;
    if (!owner.has("weights")) return {};
    const Place place = owner.at("weights");
    return place.numbers(place.size());
  }

  /// Calls for each primitive of the node's mesh that has triangles.
  template <class Call>
  void primitives(const Place& node, Call call) {
    if (!node.has("mesh")) return;
    const std::uint64_t number = document_.index("meshes", node.at("mesh"));
    const Place mesh = document_.item("meshes", number);
    const Place list = mesh.at("primitives");
    const std::vector<double> morph = weights(node, mesh);
    const std::size_t size = list.size();
    for (std::size_t p = 0; p < size; ++p) {
      const Place place = list.element(p);
      if (!checked_[number]) check_gltf_attributes(document_, place);
      call(mesh, place, GltfPrimitive(document_, accessors_, place, morph, node.has("skin")), morph.size());
    }
    checked_[number] = true;
  }

  void measure(const Place& node) {
    check_extensions(node);
    if (node.has("mesh") && node.has("skin"))
      bytes_ += sizeof(GltfTransform) * skins_.joints(node.at("skin"));
    primitives(
        node, [&](const Place& mesh, const Place& place, const GltfPrimitive& primitive, std::size_t morphs) {
          positions_ += primitive.positions();
          corners_ += primitive.corners();
          bytes_ += sizeof(FileMesh::Group) + gltf_name(mesh).size() + material_name(place).size() +
                    sizeof(double) * morphs + sizeof(glm::dvec3) * primitive.positions() * primitive.terms() +
                    sizeof(std::uint32_t) * primitive.corners();
          check_size(node);
        });
  }

  /// Instances can ask for more than any computer has. The bytes stand for time, too.
  void check_size(const Place& node) const {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (positions_ > most || corners_ > most)
      node.fail("with its mesh the scene has more than 4294967295 corners, which is the most allowed");
    constexpr std::uint64_t base = std::uint64_t{32} << 20U;
    constexpr std::uint64_t factor = 24;
    const std::uint64_t allowed = base + factor * document_.bytes();
    if (bytes_ > allowed)
      node.fail(
          fmt::format("with its mesh the scene needs {} bytes; allowed are {}, which is 32 MiB and 24 times "
                      "the bytes of the file",
                      bytes_, allowed));
  }

  [[nodiscard]] std::string material_name(const Place& primitive) const {
    return primitive.has("material") ? gltf_name(document_.item("materials", primitive.at("material"))) : "";
  }

  void add(const Place& node, const GltfTransform& transform) {
    std::vector<GltfTransform> skin;
    if (node.has("mesh") && node.has("skin")) skin = skins_.matrices(accessors_, node.at("skin"));
    primitives(node, [&](const Place& mesh, const Place& place, const GltfPrimitive& primitive, std::size_t) {
      if (primitive.corners() == 0) return;
      mesh_.groups.push_back({gltf_name(mesh), material_name(place), {}, mesh_.faces()});
      primitive.add_to(mesh_, transform, skin);
    });
  }

  GltfDocument document_;
  GltfAccessors accessors_;
  GltfNodes nodes_;
  GltfSkins skins_;
  std::vector<bool> checked_;  ///< of each mesh: its attributes
  FileMesh mesh_;
  std::uint64_t positions_ = 0;
  std::uint64_t corners_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

FileMesh read_gltf(std::string_view bytes, const std::filesystem::path& file) {
  return GltfScene(bytes, file).read();
}

}  // namespace hitpipe::ref
