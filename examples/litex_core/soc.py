#!/usr/bin/env python3
"""A SoC with a traversal core and LiteDRAM, for simulation: SDRAM that holds a file, and a port for a host or a processor.

The Makefile beside it writes core and image, and runs the SoC with a host. That of firmware/ runs it with a processor.
"""

import argparse
import os

from litex.build.generic_platform import GenericPlatform, Pins, Subsignal
from litex.build.io import CRG
from litex.soc.integration.builder import Builder
from litex.soc.integration.common import get_mem_data
from litex.soc.integration.soc_core import SoCCore
from litex.soc.interconnect import wishbone

from litedram.modules import MT41K128M16
from litedram.phy.model import SDRAMPHYModel

from hitpipe_core import HitpipeCore


MAIN_RAM = 0x4000_0000


class Platform(GenericPlatform):
    """No board: what is built is Verilog."""

    def build(self, fragment, build_dir, build_name, **kwargs):
        os.makedirs(build_dir, exist_ok=True)
        os.chdir(build_dir)
        self.get_verilog(fragment, name=build_name).write(f"{build_name}.v")
        # What the SoC is made of besides, for Verilator.
        with open(f"{build_name}.f", "w") as file:
            file.writelines(f"{source[0]}\n" for source in self.sources)


# What RS232PHYModel of LiteX wants: a byte in each cycle with valid and ready.
SERIAL = ("serial", 0,
    Subsignal("source_valid", Pins(1)), Subsignal("source_ready", Pins(1)), Subsignal("source_data", Pins(8)),
    Subsignal("sink_valid", Pins(1)), Subsignal("sink_ready", Pins(1)), Subsignal("sink_data", Pins(8)))


class CoreSoC(SoCCore):
    def __init__(self, rtl, sdram=None, cpu=None, clk_freq=int(100e6)):
        platform = Platform(device="", io=[("clk", 0, Pins(1)), ("rst", 0, Pins(1)), SERIAL], name="core_soc")
        self.crg = CRG(platform.request("clk"), platform.request("rst"))
        if cpu:
            SoCCore.__init__(self, platform, clk_freq, cpu_type=cpu, uart_name="sim",
                integrated_rom_size=0x10000, integrated_sram_size=0x2000)
            # The BIOS initialises the SDRAM, which holds the firmware, and starts it.
            self.add_constant("SDRAM_TEST_DISABLE")
            self.add_constant("ROM_BOOT_ADDRESS", MAIN_RAM)
        else:
            SoCCore.__init__(self, platform, clk_freq, cpu_type=None, integrated_sram_size=0, with_uart=False, with_timer=False)
            # In place of a processor: a host at pins.
            host = wishbone.Interface(data_width=32, address_width=32, addressing="byte")
            platform.add_extension(host.get_ios("host"))
            self.comb += host.connect_to_pads(platform.request("host"), mode="slave")
            self.bus.add_master("host", host)

        # SDRAM, with the file in it from the beginning.
        module = MT41K128M16(clk_freq, "1:4")
        self.sdrphy = SDRAMPHYModel(module, data_width=16, clk_freq=clk_freq,
            init=get_mem_data(sdram, endianness="little") if sdram else [])
        self.add_sdram("sdram", phy=self.sdrphy, module=module, origin=MAIN_RAM, l2_cache_size=0)

        self.core = HitpipeCore(platform, rtl)
        self.core.add_to(self)


def main():
    parser = argparse.ArgumentParser(description="A SoC with a traversal core, as Verilog")
    parser.add_argument("--rtl", required=True, help="folder of `hitpipe core rtl`")
    parser.add_argument("--sdram", help="file that the SDRAM holds: an image of `hitpipe core image`, or firmware")
    parser.add_argument("--cpu", help="processor of LiteX, for example vexriscv, with LiteX's BIOS; none: a host at pins")
    parser.add_argument("--output-dir", default="build", help="folder for the Verilog, csr.csv, and what firmware includes")
    args = parser.parse_args()
    Builder(CoreSoC(args.rtl, args.sdram, args.cpu), output_dir=args.output_dir, compile_software=args.cpu is not None,
        csr_csv=os.path.join(args.output_dir, "csr.csv")).build(build_name="core_soc")


if __name__ == "__main__":
    main()
