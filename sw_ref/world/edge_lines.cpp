#include "sw_ref/world/edge_lines.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

#include "host/parallel.hpp"
#include "rays/world/int128.hpp"

namespace hitpipe::ref {

namespace {

using Place = std::array<std::int64_t, 3>;  // in units of the origin's grid

constexpr std::uint64_t rays_of_block = 2048;

/// A ray without an end along a way that is not 0. Slopes are rounded as at the door.
IntRay ray_along(const hls::WorldBits& bits, const Place& origin, const Place& way,
                 const std::array<bool, 3>& negative) {
  IntRay made;
  made.origin = origin;
  made.negative = negative;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(way[axis]) > std::abs(way[static_cast<std::size_t>(made.major)]))
      made.major = static_cast<int>(axis);
  const Int128 longest = std::abs(way[static_cast<std::size_t>(made.major)]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto slope = static_cast<std::int64_t>(
        (2 * (static_cast<Int128>(std::abs(way[axis])) << bits.slope) + longest) / (2 * longest));
    made.direction[axis] = negative[axis] ? -slope : slope;
  }
  made.length = bits.largest_distance();
  return made;
}

IntRay opposite(IntRay ray) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.direction[axis] = -ray.direction[axis];
    ray.negative[axis] = !ray.negative[axis];
  }
  return ray;
}

class LineDraw {
 public:
  LineDraw(const IntMesh& mesh, const hls::WorldBits& bits, std::uint64_t seed)
      : mesh_(&mesh), bits_(bits), random_(seed) {}

  /// One ray of the line.
  IntRay line() {
    for (;;) {
      const IntTriangle& triangle = any_triangle();
      const Place aim = place_on(triangle);
      Place origin = aim, way{};
      switch (below(4)) {
        case 0:
        case 1:
          way = short_way();
          origin = back_from(aim, way);
          break;
        case 2:
          way = difference(place_on(below(2) == 0 ? triangle : any_triangle()), aim);
          break;
        default:
          for (std::int64_t& x : origin) x = between(-bits_.largest_point(), bits_.largest_point());
          way = difference(aim, origin);
      }
      if (way == Place{}) continue;
      std::array<bool, 3> negative{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        negative[axis] = way[axis] != 0 ? way[axis] < 0 : below(2) == 0;
      return ray_along(bits_, origin, way, negative);
    }
  }

 private:
  /// The remainder is a little uneven, which does not matter here, and the same with every library.
  std::uint64_t below(std::uint64_t end) { return random_() % end; }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low + 1)));
  }

  const IntTriangle& any_triangle() { return mesh_->triangles[below(mesh_->triangles.size())]; }

  static Place difference(const Place& p, const Place& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }

  /// A corner, or a lattice point of an edge.
  Place place_on(const IntTriangle& triangle) {
    const std::size_t from = below(3);
    Place place{}, edge{};
    std::int64_t steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = std::int64_t{triangle.corners[from][axis]} << bits_.finer;
      edge[axis] = (std::int64_t{triangle.corners[(from + 1) % 3][axis]} << bits_.finer) - place[axis];
      steps = std::gcd(steps, edge[axis]);
    }
    if (below(3) == 0) return place;
    const std::int64_t step = between(0, steps);
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis] += edge[axis] / steps * step;
    return place;
  }

  /// Slopes of at most four bits, which are exact.
  Place short_way() {
    const std::int64_t longest = std::int64_t{1} << between(0, 4);
    Place way{};
    const bool along_an_axis = below(4) == 0;
    for (std::int64_t& x : way) x = along_an_axis ? 0 : between(-longest, longest);
    way[below(3)] = below(2) == 0 ? longest : -longest;
    return way;
  }

  /// Some steps back, in the cube.
  Place back_from(Place place, const Place& way) {
    std::int64_t most = 2 * bits_.largest_point();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (way[axis] == 0) continue;
      const std::int64_t room = bits_.largest_point() + (way[axis] > 0 ? place[axis] : -place[axis]);
      most = std::min(most, room / std::abs(way[axis]));
    }
    const std::int64_t steps = between(0, most);
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis] -= steps * way[axis];
    return place;
  }

  const IntMesh* mesh_;
  hls::WorldBits bits_;
  std::mt19937_64 random_;
};

