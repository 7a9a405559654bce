// The numbers of triangles in the source of a mesh, and in the mesh, which lacks those without area.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sw_ref/scene/mesh.hpp"

namespace hitpipe::ref {

/// Takes the triangles without area out of the mesh and adds their numbers to Mesh::dropped.
void drop_degenerate(Mesh& mesh);

/// The mesh must outlive it and not change.
class TriangleNumbers {
 public:
  static constexpr std::uint32_t none = ~0U;

  explicit TriangleNumbers(const Mesh& mesh) : mesh_(&mesh) {}

  /// How many triangles the source has.
  [[nodiscard]] std::size_t in_source() const { return mesh_->triangles.size() + mesh_->dropped.size(); }
  /// The number in the mesh of triangle `source` < in_source(); `none` if it was dropped.
  [[nodiscard]] std::uint32_t in_mesh(std::uint32_t source) const {
    const auto at = std::lower_bound(mesh_->dropped.begin(), mesh_->dropped.end(), source);
    if (at != mesh_->dropped.end() && *at == source) return none;
    return source - static_cast<std::uint32_t>(at - mesh_->dropped.begin());
  }
  /// The number in the source of a triangle of the mesh.
  [[nodiscard]] std::uint32_t of_source(std::uint32_t triangle) const;

 private:
  const Mesh* mesh_;
};

}  // namespace hitpipe::ref
