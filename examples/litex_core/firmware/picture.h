#ifndef PICTURE_H
#define PICTURE_H

#include <stdbool.h>
#include <stdint.h>

/* Traces and prints it. The image is at this address for the core, and at `bytes` for the processor. false: the core
   cannot start, or its answers or counters are wrong. */
bool draw_picture(uint64_t address, const uint8_t* bytes, uint64_t size);

#endif
