/* The image is a part of the firmware, so whatever loads the firmware into SDRAM loads both. */
  .section .rodata.image, "a"
  .balign 64 /* CORE_LINE_BYTES */
  .global image_begin
image_begin:
  .incbin IMAGE
  .global image_end
image_end:
