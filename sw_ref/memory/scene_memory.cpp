#include "sw_ref/memory/scene_memory.hpp"

#include <array>

namespace hitpipe::ref {

namespace {

constexpr std::uint64_t entry_bytes = sizeof(std::uint32_t);
constexpr std::uint64_t numbers_bytes = sizeof(glm::uvec3);

}  // namespace

ReadCounter::ReadCounter(std::span<const CacheShape> caches) {
  for (const CacheShape& shape : caches) caches_.push_back({LineCache(shape), shape.line_bytes});
}

std::uint64_t ReadCounter::add_array(std::uint64_t bytes) {
  const std::uint64_t address = end_;
  end_ += (bytes + alignment - 1) / alignment * alignment;
  return address;
}

void ReadCounter::read(std::uint64_t address, std::uint64_t bytes) {
  bytes_read_ += bytes;
  for (Cache& cache : caches_) {
    const std::uint64_t last = (address + bytes - 1) / cache.line_bytes;
    for (std::uint64_t at = address / cache.line_bytes; at <= last; ++at) {
      const auto line = static_cast<std::uint32_t>(at);
      if (cache.lines.use(line)) continue;
      ++cache.fetched;
      cache.lines.place(line);
    }
  }
}

SceneMemory::SceneMemory(const Mesh& mesh, const Bvh& bvh, std::size_t nodes, std::size_t bytes_per_node,
                         TriangleLayout layout, std::span<const CacheShape> caches)
    : mesh_(&mesh),
      layout_(layout),
      entry_of_(mesh.triangles.size()),
      bytes_per_node_(bytes_per_node),
      reads_(caches),
      nodes_(reads_.add_array(nodes * bytes_per_node)) {
  for (std::uint32_t i = 0; i < bvh.order.size(); ++i) entry_of_[bvh.order[i]] = i;
  if (layout == TriangleLayout::corners) {
    entries_ = reads_.add_array(bvh.order.size() * bytes_of_corners);
    return;
  }
  entries_ = reads_.add_array(bvh.order.size() * entry_bytes);
  triangles_ = reads_.add_array(mesh.triangles.size() * numbers_bytes);
  vertices_ = reads_.add_array(mesh.vertices.size() * corner_bytes);
}

void SceneMemory::triangle_loaded(std::uint32_t triangle) {
  const std::uint64_t entry = entry_of_[triangle];
  if (layout_ == TriangleLayout::corners)
    return reads_.read(entries_ + entry * bytes_of_corners, bytes_of_corners);
  reads_.read(entries_ + entry * entry_bytes, entry_bytes);
  reads_.read(triangles_ + triangle * numbers_bytes, numbers_bytes);
  const glm::uvec3& corners = mesh_->triangles[triangle];
  for (int i = 0; i < 3; ++i) reads_.read(vertices_ + corners[i] * corner_bytes, corner_bytes);
}

std::span<const CacheShape> usual_caches() {
  static constexpr std::array shapes{CacheShape{.bytes = 4 << 10}, CacheShape{.bytes = 16 << 10},
                                     CacheShape{.bytes = 64 << 10}};
  return shapes;
}

}  // namespace hitpipe::ref
