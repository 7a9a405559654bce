#include "sw_ref/memory/read_bytes.hpp"

namespace hitpipe::ref {

ReadBytes read_bytes(const Tracer& tracer, const Mesh& mesh, const Bvh& bvh,
                     std::span<const RecordedBatch> batches, TriangleLayout layout,
                     std::span<const CacheShape> caches) {
  SceneMemory memory(mesh, bvh, tracer, layout, caches);
  TraceCounts counts;
  std::vector<std::uint32_t> triangles;
  for (const RecordedBatch& batch : batches) {
    triangles.resize(batch.rays.size());
    tracer.trace({.rays = batch.rays, .query = batch.query, .triangles = triangles, .loads = &memory},
                 counts);
  }
  ReadBytes read{.rays = counts.rays, .without_cache = memory.reads().bytes_read(), .behind = {}};
  for (std::size_t i = 0; i < caches.size(); ++i) read.behind.push_back(memory.reads().bytes_fetched(i));
  return read;
}

}  // namespace hitpipe::ref
