// Rays and answers are at pins.
#pragma once

#include "core.hpp"
#include "episode.hpp"

using Doors = Top;

struct Streams : Episode {
  static Doors& doors(Top& top) { return top; }
};
using DoorsOwner = Streams;
