// The nodes of a glTF file: a forest of transforms.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "rays/files/gltf_document.hpp"

namespace hitpipe::ref {

/// A matrix, and which way it turns a surface: 1 keeps the sides, -1 mirrors, 0 makes it flat. The product of
/// the signs of all factors has no rounding, as the determinant of their product has.
struct GltfTransform {
  glm::dmat4 matrix{1.0};
  int sign = 1;

  [[nodiscard]] GltfTransform operator*(const GltfTransform& right) const {
    return {matrix * right.matrix, sign * right.sign};
  }
};

/// The sign of the determinant of its linear part; 0 if that is no more than a rounding.
[[nodiscard]] GltfTransform gltf_signed(const glm::dmat4& matrix);

/// What places a node, or an instance of it; each part may be missing.
struct GltfParts {
  std::optional<glm::dvec3> translation;
  std::optional<std::array<double, 4>> rotation;  ///< x, y, z, w of a quaternion, of any length but 0
  std::optional<glm::dvec3> scale;
};
/// First scaled, then rotated, then moved.
[[nodiscard]] GltfTransform gltf_transform(const GltfParts& parts);
[[nodiscard]] double gltf_length(const std::array<double, 4>& quaternion);

class GltfNodes {
 public:
  /// Refuses a node with two parents, a cycle, and a scene whose node has a parent.
  explicit GltfNodes(const GltfDocument& document);

  /// Calls for each node of the scene with the product of the transforms of the node and those above it: a
  /// node before its children, the children in their order. It is the scene that the file shows first: the
  /// one that it names, else its first, or all nodes without parent if it has no scene.
  void visit(
      const std::function<void(const Place& node, std::size_t number, const GltfTransform&)>& call) const;

 private:
  void read_parents();
  void check_cycles() const;
  void read_roots();

  const GltfDocument& document_;
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> roots_;
};

}  // namespace hitpipe::ref
