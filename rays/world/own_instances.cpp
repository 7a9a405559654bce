#include "rays/world/own_instances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "rays/exact/grid.hpp"
#include "rays/world/object_space.hpp"

namespace hitpipe::ref {

namespace {

/// Bits of a mesh's grid below the unit of the world's, where the largest instance has it. More help nobody.
constexpr int finest = 3;

double largest_entry(const glm::dmat3& m) {
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
  return largest;
}

/// Largest k with 2^k <= x.
int floor_log2(double x) {
  return std::ilogb(x);
}
int ceil_log2(double x) {
  const int down = std::ilogb(x);
  return std::ldexp(1.0, down) < x ? down + 1 : down;
}

/// One of the 48 symmetries times a power of two.
bool is_lattice(const glm::dmat3& m) {
  GridMap map;
  const double largest = largest_entry(m);
  if (!(largest > 0) || std::ldexp(1.0, std::ilogb(largest)) != largest) return false;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) {
      const double part = m[column][row] / largest;
      if (part != std::round(part)) return false;
      map.matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          static_cast<std::int32_t>(part);
    }
  return map.is_lattice();
}

std::optional<Bounds> bounds_of(const SourceMesh& mesh) {
  if (mesh.triangles.empty()) return std::nullopt;
  return mesh_bounds(mesh);
}

/// Corners that no triangle uses may be anywhere.
std::array<std::int32_t, 3> rounded(const glm::dvec3& place) {
  std::array<std::int32_t, 3> made{};
  for (int axis = 0; axis < 3; ++axis)
    made[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(std::clamp(std::floor(place[axis] + 0.5), -0x1p30, 0x1p30));
  return made;
}

}  // namespace

std::optional<Bounds> own_bounds(std::span<const SourceMesh> meshes, std::span<const OwnInstance> instances) {
  std::vector<std::optional<Bounds>> boxes;
  for (const SourceMesh& mesh : meshes) boxes.push_back(bounds_of(mesh));
  std::optional<Bounds> all;
  for (const OwnInstance& instance : instances) {
    const auto& box = boxes[instance.mesh];
    if (!box) continue;
    for (unsigned corner = 0; corner < 8; ++corner) {
      glm::dvec3 place;
      for (int axis = 0; axis < 3; ++axis)
        place[axis] = ((corner >> axis & 1U) != 0 ? box->max : box->min)[axis];
      place = instance.linear * place + instance.move;
      if (!all) all = Bounds{place, place};
      all->grow(place);
    }
  }
  return all;
}

InstanceGrids::InstanceGrids(std::span<const SourceMesh> meshes, std::span<const OwnInstance> instances,
                             const Normalisation& to_cube, const hls::WorldBits& bits)
    : to_cube_(to_cube), scale_(to_cube.scale * static_cast<double>(grid_scale(bits.coord))) {
  std::vector<std::vector<const OwnInstance*>> of_mesh(meshes.size());
  for (const OwnInstance& instance : instances) of_mesh[instance.mesh].push_back(&instance);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    MeshGrid& grid = grids_.emplace_back();
    const auto bounds = bounds_of(meshes[i]);
    if (!bounds) continue;
    grid.offset = bounds->centre();
    // Half the mesh along each axis, in units of the world's grid.
    const glm::dvec3 half = (bounds->max - grid.offset) * scale_;
    const double longest = std::max({half.x, half.y, half.z});
    if (!(longest > 0) || of_mesh[i].empty()) continue;
    double scale = 0;
    bool on_lattice = true;
    int coarsest = std::numeric_limits<int>::max();
    for (const OwnInstance* const instance : of_mesh[i]) {
      const double its = largest_entry(instance->linear);
      on_lattice = on_lattice && is_lattice(instance->linear);
      if (its > 0) coarsest = std::min(coarsest, floor_log2(its));
      scale = std::max(scale, its);
    }
    const auto largest = static_cast<double>((std::int64_t{1} << std::max(bits.coord - 3, 0)) - 1);
    const int wanted = on_lattice ? coarsest : scale > 0 ? ceil_log2(scale) + finest : 0;
    grid.finer = std::min(wanted, floor_log2(largest / (longest + 1)));
    // Up to 2^(n-5) each map has a matrix of rays.
    const double always = std::ldexp(1.0, bits.coord - 5) - 1;
    const auto fits = [&] {
      const glm::dvec3 most = half * std::ldexp(1.0, grid.finer) + 1.0;
      if (std::max({most.x, most.y, most.z}) <= always) return true;
      try {
        const auto whole = static_cast<std::int32_t>(bits.largest_corner());
        const auto corner = rounded(most);
        for (const OwnInstance* const instance : of_mesh[i]) {
          const GridMap map = map_on(grid, *instance);
          const auto [least, end] = map.places({{-corner[0], -corner[1], -corner[2]}, corner});
          IntBox box;
          for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(least[k], -whole, whole));
            box.max[k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(end[k], -whole, whole));
          }
          static_cast<void>(object_space(map, corner, box, bits));
        }
        return true;
      } catch (const std::out_of_range&) {
        return false;
      }
    };
    while (!fits()) --grid.finer;
  }
}

GridMap InstanceGrids::map_on(const MeshGrid& grid, const OwnInstance& instance) const {
  const double unit = std::ldexp(1.0, -grid.finer);
  const glm::dvec3 place = (instance.linear * grid.offset + instance.move - to_cube_.offset) * scale_;
  std::array<std::array<double, 3>, 3> matrix{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          instance.linear[column][row] * unit;
  return grid_map(matrix, {place.x, place.y, place.z});
}

GridMap InstanceGrids::map(const OwnInstance& instance) const {
  return map_on(grids_[instance.mesh], instance);
}

std::vector<IntTriangle> InstanceGrids::triangles(const SourceMesh& mesh, std::uint32_t number) const {
  const MeshGrid& grid = grids_[number];
  const double scale = scale_ * std::ldexp(1.0, grid.finer);
  std::vector<IntTriangle::Corner> corners;
  corners.reserve(mesh.vertices.size());
  for (const glm::dvec3& vertex : mesh.vertices) corners.push_back(rounded((vertex - grid.offset) * scale));
  std::vector<IntTriangle> made;
  made.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) made.push_back({{corners[t.x], corners[t.y], corners[t.z]}});
  return made;
}

IntInstances int_instances(std::span<const SourceMesh> meshes, std::span<const OwnInstance> instances,
                           const InstanceGrids& grids, const hls::WorldBits& bits,
                           const BuildOptions& options) {
  std::vector<IntObject> objects;
  for (std::uint32_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].triangles.empty())
      throw std::runtime_error(fmt::format("mesh {}: it has no triangle; a mesh of instances has one", i));
    objects.emplace_back(grids.triangles(meshes[i], i), options);
  }
  std::vector<IntInstance> made;
  made.reserve(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) {
    try {
      made.push_back({instances[i].mesh, grids.map(instances[i]), instances[i].mask});
    } catch (const std::out_of_range& why) {
      throw std::runtime_error(fmt::format("instance {}: {}", i, why.what()));
    }
  }
  try {
    return {std::move(objects), std::move(made), bits, options};
  } catch (const std::logic_error& why) {
    throw std::runtime_error(why.what());
  }
}

}  // namespace hitpipe::ref
