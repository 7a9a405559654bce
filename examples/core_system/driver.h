/* The driver of a core, in C: five calls, and one that reads a counter. Copy it to firmware with the
   core's header, and supply the four functions of the platform. */
#ifndef DRIVER_H
#define DRIVER_H

#include <stdbool.h>
#include <stddef.h>

#ifndef CORE_HEADER
#define CORE_HEADER "hitpipe_core.h" /* of a core with another name: -DCORE_HEADER='"NAME.h"' */
#endif
#include CORE_HEADER

#define CORE_REGISTERS 0x80000000u /* where the core's registers are on the bus */

#ifdef __cplusplus
extern "C" {
#endif
/* The platform's. On a chip the first two are a store and a load, *(volatile uint32_t*)address. The others
   are for the FIFO or DMA in front of s_axis_ray and that behind m_axis_hit; false: no room, or no answer
   yet. */
void bus_write(uint32_t address, uint32_t value);
uint32_t bus_read(uint32_t address);
bool fifo_send(uint32_t tag, const uint8_t* bytes);
bool fifo_take(uint32_t* tag, uint8_t* bytes);
#ifdef __cplusplus
}
#endif

static inline void core_write(uint32_t reg, uint32_t value) {
  bus_write(CORE_REGISTERS + reg, value);
}

static inline uint32_t core_read(uint32_t reg) {
  return bus_read(CORE_REGISTERS + reg);
}

/* Says where the image is, and lets rays begin. Otherwise it changes nothing, and returns why. */
static inline const char* core_start(uint64_t image, uint64_t blocks) {
  const uint64_t bytes = blocks * CORE_BLOCK_BYTES;
  if (core_read(CORE_REG_IDENTITY) != CORE_IDENTITY) return "no core answers at that address";
  if (core_read(CORE_REG_VERSION) != CORE_VERSION) return "the core has another version than its header";
  if (image % CORE_BLOCK_BYTES != 0) return "the image does not begin at a multiple of 32";
  if (blocks == 0) return "the image has no block";
  if ((blocks - 1) >> CORE_BLOCK_BITS != 0) return "the image has more blocks than the core can name";
  if (CORE_ADDRESS_BITS < 64 && (image + bytes - 1) >> (CORE_ADDRESS_BITS % 64) != 0)
    return "the image ends above the core's last address";
  core_write(CORE_REG_BASE_LOW, (uint32_t)image);
  core_write(CORE_REG_BASE_HIGH, (uint32_t)(image >> 32));
  core_write(CORE_REG_LAST_BLOCK, (uint32_t)(blocks - 1));
  core_write(CORE_REG_MOST_RAYS, CORE_RAYS);
  core_write(CORE_REG_CLEAR_COUNTERS, 0);
  return NULL;
}

/* false: try again later. The answer has the same tag, a number of CORE_TAG_BITS bits. */
static inline bool core_send(uint32_t tag, const struct core_ray* ray) {
  uint8_t bytes[CORE_RAY_BYTES];
  core_pack_ray(bytes, ray);
  return fifo_send(tag, bytes);
}

/* false: no answer yet. Answers come in any order. */
static inline bool core_take(uint32_t* tag, struct core_hit* hit) {
  uint8_t bytes[CORE_HIT_BYTES];
  if (!fifo_take(tag, bytes)) return false;
  core_unpack_hit(hit, bytes);
  return true;
}

/* A counter has two words. If the high one has changed meanwhile, the low one may be of either side. */
static inline uint64_t core_count(uint32_t reg) {
  uint32_t high, low;
  do {
    high = core_read(reg + 4);
    low = core_read(reg);
  } while (high != core_read(reg + 4));
  return (uint64_t)high << 32 | low;
}

#endif
