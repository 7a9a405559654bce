/* The driver of a core, in C: six calls, or nine with rays in memory, and one that reads a counter. Copy it to firmware
   with the core's header, and supply the four functions of the platform. With -DCORE_RECORDS a host with files also
   writes down rays and answers, and `hitpipe core replay` judges them. */
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
/* The platform's. On a chip the first two are a store and a load, *(volatile uint32_t*)address. */
void bus_write(uint32_t address, uint32_t value);
uint32_t bus_read(uint32_t address);
#if CORE_HAS_RINGS
/* Of memory as the core sees it. On a chip they copy bytes, and write back or forget what a cache of the processor has. */
void memory_write(uint64_t address, const uint8_t* bytes, uint32_t count);
void memory_read(uint64_t address, uint8_t* bytes, uint32_t count);
#else
/* Of the FIFO in front of s_axis_ray and of that behind m_axis_hit; false: no room, or no answer yet. */
bool fifo_send(uint32_t tag, const uint8_t* bytes);
bool fifo_take(uint32_t* tag, uint8_t* bytes);
#endif
#ifdef __cplusplus
}
#endif

static inline void core_write(uint32_t reg, uint32_t value) {
  bus_write(CORE_REGISTERS + reg, value);
}

static inline uint32_t core_read(uint32_t reg) {
  return bus_read(CORE_REGISTERS + reg);
}

/* Says where an image is, which core_read_image() has read, and lets rays begin. It may also change the image of a
   core that has no ray. Otherwise it changes nothing, and returns why. */
static inline const char* core_start(uint64_t address, const struct core_image* image) {
  const uint64_t end = address + (uint64_t)image->blocks * CORE_BLOCK_BYTES - 1;
  if (core_read(CORE_REG_IDENTITY) != CORE_IDENTITY) return "no core answers at that address";
  if (core_read(CORE_REG_VERSION) != CORE_VERSION) return "the core has another version than its header";
  if (core_read(CORE_REG_FORMAT) != CORE_FORMAT || core_read(CORE_REG_SHAPE) != CORE_SHAPE ||
      core_read(CORE_REG_PORTS) != CORE_PORTS || core_read(CORE_REG_LIMITS) != CORE_LIMITS)
    return "the core was made with other options than its header";
  if (!(core_read(CORE_REG_STATUS) & CORE_IDLE)) return "the core has rays";
  if (address % CORE_LINE_BYTES != 0) return "the image does not begin at a multiple of 64";
  if (end < address || (CORE_ADDRESS_BITS < 64 && end >> (CORE_ADDRESS_BITS % 64) != 0))
    return "the image ends above the core's last address";
  core_write(CORE_REG_BASE_LOW, (uint32_t)address);
  core_write(CORE_REG_BASE_HIGH, (uint32_t)(address >> 32));
  core_write(CORE_REG_LAST_BLOCK, image->blocks - 1);
  core_write(CORE_REG_MOST_RAYS, CORE_RAYS);
  core_write(CORE_REG_STATUS, 0xffffffffu); /* forget what went wrong before */
  core_write(CORE_REG_CLEAR_COUNTERS, 0);
  return NULL;
}

/* Gives up all rays that are in the core: they get no answer, but one that is offered is to be taken. Call it until it
   returns true, and take answers meanwhile. Then core_start() again. */
static inline bool core_stop(void) {
  const uint32_t status = core_read(CORE_REG_STATUS);
  if (status & CORE_IDLE) return true;
  if (!(status & CORE_RESETTING)) core_write(CORE_REG_CONTROL, CORE_SOFT_RESET);
  return false;
}

#if CORE_HAS_RINGS

/* Rays in memory, and their answers: two rings. The first two are addresses. The others count rays and answers of all;
   counts go round at 2^32. `wrong` says why no further answer comes: then take those that are there, call core_stop(),
   start again, and send again the rays without an answer. NULL: nothing is wrong. */
struct core_rings {
  uint64_t rays, answers;
  uint32_t places; /* of each ring */
  uint32_t sent, offered, known, taken;
  const char* wrong;
};

static inline bool core_has_place(uint64_t address, uint64_t bytes) {
  const uint64_t end = address + bytes - 1;
  return address % CORE_RING_LINE_BYTES == 0 && end >= address &&
         (CORE_ADDRESS_BITS == 64 || end >> (CORE_ADDRESS_BITS % 64) == 0);
}

/* Says where the rings are, while the core has no ray: `places` rays of CORE_RAY_BYTES, and as many answers of
   CORE_HIT_BYTES. Otherwise it changes nothing, and returns why. */
