/* Firmware in a LiteX SoC: draws the picture on the serial line. */
#include <generated/mem.h>
#include <irq.h>
#include <libbase/uart.h>
#include <stdio.h>
#include <system.h>

#include "driver.h"
#include "picture.h"

/* Of image.S. */
extern const uint8_t image_begin[], image_end[];

int main(void) {
  irq_setmask(0);
  irq_setie(1);
  uart_init();

  /* The core reads SDRAM behind the caches, through which a loader wrote the image. */
  flush_cpu_dcache();
  flush_l2_cache();
  const uint32_t size = (uint32_t)(image_end - image_begin);
  /* In the SDRAM's last bytes is nothing else. */
  const uint64_t rings = (uint64_t)MAIN_RAM_BASE + MAIN_RAM_SIZE - PICTURE_RINGS_BYTES;
  printf("%s\n", draw_picture((uintptr_t)image_begin, rings, image_begin, size) ? "PASS" : "FAIL");
  uart_sync();
  for (;;) {
  }
}