bool is_in_plane(const Place& point, const IntTriangle& triangle, const hls::WorldBits& bits) {
  std::array<std::array<Int128, 3>, 3> d{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      d[i][axis] = (std::int64_t{triangle.corners[i][axis]} << bits.finer) - point[axis];
  return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
             d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
             d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]) ==
         0;
}

/// What the ray crosses at its origin: T is exactly 0. The opposite ray crosses the same there.
CrossingCount at_origin(const IntMesh& mesh, const MeshCrossings& crossings, IntRay ray,
                        const hls::WorldBits& bits) {
  ray.length = 0;
  CrossingCount sum;
  for (const MeshCrossing& each : crossings.all(ray).crossings) {
    if (!is_in_plane(ray.origin, mesh.triangles[each.place.triangle], bits)) continue;
    ++sum.crossings;
    sum.sides += each.side;
  }
  return sum;
}

EdgeLines cross_line(const IntMesh& mesh, const MeshCrossings& crossings, const IntRay& ray,
                     const IntRay& back, const hls::WorldBits& bits) {
  const CrossingCount ahead = crossings.count(ray);
  const CrossingCount behind = crossings.count(back);
  EdgeLines made{.lines = 1,
                 .crossings = ahead.crossings + behind.crossings,
                 .ties = ahead.ties + behind.ties,
                 .tied_rays = (ahead.ties > 0 ? 1U : 0U) + (behind.ties > 0 ? 1U : 0U)};
  if (ahead.inside() && behind.inside()) made.from_inside = 1;
  if (made.crossings % 2 == 0 && ahead.sides == behind.sides) return made;
  // Both rays of the line have counted what is crossed at the origin.
  const CrossingCount twice = at_origin(mesh, crossings, ray, bits);
  made.crossings -= twice.crossings;
  if (made.crossings % 2 != 0) {
    made.odd = 1;
    made.first_odd = ray;
  }
  if (ahead.sides - behind.sides != twice.sides) {
    made.unbalanced = 1;
    made.first_unbalanced = ray;
  }
  return made;
}

}  // namespace

EdgeLines& EdgeLines::operator+=(const EdgeLines& later) {
  lines += later.lines;
  crossings += later.crossings;
  ties += later.ties;
  tied_rays += later.tied_rays;
  from_inside += later.from_inside;
  odd += later.odd;
  unbalanced += later.unbalanced;
  if (!first_odd) first_odd = later.first_odd;
  if (!first_unbalanced) first_unbalanced = later.first_unbalanced;
  return *this;
}

std::vector<IntRay> edge_rays(const IntMesh& mesh, const hls::WorldBits& bits, std::uint64_t seed,
                              std::uint64_t first, std::uint64_t end) {
  std::vector<IntRay> rays;
  for (std::uint64_t block = first / rays_of_block; block * rays_of_block < end; ++block) {
    // Seeds of blocks are far apart from those of the next seed's blocks.
    std::seed_seq seeds{seed, seed >> 32, block};
    std::array<std::uint32_t, 2> words{};
    seeds.generate(words.begin(), words.end());
    LineDraw draw(mesh, bits, std::uint64_t{words[0]} << 32 | words[1]);
    const std::uint64_t begin = block * rays_of_block;
    for (std::uint64_t i = begin; i < std::min(begin + rays_of_block, end); i += 2) {
      const IntRay ray = draw.line();
      if (i >= first) rays.push_back(ray);
      if (i + 1 >= first && i + 1 < end) rays.push_back(opposite(ray));
    }
  }
  return rays;
}

EdgeLines cross_edge_lines(const IntMesh& mesh, const MeshCrossings& crossings, const hls::WorldBits& bits,
                           const EdgeLineOptions& options) {
  const std::uint64_t all = 2 * options.lines;
  std::vector<EdgeLines> blocks((all + rays_of_block - 1) / rays_of_block);
  host::for_each_index(
      blocks.size(), options.threads,
      [&](std::size_t block) {
        const std::uint64_t first = block * rays_of_block;
        const std::vector<IntRay> rays =
            edge_rays(mesh, bits, options.seed, first, std::min(first + rays_of_block, all));
        for (std::size_t i = 0; i < rays.size(); i += 2)
          blocks[block] += cross_line(mesh, crossings, rays[i], rays[i + 1], bits);
      },
      options.progress);
  EdgeLines sum;
  for (const EdgeLines& block : blocks) sum += block;
  return sum;
}

}  // namespace hitpipe::ref