static inline const char* core_start_rings(struct core_rings* rings, uint64_t rays, uint64_t answers,
                                           uint32_t places) {
  if (!(core_read(CORE_REG_STATUS) & CORE_IDLE)) return "the core has rays";
  if (places < 4 || places > 32768 || (places & (places - 1)) != 0)
    return "the places of a ring are not a power of two from 4 to 32768";
  if (!core_has_place(rays, (uint64_t)places * CORE_RAY_BYTES) ||
      !core_has_place(answers, (uint64_t)places * CORE_HIT_BYTES))
    return "a ring does not begin at a multiple of 128, or ends above the core's last address";
  core_write(CORE_REG_RAYS_LOW, (uint32_t)rays);
  core_write(CORE_REG_RAYS_HIGH, (uint32_t)(rays >> 32));
  core_write(CORE_REG_ANSWERS_LOW, (uint32_t)answers);
  core_write(CORE_REG_ANSWERS_HIGH, (uint32_t)(answers >> 32));
  core_write(CORE_REG_RING_LAST, places - 1);
  rings->rays = rays;
  rings->answers = answers;
  rings->places = places;
  rings->sent = rings->offered = core_read(CORE_REG_OFFERED);
  rings->known = rings->taken = core_read(CORE_REG_ANSWERED);
  rings->wrong = NULL;
  return NULL;
}

/* Writes a ray to memory. The core begins it after core_offer(). false: there is no room, so take answers first. The
   answer has the same tag, a number of CORE_TAG_BITS bits. */
static inline bool core_send(struct core_rings* rings, uint32_t tag, const struct core_ray* ray) {
  uint8_t bytes[CORE_RAY_BYTES];
  if (rings->sent - rings->taken == rings->places) return false;
  core_pack_ray(bytes, ray);
  core_put_tag(bytes, tag);
  memory_write(rings->rays + (uint64_t)(rings->sent % rings->places) * CORE_RAY_BYTES, bytes, CORE_RAY_BYTES);
  ++rings->sent;
  return true;
}

/* Tells the core of all rays that were sent. */
static inline void core_offer(struct core_rings* rings) {
  if (rings->offered == rings->sent) return;
  rings->offered = rings->sent;
  core_write(CORE_REG_OFFERED, rings->offered & 0xffff);
}

/* Answers that are in memory and were not taken. If none has come since the last call, it looks whether more will. */
static inline uint32_t core_answers(struct core_rings* rings) {
  const uint32_t more = (core_read(CORE_REG_ANSWERED) - rings->known) & 0xffff;
  rings->known += more;
  if (more == 0) {
    const uint32_t status = core_read(CORE_REG_STATUS);
    if (status & CORE_OVERFULL) rings->wrong = "more rays were offered than a ring has places";
    if (status & CORE_UNWRITTEN) rings->wrong = "an answer could not be written to memory";
  }
  return rings->known - rings->taken;
}

/* The pin irq is 1 as soon as so many more answers are in memory than were taken; 0: never. */
static inline void core_interrupt_at(const struct core_rings* rings, uint32_t answers) {
  core_write(CORE_REG_INTERRUPT, answers == 0 ? 0 : ((rings->taken + answers) & 0xffff) | 0x10000);
}

/* false: no answer yet. Answers come in any order. */
static inline bool core_take(struct core_rings* rings, uint32_t* tag, struct core_hit* hit) {
  uint8_t bytes[CORE_HIT_BYTES];
  if (rings->known == rings->taken && core_answers(rings) == 0) return false;
  memory_read(rings->answers + (uint64_t)(rings->taken % rings->places) * CORE_HIT_BYTES, bytes,
              CORE_HIT_BYTES);
  ++rings->taken;
  *tag = core_get_tag(bytes);
  core_unpack_hit(hit, bytes);
  return true;
}

#else

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

#endif

/* A counter has two words. If the high one has changed meanwhile, the low one may be of either side. */
static inline uint64_t core_count(uint32_t reg) {
  uint32_t high, low;
  do {
    high = core_read(reg + 4);
    low = core_read(reg);
  } while (high != core_read(reg + 4));
  return (uint64_t)high << 32 | low;
}

#ifdef CORE_RECORDS

#include <inttypes.h>
#include <stdio.h>

/* The first lines of a file of rays and of a file of answers. */
static inline void core_begin_records(FILE* rays, FILE* answers) {
  fputs("ox,oy,oz,dx,dy,dz,length,any\n", rays);
  fputs("ray,hit,number,t,failed\n", answers);
}

/* A ray as core_make_mesh_ray() takes it, in the mesh's own units. Numbers are hexadecimal, so none is rounded. A ray
   for count or next cannot be judged again. */
static inline void core_record_ray(FILE* rays, const double origin[3], const float direction[3], float length,
                                   bool any) {
  for (int axis = 0; axis < 3; ++axis) fprintf(rays, "%a,", origin[axis]);
  for (int axis = 0; axis < 3; ++axis) fprintf(rays, "%a,", (double)direction[axis]);
  fprintf(rays, "%a,%d\n", (double)length, any);
}

/* The answer to the ray that was recorded as number `ray`, from 0. Answers may come in any order. */
static inline void core_record_answer(FILE* answers, uint32_t ray, const struct core_hit* hit) {
  fprintf(answers, "%" PRIu32 ",", ray);
  if (hit->failed)
    fprintf(answers, ",,,%d\n", (int)hit->failed);
  else if (hit->number == CORE_NO_HIT)
    fputs("0,,,0\n", answers);
  else
    fprintf(answers, "1,%" PRIu64 ",%" PRIu64 ",0\n", (uint64_t)hit->number, (uint64_t)hit->t);
}

#endif

#endif
