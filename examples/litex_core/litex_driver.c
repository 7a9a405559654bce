/* What driver.h wants of the platform, in a LiteX SoC: firmware takes this file, the core's header and driver.h. The
   CSRs are those of hitpipe_core.py, and the SoC calls the module `core`. */
#include <generated/csr.h>
#include <system.h>

#include "driver.h"

void bus_write(uint32_t address, uint32_t value) {
  csr_write_simple(value, address);
}

uint32_t bus_read(uint32_t address) {
  return (uint32_t)csr_read_simple(address);
}

#if CORE_HAS_RINGS
/* In words: records begin at multiples of 4. What a processor writes goes through its cache to memory. */
void memory_write(uint64_t address, const uint8_t* bytes, uint32_t count) {
  for (uint32_t i = 0; i < count; i += 4)
    csr_write_simple((uint32_t)core_get(bytes + i, 4), (uint32_t)address + i);
  flush_l2_cache();
}

void memory_read(uint64_t address, uint8_t* bytes, uint32_t count) {
  flush_cpu_dcache();
  flush_l2_cache();
  for (uint32_t i = 0; i < count; i += 4) core_put(bytes + i, 4, csr_read_simple((uint32_t)address + i));
}
#else
static int bytes_of_word(int first, int bytes) {
  return bytes - first < 4 ? bytes - first : 4;
}

bool fifo_send(uint32_t tag, const uint8_t* bytes) {
  if (!core_ray_send_read()) return false;
  for (int i = 0; i < CORE_RAY_BYTES; i += 4)
    csr_write_simple(core_get(bytes + i, bytes_of_word(i, CORE_RAY_BYTES)), CSR_CORE_RAY_0_ADDR + i);
  core_ray_tag_write(tag);
  core_ray_send_write(1);
  return true;
}

bool fifo_take(uint32_t* tag, uint8_t* bytes) {
  if (!core_hit_take_read()) return false;
  for (int i = 0; i < CORE_HIT_BYTES; i += 4)
    core_put(bytes + i, bytes_of_word(i, CORE_HIT_BYTES), csr_read_simple(CSR_CORE_HIT_0_ADDR + i));
  *tag = core_hit_tag_read();
  core_hit_take_write(1);
  return true;
}
#endif
