/* In place of a processor's system.h, which LiteX's csr.h includes: loads and stores are bus cycles of
 * host.cpp. */
#ifndef SYSTEM_H
#define SYSTEM_H

#define CSR_ACCESSORS_DEFINED

#ifdef __cplusplus
extern "C" {
#endif
void csr_write_simple(unsigned long value, unsigned long address);
unsigned long csr_read_simple(unsigned long address);
/* The host has no cache. */
static inline void flush_cpu_dcache(void) {}
static inline void flush_l2_cache(void) {}
#ifdef __cplusplus
}
#endif

#endif
