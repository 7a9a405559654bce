// Instances give the answers of the mesh that they stand for, which is built here, with every question and both walks.
#include "rays/world/instances.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/trace/fast_tracer.hpp"
#include "rays/trace/int_fast_scene.hpp"
#include "rays/trace/mesh_crossings.hpp"
#include "rays/world/crossing.hpp"
#include "tests/rays/exact/rational.hpp"
#include "tests/rays/world/instance_cases.hpp"

namespace hitpipe::ref {
namespace {

using hls::MajorBits;
using hls::WorldBits;
using instance_cases::Worlds;

/// All that a ray without an end meets, tested one by one.
struct Met {
  CrossingPlace place;
  Crossing crossing;
};

std::vector<Met> met_by(const IntRay& ray, std::uint8_t mask, const IntInstances& world,
                        const std::vector<IntTriangle>& triangles) {
  std::vector<Met> met;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if ((world.instances()[world.part(i).instance].mask & mask) == 0) continue;
    if (const auto found = crossing_of(ray, triangles[i], world.bits()))
      met.push_back({{found->t, i}, *found});
  }
  std::sort(met.begin(), met.end(), [](const Met& a, const Met& b) { return a.place < b.place; });
  return met;
}

/// How many answers differ from those of all triangles, for the ray as long as it is.
struct Judged {
  std::uint64_t answers = 0, wrong = 0;
  void of(bool right) {
    ++answers;
    if (!right) ++wrong;
  }
};

void judge(const MeshCrossings& tested, const IntRay& ray, std::uint8_t mask,
           const std::vector<IntTriangle>& triangles, const std::vector<Met>& all, Judged& judged) {
  CrossingList right;
  IntHit nearest;
  for (const auto& [place, crossing] : all) {
    if (place.t > ray.length) break;
    if (!nearest.found()) nearest = {place.triangle, place.t};
    right.count.ties += crossing.tie ? 1 : 0;
    if (!crossing.once) continue;
    ++right.count.crossings;
    right.count.sides += crossing.side;
    right.crossings.push_back({place, crossing.side});
  }
  const IntHit found = tested.nearest(ray, mask);
  judged.of(found.triangle == nearest.triangle && (!found.found() || found.t == nearest.t));
  // What weights are made of.
  if (found.found() && nearest.found())
    judged.of(tested.triangles().triangle(found.triangle) == triangles[nearest.triangle]);
  judged.of(tested.any(ray, mask) == nearest.found());
  judged.of(tested.count(ray, mask) == right.count);
  const CrossingList list = tested.all(ray, mask);
  judged.of(list.crossings == right.crossings && list.count == right.count);
  CrossingPlace behind;
  for (const MeshCrossing& crossing : right.crossings) {
    const auto next = tested.next(ray, behind, mask);
    judged.of(next == crossing);
    behind = crossing.place;
  }
  judged.of(!tested.next(ray, behind, mask));
}

struct Walks {
  std::vector<MeshCrossings> all;

