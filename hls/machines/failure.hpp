// Why a core has no answer for a ray (docs/core.md).
#pragma once

#include <array>
#include <cstdint>

namespace hitpipe {
namespace hls {

/// 4 and 5: the ray is lost.
enum Failure : std::uint8_t {
  not_failed,
  no_ray,
  too_many_steps,
  too_many_levels,
  outside_image,
  unread_block
};
constexpr int failure_bits = 3;

/// What a ray is lost by, in two bits: the upper one says that it is lost. The lower one is that of the failure.
enum Lost : std::uint8_t { not_lost = 0, lost_outside = 2, lost_unread = 3 };
constexpr int lost_bits = 2;

/// In the order of the enumeration.
inline constexpr std::array<const char*, 6> failure_texts{
    "it has not failed",
    "it is no ray",
    "it tested as many records as a ray may",
    "it went below the last level of the core",
    "it was led out of the image",
    "a block could not be read, or is none of this image",
};

}  // namespace hls
}  // namespace hitpipe
