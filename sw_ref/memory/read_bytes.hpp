// The bytes that memory gives for the rays of a picture, in the order in which one thread traces them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sw_ref/memory/scene_memory.hpp"
#include "sw_ref/render/recording.hpp"

namespace hitpipe::ref {

struct ReadBytes {
  std::uint64_t rays = 0;
  std::uint64_t without_cache = 0;
  std::vector<std::uint64_t> behind;  ///< each cache, in whole lines
};

/// The tracer is of this mesh and hierarchy, and tells its loads.
[[nodiscard]] ReadBytes read_bytes(const Tracer& tracer, const Mesh& mesh, const Bvh& bvh,
                                   std::span<const RecordedBatch> batches, TriangleLayout layout,
                                   std::span<const CacheShape> caches);

}  // namespace hitpipe::ref
