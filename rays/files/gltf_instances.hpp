// The instances of a glTF node: EXT_mesh_gpu_instancing.
#pragma once

#include <cstdint>

#include "rays/files/gltf_accessor.hpp"
#include "rays/files/gltf_document.hpp"
#include "rays/files/gltf_nodes.hpp"

namespace hitpipe::ref {

class GltfInstances {
 public:
  /// The one instance that a node without the extension has, which is where the node is.
  GltfInstances() = default;
  /// Of a node with a mesh.
  GltfInstances(const GltfDocument& document, GltfAccessors& accessors, const Place& node);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The place of instance i of a node that is there: the instance moves the mesh first.
  [[nodiscard]] GltfTransform placed(const GltfTransform& node, std::uint64_t i) const;

 private:
  void check_counts(const GltfDocument& document, const Place& attributes);

  std::uint64_t count_ = 1;
  bool is_node_ = true;
  const GltfAccessor* translations_ = nullptr;
  const GltfAccessor* rotations_ = nullptr;
  const GltfAccessor* scales_ = nullptr;
};

}  // namespace hitpipe::ref
