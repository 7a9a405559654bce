#include "rays/files/gltf_reader.hpp"

#include <compare>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/files/gltf_accessor.hpp"
#include "rays/files/gltf_document.hpp"
#include "rays/files/gltf_instances.hpp"
#include "rays/files/gltf_nodes.hpp"
#include "rays/files/gltf_primitive.hpp"
#include "rays/files/gltf_skin.hpp"

namespace hitpipe::ref {
namespace {

std::string gltf_name(const Place& place) {
  return place.has("name") ? place.at("name").word() : "";
}

/// a * b, or so much that nobody has it. Sums of a few of these fit.
std::uint64_t gltf_times(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t very_much = std::uint64_t{1} << 60U;
  return b != 0 && a > very_much / b ? very_much : a * b;
}

class GltfScene {
 public:
  GltfScene(std::string_view bytes, const std::filesystem::path& file)
      : document_(bytes, file),
        accessors_(document_),
        nodes_(document_),
        skins_(document_, nodes_),
        checked_(document_.size("meshes"), false) {}

  FileMesh flattened() {
    nodes_.visit([&](const Place& node, std::size_t, const GltfTransform&) {
      check_visible(node);
      if (node.has("mesh")) measure(node, GltfInstances(document_, accessors_, node).count());
    });
    FileMesh all;
    all.positions.reserve(positions_);
    all.corners.reserve(corners_);
    nodes_.visit([&](const Place& node, std::size_t, const GltfTransform& own) {
      if (node.has("mesh")) add(all, node, GltfInstances(document_, accessors_, node), own);
    });
    return all;
  }

  FileInstances instanced() {
    FileInstances made;
    std::map<Shape, std::optional<std::uint32_t>> numbers;
    nodes_.visit([&](const Place& node, std::size_t, const GltfTransform& own) {
      check_visible(node);
      if (!node.has("mesh")) return;
      const GltfInstances instances(document_, accessors_, node);
      if (instances.count() == 0) return measure(node, 0);
      const auto [shape, is_new] = numbers.try_emplace(shape_of(node));
      if (is_new) {
        measure(node, 1);
        FileMesh mesh;
        add(mesh, node, {}, {});
        if (mesh.faces() != 0) {
          shape->second = static_cast<std::uint32_t>(made.meshes.size());
          mesh.groups.clear();
          made.meshes.push_back(std::move(mesh));
        }
      }
      bytes_ += gltf_times(instances.count(), sizeof(OwnInstance));
      check_size(node);
      for (std::uint64_t i = 0; shape->second && i < instances.count(); ++i) {
        const GltfTransform placed = node.has("skin") ? GltfTransform{} : instances.placed(own, i);
        made.instances.push_back({.mesh = *shape->second,
                                  .linear = glm::dmat3(placed.matrix),
                                  .move = glm::dvec3(placed.matrix[3])});
      }
    });
    return made;
  }

 private:
  /// What makes the triangles of a node, but for its transform.
  struct Shape {
    std::uint64_t mesh = 0;
    std::optional<std::uint64_t> skin{};
    std::vector<double> weights{};

    auto operator<=>(const Shape&) const = default;
  };

  static void check_visible(const Place& node) {
    if (!node.has("extensions") || !node.at("extensions").has("KHR_node_visibility")) return;
    const Place visibility = node.at("extensions").at("KHR_node_visibility");
    if (visibility.has("visible") && !visibility.at("visible").truth())
      visibility.fail("hidden nodes are not read; give a file without them");
  }

  static std::vector<double> weights(const Place& node, const Place& mesh) {
    const Place& owner = node.has("weights") ? node : mesh;
    if (!owner.has("weights")) return {};
    const Place place = owner.at("weights");
    return place.numbers(place.size());
  }

  [[nodiscard]] Shape shape_of(const Place& node) const {
    Shape shape{.mesh = document_.index("meshes", node.at("mesh"))};
    if (node.has("skin")) shape.skin = document_.index("skins", node.at("skin"));
    shape.weights = weights(node, document_.item("meshes", shape.mesh));
    return shape;
  }

  /// Calls for each primitive of the node's mesh.
  template <class Call>
  void primitives(const Place& node, Call call) {
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

  /// Counts what the node's mesh takes, so many times.
  void measure(const Place& node, std::uint64_t times) {
    if (node.has("skin")) bytes_ += sizeof(GltfTransform) * skins_.joints(node.at("skin"));
    primitives(
        node, [&](const Place& mesh, const Place& place, const GltfPrimitive& primitive, std::size_t morphs) {
          positions_ += gltf_times(primitive.positions(), times);
          corners_ += gltf_times(primitive.corners(), times);
          bytes_ += gltf_times(sizeof(FileMesh::Group) + gltf_name(mesh).size() +
                                   material_name(place).size() + sizeof(double) * morphs +
                                   sizeof(glm::dvec3) * primitive.positions() * primitive.terms() +
                                   sizeof(std::uint32_t) * primitive.corners(),
                               times);
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

  /// Adds the triangles of all instances, one behind the other.
  void add(FileMesh& all, const Place& node, const GltfInstances& instances, const GltfTransform& own) {
    std::vector<GltfTransform> skin;
    if (node.has("skin")) skin = skins_.matrices(accessors_, node.at("skin"));
    std::vector<std::pair<FileMesh::Group, GltfPrimitive>> parts;
    primitives(node, [&](const Place& mesh, const Place& place, const GltfPrimitive& primitive, std::size_t) {
      if (primitive.corners() != 0)
        parts.emplace_back(FileMesh::Group{gltf_name(mesh), material_name(place)}, primitive);
    });
    for (std::uint64_t i = 0; !parts.empty() && i < instances.count(); ++i) {
      const GltfTransform placed = instances.placed(own, i);
      for (const auto& [group, primitive] : parts) {
        all.groups.push_back(group);
        all.groups.back().first_face = all.faces();
        primitive.add_to(all, placed, skin);
      }
    }
  }

  GltfDocument document_;
  GltfAccessors accessors_;
  GltfNodes nodes_;
  GltfSkins skins_;
  std::vector<bool> checked_;  ///< of each mesh: its attributes
  std::uint64_t positions_ = 0;
  std::uint64_t corners_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace

FileMesh read_gltf(std::string_view bytes, const std::filesystem::path& file) {
  return GltfScene(bytes, file).flattened();
}

FileInstances read_gltf_instances(std::string_view bytes, const std::filesystem::path& file) {
  return GltfScene(bytes, file).instanced();
}

}  // namespace hitpipe::ref
