#include "rays/scene/triangle_numbers.hpp"

#include <utility>

#include "rays/exact/exact_triangle.hpp"

namespace hitpipe::ref {

namespace {

template <class Vertex>
std::vector<std::uint32_t> flat(const MeshOf<Vertex>& mesh) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    if (!has_area(mesh.corners(i))) found.push_back(i);
  return found;
}

template <class Vertex>
void drop_from(MeshOf<Vertex>& mesh, std::span<const std::uint32_t> triangles) {
  if (triangles.empty()) return;
  std::vector<std::uint32_t> dropped;
  dropped.reserve(mesh.dropped.size() + triangles.size());
  std::vector<glm::uvec3> corners;
  corners.reserve(dropped.capacity());
  const bool known = mesh.dropped_corners.size() == mesh.dropped.size();
  auto earlier = mesh.dropped.begin();
  auto now = triangles.begin();
  std::uint32_t number = 0;
  const auto skip_earlier = [&] {
    for (; earlier != mesh.dropped.end() && *earlier == number; ++earlier) {
      if (known)
        corners.push_back(mesh.dropped_corners[static_cast<std::size_t>(earlier - mesh.dropped.begin())]);
      dropped.push_back(number++);
    }
  };
  std::size_t kept = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i, ++number) {
    skip_earlier();
    if (now != triangles.end() && *now == i) {
      dropped.push_back(number);
      corners.push_back(mesh.triangles[i]);
      ++now;
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
  if (known) mesh.dropped_corners = std::move(corners);
}

}  // namespace

std::vector<std::uint32_t> flat_triangles(const SourceMesh& mesh) {
  return flat(mesh);
}
std::vector<std::uint32_t> flat_triangles(const Mesh& mesh) {
  return flat(mesh);
}

void drop(SourceMesh& mesh, std::span<const std::uint32_t> triangles) {
  drop_from(mesh, triangles);
}
void drop(Mesh& mesh, std::span<const std::uint32_t> triangles) {
  drop_from(mesh, triangles);
}

std::uint32_t TriangleNumbers::of_source(std::uint32_t triangle) const {
  // dropped[k] - k triangles of the mesh come before the k-th that was dropped.
  const std::vector<std::uint32_t>& dropped = *dropped_;
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

std::uint32_t TriangleNumbers::first_of(std::size_t face) const {
  if (faces_->empty()) return static_cast<std::uint32_t>(face);
  return face < faces_->size() ? (*faces_)[face] : static_cast<std::uint32_t>(in_source_);
}

std::uint32_t TriangleNumbers::face_of(std::uint32_t number) const {
  if (faces_->empty()) return number;
  return static_cast<std::uint32_t>(std::upper_bound(faces_->begin(), faces_->end(), number) -
                                    faces_->begin() - 1);
}

}  // namespace hitpipe::ref
