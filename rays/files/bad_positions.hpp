// Positions of a mesh file that are none, such as nan. They do no harm where no face uses them.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "rays/files/file_mesh.hpp"

namespace hitpipe::ref {

class BadPositions {
 public:
  /// `place` is where the file has it.
  void add(std::size_t vertex, std::size_t place) { all_.emplace_back(vertex, place); }

  /// Calls with the first vertex that a face uses, and its place. All corners must be known.
  template <class Refuse>
  void refuse_used(const FileMesh& mesh, Refuse refuse) const {
    if (all_.empty()) return;
    std::vector<bool> used(mesh.positions.size(), false);
    for (const std::uint32_t corner : mesh.corners) used[corner] = true;
    for (const auto& [vertex, place] : all_)
      if (used[vertex]) refuse(vertex, place);
  }

 private:
  std::vector<std::pair<std::size_t, std::size_t>> all_;
};

}  // namespace hitpipe::ref
