// Rays are given as integers.
#pragma once

#include "episode.hpp"

struct IntDoor : Episode {
  static void spoil(core_ray& ray) { ray.error = 1; }
};
