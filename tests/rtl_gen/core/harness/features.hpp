// In place of the features of a core: all of them.
#pragma once

#include "rtl_gen/core/harness/cache.hpp"
#include "rtl_gen/core/harness/episode.hpp"
#include "rtl_gen/core/harness/float_door.hpp"
#include "rtl_gen/core/harness/questions.hpp"
#include "rtl_gen/core/harness/rings.hpp"
#include "rtl_gen/core/harness/weights.hpp"

using Episodes = EpisodesOf<FloatDoor, Cache, Rings, Weights, Questions>;
