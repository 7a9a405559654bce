#ifndef PICTURE_H
#define PICTURE_H

#include <stdbool.h>
#include <stdint.h>

/* Traces and prints it. The image is at this address for the core, and at `bytes` for the processor. A core that reads
   its rays from memory has PICTURE_RINGS_BYTES for them at the other address. false: the core cannot start, or its
   answers or counters are wrong. */
bool draw_picture(uint64_t address, uint64_t rings_address, const uint8_t* bytes, uint64_t size);

enum { PICTURE_PLACES = 64, PICTURE_RINGS_BYTES = PICTURE_PLACES * 48 };

#endif
