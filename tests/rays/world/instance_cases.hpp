// Random worlds of instances, and rays that are hard for them: ten kinds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rays/world/instances.hpp"
#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::instance_cases {

using world_cases::Draw;
using world_cases::WorldBits;
using Matrix = std::array<std::array<double, 3>, 3>;
using Way = std::array<std::int64_t, 3>;

class Worlds {
 public:
  explicit Worlds(std::uint64_t seed) : draw_(seed) {}

  Draw& draw() { return draw_; }
  template <class Range>
  const auto& pick(const Range& from) {
    return from[static_cast<std::size_t>(draw_.integer(0, static_cast<std::int64_t>(from.size()) - 1))];
  }

  WorldBits bits() {
    constexpr std::array coords{8, 10, 12, 16, 20, 24};
    constexpr std::array slopes{4, 8, 12, 16, 20, 24, 32};
    constexpr std::array fractions{0, 0, 2, 8};
    return {pick(coords), static_cast<int>(draw_.integer(0, 3)), pick(slopes), pick(fractions)};
  }

  /// Triangles that share corners, some of them flat.
  std::vector<IntTriangle> mesh(const WorldBits& bits) {
    const std::int64_t fits = std::int64_t{1} << (bits.coord - (draw_.one_in(4) ? 4 : 5));
    const std::int64_t most = draw_.one_in(4) ? draw_.integer(1, fits) : fits - 1;
    std::vector<IntTriangle::Corner> corners(static_cast<std::size_t>(draw_.integer(3, 9)));
    const bool flat = draw_.one_in(6);
    for (auto& corner : corners) {
      for (auto& x : corner) x = static_cast<std::int32_t>(draw_.integer(-most, most));
      if (flat) corner[2] = corners[0][2];
    }
    std::vector<IntTriangle> made(static_cast<std::size_t>(draw_.integer(1, 16)));
    for (IntTriangle& triangle : made) {
      for (auto& corner : triangle.corners) corner = pick(corners);
      if (draw_.one_in(8))  // a corner in the middle of the opposite edge, or nearly
        for (std::size_t k = 0; k < 3; ++k)
          triangle.corners[1][k] = (triangle.corners[0][k] + triangle.corners[2][k]) >> 1;
    }
    return made;
  }

