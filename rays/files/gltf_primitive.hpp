// A primitive of a glTF mesh: its triangles and positions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rays/files/file_mesh.hpp"
#include "rays/files/gltf_accessor.hpp"
#include "rays/files/gltf_document.hpp"
#include "rays/files/gltf_nodes.hpp"

namespace hitpipe::ref {

/// Checks all attributes, also those that are not read: each has a number for every position.
void check_gltf_attributes(const GltfDocument& document, const Place& primitive);

class GltfPrimitive {
 public:
  /// `weights` are of its morph targets.
  GltfPrimitive(const GltfDocument& document, GltfAccessors& accessors, const Place& primitive,
                std::span<const double> weights, bool skinned);

  /// 0 for points, lines and primitives without positions.
  [[nodiscard]] std::uint64_t corners() const { return corners_; }
  /// At most as many as corners.
  [[nodiscard]] std::uint64_t positions() const;
  /// How many numbers are added to make a position.
  [[nodiscard]] std::uint64_t terms() const { return 1 + targets_.size() + joints_.size(); }

  /// Adds the triangles. A skin, if there is one, moves the positions, else the transform. A position that no
  /// triangle uses is not read.
  void add_to(FileMesh& mesh, const GltfTransform& transform, std::span<const GltfTransform> skin) const;

 private:
  void read_targets(const GltfDocument& document, GltfAccessors& accessors, std::span<const double> weights);
  void read_joints(GltfAccessors& accessors);
  [[nodiscard]] std::uint64_t corner(std::uint64_t c) const;
  [[nodiscard]] glm::dvec3 position(std::uint64_t i, const GltfTransform& transform) const;
  [[nodiscard]] GltfTransform skin_transform(std::uint64_t i, std::span<const GltfTransform> skin) const;

  Place place_;
  std::uint64_t mode_;
  std::uint64_t corners_ = 0;
  const GltfAccessor* positions_ = nullptr;
  const GltfAccessor* indices_ = nullptr;
  std::vector<std::pair<double, const GltfAccessor*>> targets_;  ///< whose weight is not 0
  std::vector<std::array<const GltfAccessor*, 2>> joints_;       ///< with their weights
};

}  // namespace hitpipe::ref
