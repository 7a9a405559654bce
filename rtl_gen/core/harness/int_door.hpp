// Rays are given as integers.
#pragma once

#include "episode.hpp"

struct IntDoor : Episode {
  template <class Ray>
  static void spoil(Ray& ray) {
    ray.error = 1;
  }
};
