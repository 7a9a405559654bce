// Where rays come in and answers leave, and whose a block is.
#pragma once

#include <cstdint>

#include "bits.hpp"
#include "core.hpp"
#include "features.hpp"

inline core_hit hit_of(const Doors& doors) {
  uint8_t bytes[CORE_HIT_BYTES];
  get_bytes(doors.m_axis_hit_tdata, bytes, CORE_HIT_BYTES);
  core_hit hit;
  core_unpack_hit(&hit, bytes);
  return hit;
}

// A bus with one identifier has no port of it.
template <class Pins>
uint32_t asked_id([[maybe_unused]] const Pins& top) {
  if constexpr (CORE_HAS_ONE_ID)
    return 0;
  else
    return top.m_axi_arid;
}
template <class Pins>
void show_id([[maybe_unused]] Pins& top, [[maybe_unused]] uint32_t id) {
  if constexpr (!CORE_HAS_ONE_ID) set(top.m_axi_rid, id);
}

constexpr int bits_of_ray_number() {
  int bits = 1;
  while ((1 << bits) < CORE_RAYS) ++bits;
  return bits;
}
constexpr uint64_t ray_numbers = uint64_t{1} << bits_of_ray_number();
// Only the status tells when a soft reset has ended.
constexpr bool ends_unseen = Episodes::hides_requests || Episodes::hides_rays;
