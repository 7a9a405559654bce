// The numbers of triangles in the source of a mesh, and in the mesh, which lacks some of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// The triangles of the mesh that have no area, ascending.
[[nodiscard]] std::vector<std::uint32_t> flat_triangles(const SourceMesh& mesh);
[[nodiscard]] std::vector<std::uint32_t> flat_triangles(const Mesh& mesh);

/// Takes triangles out of the mesh, ascending ones, and adds them to MeshOf::dropped.
void drop(SourceMesh& mesh, std::span<const std::uint32_t> triangles);
void drop(Mesh& mesh, std::span<const std::uint32_t> triangles);

/// The mesh must outlive it and not change.
class TriangleNumbers {
 public:
  static constexpr std::uint32_t none = ~0U;

  template <class Vertex>
  explicit TriangleNumbers(const MeshOf<Vertex>& mesh)
      : dropped_(&mesh.dropped),
        faces_(&mesh.faces),
        in_source_(mesh.triangles.size() + mesh.dropped.size()) {}

  /// How many triangles the source has.
  [[nodiscard]] std::size_t in_source() const { return in_source_; }
  /// How many triangles of the mesh have smaller numbers.
  [[nodiscard]] std::uint32_t kept_below(std::uint32_t number) const {
    return number - dropped_below(number);
  }
  /// The triangle of the mesh that has the number; `none` if the mesh lacks it or the source has no such number.
  [[nodiscard]] std::uint32_t in_mesh(std::uint32_t number) const {
    const std::uint32_t below = dropped_below(number);
    const bool dropped = below < dropped_->size() && (*dropped_)[below] == number;
    return dropped || number >= in_source_ ? none : number - below;
  }
  /// The number of a triangle of the mesh.
  [[nodiscard]] std::uint32_t of_source(std::uint32_t triangle) const;
  /// The number of the first triangle of a face of the file; in_source() behind the last face that has one.
  [[nodiscard]] std::uint32_t first_of(std::size_t face) const;
  /// The face of the file, from 0, that the triangle with this number is part of.
  [[nodiscard]] std::uint32_t face_of(std::uint32_t number) const;

 private:
  [[nodiscard]] std::uint32_t dropped_below(std::uint32_t number) const {
    return static_cast<std::uint32_t>(std::lower_bound(dropped_->begin(), dropped_->end(), number) -
                                      dropped_->begin());
  }

  const std::vector<std::uint32_t>* dropped_;
  const std::vector<std::uint32_t>* faces_;
  std::size_t in_source_;
};

}  // namespace hitpipe::ref
