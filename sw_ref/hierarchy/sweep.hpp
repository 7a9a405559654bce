// Appendix B: hierarchies of one mesh with larger and larger leaves. The caller decides what to measure on
// each.
#pragma once

#include <array>
#include <functional>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/scene/mesh.hpp"

namespace hitpipe::ref {

/// Most triangles per leaf, as the rows of Tables B.1 to B.8.
constexpr std::array<int, 23> appendix_b_sizes{1,  2,  3,  4,  5,  6,  7,  8,  9,   10,  11, 12,
                                               13, 14, 15, 16, 20, 24, 32, 64, 128, 256, 512};

struct SweepStep {
  int max_triangles;
  double build_seconds;
  const Bvh& bvh;  ///< valid until the visit ends
};

/// Builds a hierarchy for each size, in order, with the other `options`, and calls `visit` with it. Only one
/// hierarchy exists at a time. Throws as build_bvh does.
void sweep_max_triangles(const Mesh& mesh, BuildOptions options,
                         const std::function<void(const SweepStep&)>& visit);

}  // namespace hitpipe::ref
