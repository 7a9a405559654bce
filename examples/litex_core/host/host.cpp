// In place of a processor: the SoC as Verilator compiles it, and a bus master. It runs main.cpp of
// ../core_system, as firmware would.
#include <generated/csr.h>
#include <generated/mem.h>

#include "Vcore_soc.h"
#include "driver.h"

namespace {

class Host {
 public:
  Host() {
    top_.rst = 1;
    for (int i = 0; i < 16; ++i) tick();
    top_.rst = 0;
  }
  std::uint32_t access(bool write, std::uint32_t address, std::uint32_t value = 0) {
    top_.host_cyc = top_.host_stb = 1, top_.host_sel = 15;
    top_.host_we = write, top_.host_adr = address, top_.host_dat_w = value;
    std::uint32_t given = 0;
    for (bool acknowledged = false; !acknowledged; tick()) {
      top_.clk = 0, top_.eval();
      acknowledged = top_.host_ack, given = top_.host_dat_r;
    }
    top_.host_cyc = top_.host_stb = 0;
    tick();
    return given;
  }

 private:
  void tick() {
    top_.clk = 0, top_.eval();
    top_.clk = 1, top_.eval();
  }

  Vcore_soc top_;
};

Host host;

}  // namespace

void csr_write_simple(unsigned long value, unsigned long address) {
  host.access(true, static_cast<std::uint32_t>(address), static_cast<std::uint32_t>(value));
}

unsigned long csr_read_simple(unsigned long address) {
  return host.access(false, static_cast<std::uint32_t>(address));
}

// The model of the SDRAM holds the image already. LiteX's BIOS would initialise a real one; here the
// controller is only given its pins.
uint32_t place_image(const char*) {
  constexpr uint32_t sel = 1, cke = 2, odt = 4, reset_n = 8;
  sdram_dfii_control_write(sel | cke | odt | reset_n);
  return MAIN_RAM_BASE;
}

#if CORE_HAS_RINGS
// The end of the SDRAM.
uint32_t place_rings(uint32_t bytes) {
  return MAIN_RAM_BASE + MAIN_RAM_SIZE - bytes;
}
#endif
