// What a traversal reads of memory: a hierarchy of any encoding and its triangles, each array at addresses of
// its own, without a cache and behind several caches at once. Rays are traced one after the other; the caches
// begin empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/mesh/mesh.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/memory/line_cache.hpp"

namespace hitpipe::ref {

/// Arrays at addresses of their own, and what reads of them cost.
class ReadCounter {
 public:
  /// Arrays begin at multiples of this, so no line holds parts of two.
  static constexpr std::uint64_t alignment = 4096;

  /// Lines have at most `alignment` bytes and a power of two.
  explicit ReadCounter(std::span<const CacheShape> caches);

  /// Address of a new array.
  [[nodiscard]] std::uint64_t add_array(std::uint64_t bytes);
  /// Reads `bytes` >= 1 from the address; they must lie in one array.
  void read(std::uint64_t address, std::uint64_t bytes);

  /// All bytes that were read.
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }
  /// Lines that this cache got from memory.
  [[nodiscard]] std::uint64_t lines_fetched(std::size_t cache) const { return caches_[cache].fetched; }
  [[nodiscard]] std::uint64_t bytes_fetched(std::size_t cache) const {
    return caches_[cache].fetched * caches_[cache].line_bytes;
  }

 private:
  struct Cache {
    LineCache lines;
    std::uint32_t line_bytes;
    std::uint64_t fetched = 0;
  };
  std::vector<Cache> caches_;
  std::uint64_t end_ = 0;
  std::uint64_t bytes_read_ = 0;
};

/// How triangles lie in memory.
enum class TriangleLayout : std::uint8_t {
  corners,  ///< an entry is three corners in binary32; entries lie in the order of the leaves
  indices,  ///< an entry is the triangle's number; its three numbers of corners, and the corners, lie apart
};

/// The nodes and triangles of a hierarchy. A tracer tells it what it loads (TraceJob::loads).
class SceneMemory final : public LoadObserver {
 public:
  /// The nodes of the tracer, which is of this mesh and hierarchy. All must outlive it.
  SceneMemory(const Mesh& mesh, const Bvh& bvh, const Tracer& tracer, TriangleLayout layout,
              std::span<const CacheShape> caches);

  void node_loaded(std::uint32_t node) override {
    reads_.read(nodes_ + node * bytes_per_node_ + triangles_before(node) * entry_bytes_, bytes_per_node_);
  }
  void triangle_loaded(std::uint32_t triangle) override;

  [[nodiscard]] const ReadCounter& reads() const { return reads_; }

 private:
  [[nodiscard]] std::uint64_t triangles_before(std::uint32_t node) const {
    return order_.triangles_before.empty() ? 0 : order_.triangles_before[node];
  }

  const Mesh* mesh_;
  TriangleLayout layout_;
  MemoryOrder order_;
  std::vector<std::uint64_t> address_of_;  ///< by triangle: of its entry
  std::uint64_t bytes_per_node_;
  std::uint64_t entry_bytes_;
  ReadCounter reads_;
  std::uint64_t nodes_;
  std::uint64_t triangles_ = 0;
  std::uint64_t vertices_ = 0;
};

/// A triangle in memory: three corners in binary32.
inline constexpr std::uint64_t corner_bytes = sizeof(glm::vec3);
inline constexpr std::uint64_t bytes_of_corners = 3 * corner_bytes;

/// The caches that memory is studied with: 4, 16 and 64 KiB with 8 ways of 64-byte lines.
[[nodiscard]] std::span<const CacheShape> usual_caches();

}  // namespace hitpipe::ref
