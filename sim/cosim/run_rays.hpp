// The loop of every co-simulation: many rays go through parts that answer later, and their answers steer the rays.
#pragma once

#include <cstddef>
#include <vector>

namespace hitpipe::sim {

/// `world` has a place for each of so many rays in flight, and
///   start(place, job)  a ray starts there
///   done(place)        whether it has ended
///   ask(place)         puts the ray's next question to a part
///   cycle(answered)    is one cycle of all parts, and calls answered(place) after each answer
///   idle()             whether no question waits for an answer
/// next() gives a job, or nothing when there is none yet; ended(place) may make more of them.
template <class World, class Next, class Ended>
void run_rays(World& world, std::size_t places, const Next& next, const Ended& ended) {
  std::vector<std::size_t> free;
  for (std::size_t place = places; place-- > 0;) free.push_back(place);
  const auto fill = [&] {
    while (!free.empty()) {
      const auto job = next();
      if (!job) return;
      const std::size_t place = free.back();
      world.start(place, *job);
      if (world.done(place)) {
        ended(place);
        continue;
      }
      free.pop_back();
      world.ask(place);
    }
  };
  const auto answered = [&](std::size_t place) {
    if (!world.done(place)) {
      world.ask(place);
      return;
    }
    ended(place);
    free.push_back(place);
    fill();
  };
  fill();
  while (!world.idle()) world.cycle(answered);
}

}  // namespace hitpipe::sim
