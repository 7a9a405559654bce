# The firmware of examples/litex_core compiles for the processor that it is for. In place of what LiteX and its C library would generate
# there are headers of the same names.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
find_program(CLANG clang)
if(NOT CLANG)
  message("SKIP: there is no clang")
  return()
endif()
file(REMOVE_RECURSE ${WORK})
set(headers ${WORK}/include)
file(WRITE ${headers}/string.h "#include <stddef.h>\nvoid* memcpy(void*, const void*, size_t);\nvoid* memset(void*, int, size_t);\nint memcmp(const void*, const void*, size_t);\n")
file(WRITE ${headers}/stdio.h "int printf(const char*, ...);\n")
file(WRITE ${headers}/irq.h "void irq_setmask(unsigned int);\nvoid irq_setie(unsigned int);\n")
file(WRITE ${headers}/system.h "void flush_cpu_dcache(void);\nvoid flush_l2_cache(void);\n")
file(WRITE ${headers}/libbase/uart.h "void uart_init(void);\nvoid uart_sync(void);\n")
file(WRITE ${headers}/generated/csr.h "#include <stdint.h>
#define CSR_CORE_RAY_0_ADDR 0xf0000000ul
#define CSR_CORE_HIT_0_ADDR 0xf0000040ul
void csr_write_simple(unsigned long value, unsigned long address);
unsigned long csr_read_simple(unsigned long address);
void core_ray_tag_write(uint32_t);
void core_ray_send_write(uint32_t);
uint32_t core_ray_send_read(void);
uint32_t core_hit_tag_read(void);
void core_hit_take_write(uint32_t);
uint32_t core_hit_take_read(void);
")
file(WRITE ${headers}/generated/mem.h "#define MAIN_RAM_BASE 0x40000000ul\n#define MAIN_RAM_SIZE 0x10000000ul\n")
file(WRITE ${WORK}/image.bin "32 bytes, a block of an image...")

set(example ${SOURCE}/examples/litex_core)
foreach(core fifos rings)
  set(options "")
  if(core STREQUAL rings)
    set(options --rings)
  endif()
  run(${PREFIX}/bin/hitpipe core rtl --bits 16+1/9s16 --door float --in-order ${options} --name hitpipe_core --out ${WORK}/${core})
  foreach(source firmware/main.c firmware/picture.c firmware/image.S litex_driver.c)
    get_filename_component(name ${source} NAME)
    run(${CLANG} --target=riscv32 -march=rv32im -mabi=ilp32 -std=gnu99 -ffreestanding -Os -Wall -Wextra -Wpedantic -Werror
        -Wstrict-prototypes "-DIMAGE=\"${WORK}/image.bin\"" -I${headers} -I${WORK}/${core}
        -I${SOURCE}/examples/core_system -c ${example}/${source} -o ${WORK}/${name}.o)
  endforeach()
endforeach()
