// Where rays come in and answers leave, and what a core has.
#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "bits.hpp"
#include "core.hpp"

#if CORE_HAS_RINGS
// In place of streams: a ray that the host writes to its ring, and an answer that it finds in the other.
struct Doors {
  bool s_axis_ray_tvalid = false, s_axis_ray_tready = false, m_axis_hit_tvalid = false,
       m_axis_hit_tready = false;
  uint32_t s_axis_ray_tid = 0, m_axis_hit_tid = 0;
  std::array<uint32_t, CORE_RAY_BYTES / 4> s_axis_ray_tdata{};
  std::array<uint32_t, CORE_HIT_BYTES / 4> m_axis_hit_tdata{};
  uint64_t stored = 0;  // answers that the memory says in this cycle that it has
};

#else
using Doors = Top;
#endif

inline core_hit hit_of(const Doors& doors) {
  uint8_t bytes[CORE_HIT_BYTES];
  get_bytes(doors.m_axis_hit_tdata, bytes, CORE_HIT_BYTES);
  core_hit hit;
  core_unpack_hit(&hit, bytes);
  return hit;
}

// A bus with one identifier has no port of it.
#if CORE_HAS_ONE_ID
inline uint32_t asked_id(const Top&) {
  return 0;
}
inline void show_id(Top&, uint32_t) {}
#else
inline uint32_t asked_id(const Top& top) {
  return top.m_axi_arid;
}
inline void show_id(Top& top, uint32_t id) {
  set(top.m_axi_rid, id);
}
#endif

constexpr int bits_of_ray_number() {
  int bits = 1;
  while ((1 << bits) < CORE_RAYS) ++bits;
  return bits;
}
constexpr uint64_t ray_numbers = uint64_t{1} << bits_of_ray_number();
// Nobody outside sees what rays ask a cache for.
constexpr bool has_cache = CORE_CACHE_KIB != 0, has_rings = CORE_HAS_RINGS != 0;
// Only the status tells when a soft reset has ended.
constexpr bool ends_unseen = has_cache || has_rings;
constexpr uint32_t first_unused_register = (std::end(register_words) - 1)->at + 4;
#if CORE_HAS_RINGS
constexpr uint32_t kept_at(uint32_t at) {
  uint32_t kept = 0;
  for (const RegisterWord& each : register_words) kept |= each.at == at ? each.kept : 0;
  return kept;
}
// Rays and answers are counted modulo a power of two.
constexpr uint32_t ring_counts = kept_at(CORE_REG_OFFERED), interrupt_enable = ring_counts + 1;
#endif
