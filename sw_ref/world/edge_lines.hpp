// Lines through the corners and edges of a mesh of the integer world, where ties are: does each cross the mesh an
// even number of times?
//
// A line is two rays without an end from one origin, in opposite directions. They go through a corner or a lattice
// point of an edge: along an axis or a diagonal or with slopes of few bits, so that they meet it exactly; from it to
// another place of the same triangle or of another one, along edges and in planes; or from anywhere in the cube, so
// that slopes are rounded and the line just misses.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "rays/trace/mesh_crossings.hpp"

namespace hitpipe::ref {

struct EdgeLines {
  std::uint64_t lines = 0;  ///< each is two rays
  std::uint64_t crossings = 0;
  std::uint64_t ties = 0;         ///< CrossingCount::ties of all rays
  std::uint64_t tied_rays = 0;    ///< with at least one tie
  std::uint64_t from_inside = 0;  ///< lines of which both rays have an odd count
  std::uint64_t odd = 0;          ///< lines with an odd count; 0 if the mesh is even
  std::uint64_t unbalanced = 0;   ///< lines with a sum of sides that is not 0; 0 if the mesh is balanced
  std::optional<IntRay> first_odd{}, first_unbalanced{};

  EdgeLines& operator+=(const EdgeLines& later);
};

struct EdgeLineOptions {
  std::uint64_t lines = 1'000'000;  ///< at least 1
  std::uint64_t seed = 1;
  int threads = 0;  ///< as host::for_each_index(); no number depends on it
  std::function<void(double)> progress = [](double) {};
};

/// The rays of the lines, from `first` to before `end`, two of each line. The mesh has a triangle.
[[nodiscard]] std::vector<IntRay> edge_rays(const IntMesh& mesh, const hls::WorldBits& bits,
                                            std::uint64_t seed, std::uint64_t first, std::uint64_t end);

/// The mesh has a triangle. `crossings` is of this mesh and world.
[[nodiscard]] EdgeLines cross_edge_lines(const IntMesh& mesh, const MeshCrossings& crossings,
                                         const hls::WorldBits& bits, const EdgeLineOptions& options);

}  // namespace hitpipe::ref
