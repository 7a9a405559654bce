#include "sw_ref/scene/triangle_numbers.hpp"

#include <utility>
#include <vector>

#include "sw_ref/judge/triangle_test.hpp"

namespace hitpipe::ref {

void drop_degenerate(Mesh& mesh) {
  std::vector<std::uint32_t> dropped;
  auto earlier = mesh.dropped.begin();
  std::uint32_t source = 0;
  const auto skip_earlier = [&] {
    for (; earlier != mesh.dropped.end() && *earlier == source; ++earlier) dropped.push_back(source++);
  };
  std::size_t kept = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i, ++source) {
    skip_earlier();
    if (!has_area(mesh.corners(i))) {
      dropped.push_back(source);
      continue;
    }
    mesh.triangles[kept] = mesh.triangles[i];
    if (!mesh.materials.empty()) mesh.materials[kept] = mesh.materials[i];
    ++kept;
  }
  skip_earlier();
  mesh.triangles.resize(kept);
  if (!mesh.materials.empty()) mesh.materials.resize(kept);
  mesh.dropped = std::move(dropped);
}

std::uint32_t TriangleNumbers::of_source(std::uint32_t triangle) const {
  // dropped[k] - k triangles of the mesh come before the k-th that was dropped.
  const std::vector<std::uint32_t>& dropped = mesh_->dropped;
  std::size_t low = 0;
  std::size_t high = dropped.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (dropped[middle] - middle > triangle) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return triangle + static_cast<std::uint32_t>(low);
}

}  // namespace hitpipe::ref
