#ifndef PICTURE_H
#define PICTURE_H

#include <stdbool.h>
#include <stdint.h>

/* Traces and prints it. false: there is no core, or its answers or counters are wrong. */
bool draw_picture(uint64_t image, uint32_t blocks);

#endif
