// What the proof of docs/instances.md says of a ray in an object, for each hit, in rational numbers.
#include "rays/world/object_space.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "rays/world/instances.hpp"
#include "rays/world/int_triangle.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/rays/world/instance_cases.hpp"

namespace hitpipe::ref {
namespace {

using hls::WorldBits;
using oracle::Rational;

Rational power(int e) {
  return e >= 0 ? Rational(oracle::Integer(1) << e) : Rational(1) / Rational(oracle::Integer(1) << -e);
}

Rational exact(Int128 x) {
  return Rational(oracle::Integer(static_cast<std::int64_t>(x >> 62)) * (oracle::Integer(1) << 62) +
                  static_cast<std::int64_t>(x & ((Int128{1} << 62) - 1)));
}

/// Hits, and how often a statement of the proof was false, or nearly.
struct Seen {
  int hits = 0, missed = 0, before_start = 0, beside = 0, cut_off = 0, out_of_range = 0;
  int far_beside = 0;    ///< by more than half of the slack
  int short_behind = 0;  ///< less than T + 1 would be cut off
};

/// A hit of the triangle that corners v of the mesh have in the world.
void judge(const IntInstances& world, const IntInstances::Entry& entry, const IntRay& ray,
           const IntCrossing& hit, const IntTriangle& in_world, const IntTriangle& own, Seen& seen) {
  const WorldBits& bits = world.bits();
  const ObjectSpace& space = entry.space;
  ++seen.hits;
  const auto inside =
      ObjectRay::enter(space, world.instances()[entry.instance].map, ray, bits.largest_distance(), bits);
  if (!inside) {
    ++seen.missed;
    return;
  }
  const auto at = [&](const IntTriangle& triangle, std::size_t k) {
    Rational sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += exact(hit.e[i]) * triangle.corners[i][k];
    return Rational(sum / exact(hit.det));
  };
  const auto m = static_cast<std::size_t>(ray.major);
  const Rational way =
      (at(in_world, m) * power(bits.finer) - ray.origin[m]) * (ray.direction[m] < 0 ? -1 : 1);
  const Rational t = way * power(bits.fraction);  // that T is the floor of
  if (t < inside->start()) ++seen.before_start;
  const int down = bits.slope + space.fraction + bits.fraction;
  const Rational ran = t - inside->start();
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational place = inside->origin()[k] + ran * inside->direction()[k] * power(-down);
    const Rational off = abs(Rational(place - at(own, k) * power(bits.finer)));
    if (off > space.slack[k]) ++seen.beside;
    if (2 * off > space.slack[k]) ++seen.far_beside;
    // What the units subtract fits their width.
    const Rational difference =
        std::abs(inside->origin()[k]) + space.most[k] * power(bits.finer) + space.slack[k];
    if (difference >= power(bits.point() - 1)) ++seen.out_of_range;
  }
  const std::int64_t size = std::abs(inside->direction()[static_cast<std::size_t>(inside->major())]);
  const int fraction = bits.finer;
  const auto largest = std::numeric_limits<std::int64_t>::max();
  const Rational behind = ran * size * power(fraction - down - bits.finer);
  if (inside->distance(hit.t, fraction, largest) < oracle::floor(behind)) ++seen.cut_off;
  if (inside->distance(hit.t - 1, fraction, largest) < oracle::floor(behind)) ++seen.short_behind;
}

TEST(ObjectSpace, EachHitIsWithinTheSlack) {
  instance_cases::Worlds worlds(31);
  Seen seen;
  while (seen.hits < 4'000) {
    const WorldBits bits = worlds.bits();
    const auto world = worlds.world(bits);
    if (!world) continue;
    const std::vector<IntTriangle> triangles = flattened(*world);
    for (int i = 0; i < 60; ++i) {
      IntRay ray = worlds.ray(*world, triangles);
      ray.length = bits.largest_distance();
      for (const IntInstances::Entry& entry : world->entries()) {
        if (entry.node != 0) continue;  // other triangles of the mesh are in another part
        const std::uint32_t base = world->base(entry.instance);
        const auto& own = world->mesh_of(entry.instance).triangles();
        for (std::uint32_t k = 0; k < own.size(); ++k) {
          const auto hit = int_crossing(ray, triangles[base + k], bits);
          if (!hit) continue;
          IntTriangle its = own[k];
          if (world->instances()[entry.instance].map.mirrors()) std::swap(its.corners[1], its.corners[2]);
          judge(*world, entry, ray, *hit, triangles[base + k], its, seen);
        }
      }
    }
  }
  EXPECT_EQ(seen.missed, 0);
  EXPECT_EQ(seen.before_start, 0);
  EXPECT_EQ(seen.beside, 0);
  EXPECT_EQ(seen.cut_off, 0);
  EXPECT_EQ(seen.out_of_range, 0);
  // The statements are near the truth.
  EXPECT_GT(seen.far_beside, 100);
  EXPECT_GT(seen.short_behind, 10);
}

}  // namespace
}  // namespace hitpipe::ref
