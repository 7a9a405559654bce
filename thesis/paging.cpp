#include "thesis/paging.hpp"

#include <algorithm>

namespace hitpipe::thesis {
namespace {

constexpr std::uint64_t entry_bytes = sizeof(std::uint32_t);
constexpr std::uint64_t triangle_bytes = sizeof(glm::uvec3);
constexpr std::uint64_t vertex_bytes = sizeof(glm::vec3);

}  // namespace

PagedMemory::PagedMemory(std::uint64_t budget_bytes)
    : room_(std::max<std::uint64_t>(1, budget_bytes / page_bytes)) {}

std::uint64_t PagedMemory::add_array(std::uint64_t bytes) {
  const std::uint64_t address = pages_.size() * page_bytes;
  pages_.resize(pages_.size() + (bytes + page_bytes - 1) / page_bytes);
  return address;
}

void PagedMemory::read(std::uint64_t address, std::uint64_t bytes) {
  const std::uint64_t last = (address + bytes - 1) / page_bytes;
  for (std::uint64_t page = address / page_bytes; page <= last; ++page)
    touch(static_cast<std::uint32_t>(page));
}

void PagedMemory::touch(std::uint32_t page) {
  if (page == newest_) return;
  if (pages_[page].present) {
    unlink(page);
  } else {
    ++faults_;
    if (present_ == room_) {
      const std::uint32_t leaving = oldest_;
      unlink(leaving);
      pages_[leaving].present = false;
    } else {
      ++present_;
    }
    pages_[page].present = true;
  }
  pages_[page].newer = none;
  pages_[page].older = newest_;
  (newest_ == none ? oldest_ : pages_[newest_].newer) = page;
  newest_ = page;
}

void PagedMemory::unlink(std::uint32_t page) {
  const Page& at = pages_[page];
  (at.newer == none ? newest_ : pages_[at.newer].older) = at.older;
  (at.older == none ? oldest_ : pages_[at.older].newer) = at.newer;
}

PagedScene::PagedScene(const Mesh& mesh, const Bvh& bvh, std::size_t bytes_per_node,
                       std::uint64_t budget_bytes)
    : mesh_(&mesh),
      entry_of_(mesh.triangles.size()),
      bytes_per_node_(bytes_per_node),
      memory_(budget_bytes),
      nodes_(memory_.add_array(bvh.nodes.size() * bytes_per_node)),
      entries_(memory_.add_array(bvh.order.size() * entry_bytes)),
      triangles_(memory_.add_array(mesh.triangles.size() * triangle_bytes)),
      vertices_(memory_.add_array(mesh.vertices.size() * vertex_bytes)) {
  for (std::uint32_t i = 0; i < bvh.order.size(); ++i) entry_of_[bvh.order[i]] = i;
}

void PagedScene::triangle_loaded(std::uint32_t triangle) {
  memory_.read(entries_ + entry_of_[triangle] * entry_bytes, entry_bytes);
  memory_.read(triangles_ + triangle * triangle_bytes, triangle_bytes);
  const glm::uvec3& corners = mesh_->triangles[triangle];
  for (int i = 0; i < 3; ++i) memory_.read(vertices_ + corners[i] * vertex_bytes, vertex_bytes);
}

}  // namespace hitpipe::thesis
