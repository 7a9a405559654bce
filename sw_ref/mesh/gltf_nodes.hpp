// The nodes of a glTF file: a forest of transforms.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "sw_ref/mesh/gltf_document.hpp"

namespace hitpipe::ref {

class GltfNodes {
 public:
  /// Refuses a node with two parents, a cycle, and a scene whose node has a parent.
  explicit GltfNodes(const GltfDocument& document);

  /// Calls for each node of the scene with the product of the transforms of the node and those above it: a
  /// node before its children, the children in their order. It is the scene that the file shows first: the
  /// one that it names, else its first, or all nodes without parent if it has no scene.
  void visit(const std::function<void(const Place& node, std::size_t number, const glm::dmat4&)>& call) const;

 private:
  void read_parents();
  void check_cycles() const;
  void read_roots();

  const GltfDocument& document_;
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> roots_;
};

}  // namespace hitpipe::ref
