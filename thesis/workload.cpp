#include "thesis/workload.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::thesis {
namespace {

using adversary::Random;

glm::vec3 point(Random& random) {
  return {random.signed_unit(), random.signed_unit(), random.signed_unit()};
}

/// A uniform point of the ball, moved out to the sphere.
glm::vec3 unit_direction(Random& random) {
  for (;;) {
    const glm::dvec3 d(point(random));
    const double length = glm::length(d);
    if (length > 0.01 && length <= 1) return glm::vec3(d / length);
  }
}

BoxPair random_pair(Random& random) {
  // The box stays inside the cube when moved by the margin.
  constexpr float range = 0.99F;
  BoxPair pair;
  pair.ray.origin = point(random);
  pair.ray.direction = unit_direction(random);
  pair.box.grow(point(random) * range);
  pair.box.grow(point(random) * range);
  return pair;
}

/// Whether the ray meets the box with every face moved by `outward`; false if nothing of the box is left.
bool meets_moved(const BoxPair& pair, float outward) {
  const Aabb moved{pair.box.min - outward, pair.box.max + outward};
  return acceptable(moved) && ray_meets_box(pair.ray, moved);
}

}  // namespace

std::vector<BoxPair> make_box_workload(std::size_t pairs, int hit_percent, std::uint64_t seed) {
  if (hit_percent < 0 || hit_percent > 100) {
    throw std::invalid_argument(fmt::format("box workload: {} % hits; allowed are 0 to 100", hit_percent));
  }
  Random random(seed);
  std::size_t hits = pairs / 100 * static_cast<std::size_t>(hit_percent) +
                     pairs % 100 * static_cast<std::size_t>(hit_percent) / 100;
  std::size_t misses = pairs - hits;
  std::vector<BoxPair> workload;
  workload.reserve(pairs);
  while (hits + misses > 0) {
    const BoxPair pair = random_pair(random);
    const bool hit = meets_moved(pair, workload_margin);
    std::size_t& wanted = hit ? hits : misses;
    if (wanted == 0 || hit != meets_moved(pair, -workload_margin)) continue;
    workload.push_back(pair);
    --wanted;
  }
  for (std::size_t i = workload.size(); i > 1; --i) std::swap(workload[i - 1], workload[random.below(i)]);
  return workload;
}

}  // namespace hitpipe::thesis
