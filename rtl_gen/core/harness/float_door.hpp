// Rays are given as floats.
#pragma once

#include "episode.hpp"

struct FloatDoor : Episode {
  static void spoil(core_ray& ray) { ray.dx = ray.dy = ray.dz = 0; }
};
