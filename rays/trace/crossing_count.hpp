// How often a ray crosses a mesh.
#pragma once

#include <cstdint>

namespace hitpipe::ref {

struct CrossingCount {
  std::uint64_t crossings = 0;
  /// The sum of their sides: 0 through an oriented closed mesh, if the ray begins and ends outside.
  std::int64_t sides = 0;
  std::uint64_t ties = 0;  ///< hits at an edge or a corner, which counted or did not

  /// Of a closed mesh, and a ray without an end: its origin is inside. An origin on the mesh is on either side.
  [[nodiscard]] bool inside() const { return crossings % 2 != 0; }
  friend bool operator==(const CrossingCount&, const CrossingCount&) = default;
};

}  // namespace hitpipe::ref
