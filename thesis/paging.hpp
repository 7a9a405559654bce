// A model of paging (section 5.8) for arrays larger than memory. A page is loaded when it is touched, and the
// least recently used page leaves. The model counts page faults on the addresses that a traversal really
// reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/scene/mesh.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

class PagedMemory {
 public:
  static constexpr std::uint64_t page_bytes = 4096;

  /// Room for budget / page_bytes pages, at least one.
  explicit PagedMemory(std::uint64_t budget_bytes);

  /// Address of a new array, at the start of a page. None of its pages is in memory.
  [[nodiscard]] std::uint64_t add_array(std::uint64_t bytes);

  /// Reads `bytes` >= 1 from the address; they must lie in one array.
  void read(std::uint64_t address, std::uint64_t bytes);

  [[nodiscard]] std::uint64_t faults() const { return faults_; }

 private:
  static constexpr std::uint32_t none = ~0U;
  /// Neighbours in the list from the most to the least recently used page; absent pages have none.
  struct Page {
    std::uint32_t newer = none;
    std::uint32_t older = none;
    bool present = false;
  };

  void touch(std::uint32_t page);
  void unlink(std::uint32_t page);

  std::vector<Page> pages_;
  std::uint64_t room_;
  std::uint64_t present_ = 0;
  std::uint64_t faults_ = 0;
  std::uint32_t newest_ = none;
  std::uint32_t oldest_ = none;
};

/// The arrays of a hierarchy and its triangles in paged memory. It observes the loads of a traversal.
class PagedScene {
 public:
  /// Mesh and hierarchy must outlive it.
  PagedScene(const Mesh& mesh, const Bvh& bvh, std::size_t bytes_per_node, std::uint64_t budget_bytes);

  void node_loaded(std::uint32_t node) { memory_.read(nodes_ + node * bytes_per_node_, bytes_per_node_); }
  void triangle_loaded(std::uint32_t triangle);

  [[nodiscard]] std::uint64_t faults() const { return memory_.faults(); }

 private:
  const Mesh* mesh_;
  std::vector<std::uint32_t> entry_of_;  ///< by triangle: its place in Bvh::order
  std::uint64_t bytes_per_node_;
  PagedMemory memory_;
  std::uint64_t nodes_;
  std::uint64_t entries_;
  std::uint64_t triangles_;
  std::uint64_t vertices_;
};

}  // namespace hitpipe::thesis