  Matrix matrix() {
    constexpr Matrix one{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    switch (draw_.integer(0, 7)) {
      case 0:
        return one;
      case 1:
        return lattice();
      case 2:
        return turned(one);
      case 3: {  // mirrored
        Matrix m = turned(one);
        for (double& x : m[0]) x = -x;
        return m;
      }
      case 4: {  // of unequal scales
        Matrix m = one;
        for (std::size_t k = 0; k < 3; ++k) m[k][k] = std::exp2(-unit() * 6);
        return turned(m);
      }
      case 5: {  // flattened, or nearly
        Matrix m = turned(one);
        for (std::size_t j = 0; j < 3; ++j)
          m[2][j] = draw_.one_in(2) ? 0 : m[0][j] + (draw_.one_in(2) ? 0 : 1e-5 * unit());
        return m;
      }
      case 6: {  // a line, or nothing
        Matrix m{};
        if (!draw_.one_in(3)) m[0] = {1, 0.5, unit()};
        return m;
      }
      default: {
        Matrix m{};
        for (auto& row : m)
          for (double& x : row) x = 2 * unit() - 1;
        return m;
      }
    }
  }

  /// A place where the mesh is in the world, if its map is scaled so that it can be.
  std::optional<GridMap> map(const IntObject& mesh, const WorldBits& bits) {
    Matrix m = matrix();
    const auto largest = static_cast<double>(bits.largest_corner());
    const double part = draw_.one_in(2) ? 0.9 * unit() : 0.2 * unit();
    double widest = 0;
    for (const auto& row : m) widest = std::max(widest, reach(row, mesh));
    const bool keeps_scale = draw_.one_in(2) && widest < 0.9 * largest;
    if (widest > 0 && !keeps_scale) {
      double scale = part * largest / widest;
      if (draw_.one_in(2)) scale = std::exp2(std::floor(std::log2(scale)));
      for (auto& row : m)
        for (double& x : row) x *= scale;
    }
    std::array<double, 3> move{};
    for (std::size_t k = 0; k < 3; ++k)
      move[k] = std::floor((2 * unit() - 1) * std::max(0.0, largest - reach(m[k], mesh) - 2));
    try {
      return grid_map(m, move);
    } catch (const std::out_of_range&) {
      return std::nullopt;
    }
  }

  std::optional<IntInstances> world(const WorldBits& bits) {
    std::vector<IntObject> meshes;
    const auto count = static_cast<std::size_t>(draw_.integer(1, 3));
    const BuildOptions leaves{.builder = Builder::sah, .max_triangles = 2, .threads = 1};
    while (meshes.size() < count) meshes.emplace_back(mesh(bits), leaves);
    std::vector<IntInstance> instances;
    const auto wanted = static_cast<std::size_t>(draw_.integer(1, 6));
    while (instances.size() < wanted) {
      const auto mesh = static_cast<std::uint32_t>(draw_.integer(0, static_cast<std::int64_t>(count) - 1));
      const auto its_map = map(meshes[mesh], bits);
      if (!its_map) continue;
      const auto mask = static_cast<std::uint8_t>(draw_.one_in(2) ? 0xff : draw_.integer(0, 255));
      instances.push_back({mesh, *its_map, mask});
    }
    try {
      return IntInstances(std::move(meshes), std::move(instances), bits, leaves);
    } catch (const std::out_of_range&) {
      return std::nullopt;  // a mesh too large for its grid
    }
  }

  /// `triangles` is the flattened mesh. Rays go through corners, along edges and axes, in faces of boxes; they begin at
  /// corners, inside of instances and anywhere, and some are nearly stiff.
  IntRay ray(const IntInstances& world, const std::vector<IntTriangle>& triangles) {
    const WorldBits& bits = world.bits();
    const IntTriangle& aim = pick(triangles);
    const IntTriangle& other = pick(triangles);
    Way from = draw_.origin(bits);
    switch (draw_.integer(0, 9)) {
      case 0:
        return draw_.ray(bits, from, aim);  // a corner, an edge, the inside, or anything
      case 1:
        return draw_.ray(bits, at(bits, other.corners[0]), aim);
      case 2: {  // along an edge, from before it
        const Way edge = between(bits, aim.corners[0], aim.corners[1]);
        for (std::size_t k = 0; k < 3; ++k)
          from[k] = clamped(bits, (std::int64_t{aim.corners[0][k]} << bits.finer) - 2 * edge[k]);
        return along(bits, from, edge);
      }
      case 3: {  // along an axis, through a corner
        from = at(bits, aim.corners[0]);
        const auto axis = static_cast<std::size_t>(draw_.integer(0, 2));
        from[axis] = draw_.integer(-bits.largest_point(), bits.largest_point());
        Way way{};
        way[axis] = (std::int64_t{aim.corners[0][axis]} << bits.finer) - from[axis];
        return along(bits, from, way);
      }
      case 4: {  // in a face of a box
        const IntBox& box = pick(world.entries()).space.box;
        const auto axis = static_cast<std::size_t>(draw_.integer(0, 2));
        const std::int64_t face = std::int64_t{draw_.one_in(2) ? box.min[axis] : box.max[axis]} << bits.finer;
        Way way = between(bits, other.corners[0], aim.corners[1]);
        way[axis] = 0;
        from[axis] = face;
        return along(bits, from, way);
      }
      case 5: {  // nearly stiff
        Way way{};
        const auto axis = static_cast<std::size_t>(draw_.integer(0, 2));
        for (std::size_t k = 0; k < 3; ++k)
          way[k] = k == axis ? bits.one() * (draw_.one_in(2) ? 1 : -1) : draw_.integer(-2, 2);
        from = at(bits, aim.corners[2]);
        from[axis] = draw_.integer(-bits.largest_point(), bits.largest_point());
        return along(bits, from, way);
      }
      case 6: {  // from the middle of a box
        const IntBox& box = pick(world.entries()).space.box;
        for (std::size_t k = 0; k < 3; ++k)
          from[k] = ((std::int64_t{box.min[k]} + box.max[k]) << bits.finer) >> 1;
        return draw_.ray(bits, from, aim);
      }
      case 7:
        return along(bits, from, between(bits, aim.corners[0], other.corners[1]));
      case 8: {  // from the far end of the cube to a corner
        for (auto& x : from) x = draw_.one_in(2) ? bits.largest_point() : -bits.largest_point();
        return draw_.ray(bits, from, {{aim.corners[1], aim.corners[1], aim.corners[1]}});
      }
      default: {  // through a corner with diagonal slopes
        Way way{};
        for (auto& x : way) x = draw_.integer(-1, 1);
        const std::int64_t steps = draw_.integer(0, bits.largest_point());
        for (std::size_t k = 0; k < 3; ++k)
          from[k] = clamped(bits, (std::int64_t{aim.corners[0][k]} << bits.finer) - steps * way[k]);
        return along(bits, from, way);
      }
    }
  }

 private:
  double unit() { return static_cast<double>(draw_.integer(0, 1 << 30)) * 0x1p-30; }
  static double reach(const std::array<double, 3>& row, const IntObject& mesh) {
    double sum = 1;
    for (std::size_t j = 0; j < 3; ++j) sum += std::abs(row[j]) * mesh.most()[j];
    return sum;
  }
  static Way at(const WorldBits& bits, const IntTriangle::Corner& corner) {
    return {std::int64_t{corner[0]} << bits.finer, std::int64_t{corner[1]} << bits.finer,
            std::int64_t{corner[2]} << bits.finer};
  }
  static Way between(const WorldBits& bits, const IntTriangle::Corner& a, const IntTriangle::Corner& b) {
    const Way p = at(bits, a), q = at(bits, b);
    return {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  }
  static std::int64_t clamped(const WorldBits& bits, std::int64_t x) {
    return std::clamp(x, -bits.largest_point(), bits.largest_point());
  }
  static IntRay along(const WorldBits& bits, const Way& from, Way way) {
    if (way == Way{}) way[2] = 1;
    return Draw::along(bits, from, way);
  }
  Matrix lattice() {
    Matrix m{};
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::swap(axes[0], axes[static_cast<std::size_t>(draw_.integer(0, 2))]);
    std::swap(axes[1], axes[static_cast<std::size_t>(draw_.integer(1, 2))]);
    for (std::size_t k = 0; k < 3; ++k) m[k][axes[k]] = draw_.one_in(2) ? 1 : -1;
    return m;
  }
  /// Turned at random, before and after.
  Matrix turned(const Matrix& m) {
    const Matrix r = rotation();
    Matrix made{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) made[k][j] += r[k][i] * m[i][j];
    return made;
  }
  Matrix rotation() {
    std::array<double, 4> q{};
    double size = 0;
    while (size < 0.1) {
      size = 0;
      for (double& x : q) {
        x = 2 * unit() - 1;
        size += x * x;
      }
    }
    for (double& x : q) x /= std::sqrt(size);
    const auto [w, x, y, z] = q;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
  }

  Draw draw_;
};

}  // namespace hitpipe::ref::instance_cases
