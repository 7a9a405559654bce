// A case moved towards the middle of the cube, where coarser axes stay on the grid.
#pragma once

#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::ref::adversary {

/// The case at half its size. The direction stays, because it may be the smallest possible.
[[nodiscard]] inline Case halved(Case c) {
  c.ray.origin *= 0.5F;
  c.ray.length *= 0.5F;
  c.box.min *= 0.5F;
  c.box.max *= 0.5F;
  return c;
}

}  // namespace hitpipe::ref::adversary
