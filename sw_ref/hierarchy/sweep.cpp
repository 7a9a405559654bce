#include "sw_ref/hierarchy/sweep.hpp"

#include <chrono>

namespace hitpipe::ref {

void sweep_max_triangles(const Mesh& mesh, BuildOptions options,
                         const std::function<void(const SweepStep&)>& visit) {
  for (const int size : appendix_b_sizes) {
    options.max_triangles = size;
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh = build_bvh(mesh, options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    visit({size, seconds.count(), bvh});
  }
}

}  // namespace hitpipe::ref
