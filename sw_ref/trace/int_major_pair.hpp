// The test of two boxes at a time (docs/never_misses.md) in 64-bit words, for any format chosen at run time. It
// gives the same results as the datapath of hls/pipelines/int_major_pair.hpp.
#pragma once

#include <cstddef>
#include <memory>

#include "rays/trace/int_major.hpp"
#include "rays/trace/walk.hpp"
#include "rays/world/pair_nodes.hpp"

namespace hitpipe::ref {

/// `parent` is where the ray is within the parent, cut at the ray's end; it is not empty.
[[nodiscard]] inline PairAnswer test_pair(const MajorDistances& ray, const PairBoxes& boxes,
                                          const RayInterval& parent) {
  PairAnswer answer;
  answer.interval = {parent, parent};
  for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
    const RayInterval t = ray.slab(ray_axis, boxes.planes);
    const std::size_t axis = ray.axis(ray_axis);
    const std::size_t low = boxes.owners >> axis & 1U;
    const std::size_t high = boxes.owners >> (axis + 3) & 1U;
    RayInterval& entered = answer.interval[ray.backward(ray_axis) ? high : low];
    RayInterval& left = answer.interval[ray.backward(ray_axis) ? low : high];
    entered.near = std::max(entered.near, t.near);
    left.far = std::min(left.far, t.far);
  }
  for (std::size_t box = 0; box < 2; ++box)
    answer.hit[box] = answer.interval[box].near <= answer.interval[box].far;
  answer.second_first = answer.interval[1].near < answer.interval[0].near;
  return answer;
}

/// A tracer that tests two boxes at a time.
[[nodiscard]] std::unique_ptr<Tracer> major_pair_tracer(hls::MajorBits bits, const Mesh& mesh,
                                                        const Bvh& bvh);

}  // namespace hitpipe::ref
