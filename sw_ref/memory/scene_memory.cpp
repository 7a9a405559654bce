#include "sw_ref/memory/scene_memory.hpp"

#include <array>

namespace hitpipe::ref {

namespace {

constexpr std::uint64_t number_bytes = sizeof(std::uint32_t);
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

SceneMemory::SceneMemory(const Mesh& mesh, const Bvh& bvh, const Tracer& tracer, TriangleLayout layout,
                         std::span<const CacheShape> caches)
    : mesh_(&mesh),
      layout_(layout),
      order_(tracer.memory_order()),
      address_of_(mesh.triangles.size()),
      bytes_per_node_(tracer.bytes_per_node()),
      entry_bytes_(layout == TriangleLayout::corners ? bytes_of_corners : number_bytes),
      reads_(caches) {
  const std::span<const std::uint32_t> triangles =
      order_.triangles.empty() ? std::span(bvh.order) : order_.triangles;
  const std::uint64_t node_bytes = tracer.node_count() * bytes_per_node_;
  const std::uint64_t all_entries = triangles.size() * entry_bytes_;
  const bool together = !order_.triangles_before.empty();
  nodes_ = reads_.add_array(together ? node_bytes + all_entries : node_bytes);
  const std::uint64_t entries = together ? nodes_ : reads_.add_array(all_entries);
  std::size_t nodes_before = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    while (nodes_before < order_.triangles_before.size() && order_.triangles_before[nodes_before] <= i)
      ++nodes_before;
    address_of_[triangles[i]] = entries + i * entry_bytes_ + nodes_before * bytes_per_node_;
  }
  if (layout == TriangleLayout::corners) return;
  triangles_ = reads_.add_array(mesh.triangles.size() * numbers_bytes);
  vertices_ = reads_.add_array(mesh.vertices.size() * corner_bytes);
}

void SceneMemory::triangle_loaded(std::uint32_t triangle) {
  reads_.read(address_of_[triangle], entry_bytes_);
  if (layout_ == TriangleLayout::corners) return;
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