  explicit Walks(const IntInstances& world, Worlds& worlds) {
    const WorldBits& bits = world.bits();
    const auto mantissa = static_cast<int>(worlds.draw().integer(4, 13));
    const auto fraction = static_cast<int>(worlds.draw().integer(0, std::min(bits.finer + bits.fraction, 3)));
    all.emplace_back(
        world, IntTracerOptions{bits, MajorBits{bits.coord, bits.finer, mantissa, fraction, bits.slope}});
    all.emplace_back(world, IntTracerOptions{bits, {}}, VectorWidth::four);
    if (has_vectors(VectorWidth::eight))
      all.emplace_back(world, IntTracerOptions{bits, {}}, VectorWidth::eight);
  }
};

/// So many rays in worlds of 40 rays each. `damage` is done to each world before it is asked.
template <class Damage>
Judged fuzz(std::uint64_t seed, int rays, const Damage& damage) {
  Worlds worlds(seed);
  Judged judged;
  while (rays > 0) {
    auto world = worlds.world(worlds.bits());
    if (!world) continue;
    const std::vector<IntTriangle> triangles = flattened(*world);
    damage(*world);
    const Walks walks(*world, worlds);
    for (int i = 0; i < 40 && rays > 0; ++i, --rays) {
      IntRay ray = worlds.ray(*world, triangles);
      const auto mask =
          static_cast<std::uint8_t>(worlds.draw().one_in(3) ? worlds.draw().integer(0, 255) : 0xff);
      IntRay endless = ray;
      endless.length = world->bits().largest_distance();
      const std::vector<Met> all = met_by(endless, mask, *world, triangles);
      std::vector<std::int64_t> lengths{ray.length};
      if (!all.empty()) {  // exactly as far as a hit, and a unit less
        const std::int64_t t = worlds.pick(all).place.t;
        lengths.push_back(t);
        if (t > 0) lengths.push_back(t - 1);
      }
      for (const std::int64_t length : lengths) {
        ray.length = length;
        for (const MeshCrossings& walk : walks.all) judge(walk, ray, mask, triangles, all, judged);
      }
    }
  }
  return judged;
}

// What the slack of an instance is made of (docs/instances.md), in units of the origin's grid by axis.
enum class Part { ray_matrix, corners, anchor };

oracle::Rational part_of_slack(Part part, const ObjectSpace& space, const GridMap& map, const WorldBits& bits,
                               std::size_t k) {
  using oracle::Rational;
  const auto power = [](int e) { return Rational(std::int64_t{1} << e); };
  Rational row = 0;
  for (const std::int32_t x : space.to_object[k]) row += std::abs(x);
  row /= power(space.fraction);
  if (part == Part::corners) return map.fraction == 0 ? Rational(0) : row * power(bits.finer) / 2;
  if (part == Part::anchor) return row / 4;
  Rational sum = 0;
  for (std::size_t q = 0; q < 3; ++q) {
    Rational r = k == q ? 1 : 0;
    for (std::size_t i = 0; i < 3; ++i)
      r -= Rational(space.to_object[k][i]) * map.matrix[i][q] / power(space.fraction) / power(map.fraction);
    sum += (r < 0 ? Rational(-r) : r) * space.most[q];
  }
  return sum * power(bits.finer);
}

std::int64_t slack_without(std::optional<Part> missing, const IntInstances& world,
                           const IntInstances::Entry& entry, std::size_t k) {
  oracle::Rational sum = 0;
  for (const Part part : {Part::ray_matrix, Part::corners, Part::anchor})
    if (part != missing)
      sum += part_of_slack(part, entry.space, world.instances()[entry.instance].map, world.bits(), k);
  return static_cast<std::int64_t>(2 + oracle::ceil(sum));
}

/// Every e(entry, axis) in place of what it is.
template <class Slack>
void damage_slack(const IntInstances& world, const Slack& e) {
  for (const IntInstances::Entry& entry : world.entries()) {
    auto& slack = const_cast<IntInstances::Entry&>(entry).space.slack;
    const auto right = slack;
    for (std::size_t k = 0; k < 3; ++k) slack[k] = e(entry, k, right[k]);
  }
}

int rays_of_test(int few) {
  const char* const more = std::getenv("HITPIPE_INSTANCE_RAYS");
  return more == nullptr ? few : std::stoi(more);
}

TEST(Instances, AnswerAsTheFlattenedMesh) {
  const Judged judged = fuzz(11, rays_of_test(12'000), [](const IntInstances&) {});
  EXPECT_EQ(judged.wrong, 0U) << "of " << judged.answers << " answers";
  RecordProperty("answers", std::to_string(judged.answers));
  if (std::getenv("HITPIPE_INSTANCE_RAYS") != nullptr) {
    EXPECT_GE(judged.answers, 10'000'000U);
  }
}

TEST(Instances, MoveWithoutANewHierarchy) {
  Worlds worlds(21);
  Judged judged;
  int refused = 0;
  for (int i = 0; i < 150; ++i) {
    const WorldBits bits = worlds.bits();
    auto world = worlds.world(bits);
    if (!world) continue;
    const auto fast = std::make_shared<FastInstances>(*world, VectorWidth::best);
    const MeshCrossings crossings(fast, bits);
    const MeshCrossings boxed(*world, {bits, MajorBits{bits.coord, bits.finer, 11, 0, bits.slope}});
    for (int moves = 0; moves < 4; ++moves) {
      const auto count = static_cast<std::int64_t>(world->instances().size());
      const auto first = static_cast<std::uint32_t>(worlds.draw().integer(0, count - 1));
      const auto last = static_cast<std::uint32_t>(worlds.draw().integer(first, count - 1));
      std::vector<GridMap> maps;
      for (std::uint32_t k = first; k <= last; ++k) {
        auto map = worlds.map(world->mesh_of(k), bits);
        maps.push_back(map ? *map : world->instances()[k].map);
      }
      if (worlds.draw().one_in(8)) maps.back().move = {1 << 23, 0, 0};
      std::vector<std::uint32_t> moved;
      const std::vector<IntTriangle> before = flattened(*world);
      try {
        world->place(first, maps, moved);
      } catch (const std::out_of_range& why) {
        EXPECT_THAT(why.what(), testing::HasSubstr("instance "));
        ASSERT_EQ(flattened(*world), before);
        ++refused;
      }
      fast->follow(first, maps.size(), moved);
      const std::vector<IntTriangle> triangles = flattened(*world);
      for (int k = 0; k < 20; ++k) {
        const IntRay ray = worlds.ray(*world, triangles);
        const std::vector<Met> all = met_by(ray, 0xff, *world, triangles);
        judge(crossings, ray, 0xff, triangles, all, judged);
        judge(boxed, ray, 0xff, triangles, all, judged);
      }
    }
  }
  EXPECT_EQ(judged.wrong, 0U) << "of " << judged.answers << " answers";
  EXPECT_GT(judged.answers, 50'000U);
  EXPECT_GT(refused, 10);
}

TEST(Instances, SlackIsThatOfTheProof) {
  Worlds worlds(5);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const auto world = worlds.world(worlds.bits());
    if (!world) continue;
    for (const IntInstances::Entry& entry : world->entries())
      for (std::size_t k = 0; k < 3; ++k, ++compared)
        ASSERT_EQ(entry.space.slack[k], slack_without({}, *world, entry, k));
  }
  EXPECT_GT(compared, 1000);
}

TEST(Instances, LessSlackIsSeen) {
  const auto wrong = [](const auto& e) {
    return fuzz(12, 4'000,
                [&](const IntInstances& world) {
                  damage_slack(world, [&](const IntInstances::Entry& entry, std::size_t k,
                                          std::int64_t right) { return e(world, entry, k, right); });
                })
        .wrong;
  };
  using World = IntInstances;
  using Entry = IntInstances::Entry;
  EXPECT_EQ(wrong([](const World&, const Entry&, std::size_t, std::int64_t right) { return right; }), 0U);
  EXPECT_GT(wrong([](const World&, const Entry&, std::size_t, std::int64_t) { return 0; }), 0U);
  EXPECT_GT(wrong([](const World&, const Entry&, std::size_t, std::int64_t right) { return right * 9 / 10; }),
            0U);
  EXPECT_GT(wrong([](const World& world, const Entry& entry, std::size_t k, std::int64_t) {
              return slack_without(Part::ray_matrix, world, entry, k);
            }),
            0U);
  EXPECT_GT(wrong([](const World& world, const Entry& entry, std::size_t k, std::int64_t) {
              return slack_without(Part::corners, world, entry, k);
            }),
            0U);
}

}  // namespace
}  // namespace hitpipe::ref
