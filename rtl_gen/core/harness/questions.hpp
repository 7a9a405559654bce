// Rays may ask for their crossings.
#pragma once

#include "episode.hpp"

struct Questions : Episode {
  static bool asks_crossings(const core_ray& ray) { return ray.once != 0; }
};
