// Answers have the numbers of which weights are made.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core.hpp"
#include "episode.hpp"

struct Weights : Episode {
  static constexpr size_t numbers = 6;  // |det|, |u| and |v| of a hit, the high half first

  static bool is_answer(const core_hit& hit, const uint64_t* sizes) {
    return is_size(hit.det_high, hit.det_low, det_low_bits, sizes) &&
           is_size(hit.u_high, hit.u_low, edge_low_bits, sizes + 2) &&
           is_size(hit.v_high, hit.v_low, edge_low_bits, sizes + 4);
  }

 private:
  // A number with a sign in two halves has that size.
  static bool is_size(int64_t high, uint64_t low, int low_bits, const uint64_t* size) {
    const uint64_t mask = (uint64_t{1} << low_bits) - 1;
    if (high < 0) {
      low = (~low + 1) & mask;
      high = low == 0 ? -high : ~high;
    }
    return static_cast<uint64_t>(high) == size[0] && low == size[1];
  }
};
