#!/usr/bin/env python3
"""A SoC with a traversal core and LiteDRAM, for simulation: SDRAM that holds an image, and a port for a host.

The Makefile beside it writes core and image, and runs the SoC.
"""

import argparse
import os

from litex.build.generic_platform import GenericPlatform, Pins
from litex.build.io import CRG
from litex.soc.integration.builder import Builder
from litex.soc.integration.common import get_mem_data
from litex.soc.integration.soc_core import SoCMini
from litex.soc.interconnect import wishbone

from litedram.modules import MT41K128M16
from litedram.phy.model import SDRAMPHYModel

from hitpipe_core import HitpipeCore


class Platform(GenericPlatform):
    """No board: what is built is Verilog."""

    def build(self, fragment, build_dir, build_name, **kwargs):
        os.makedirs(build_dir, exist_ok=True)
        os.chdir(build_dir)
        self.get_verilog(fragment, name=build_name).write(f"{build_name}.v")


class CoreSoC(SoCMini):
    def __init__(self, rtl, image, clk_freq=int(100e6)):
        platform = Platform(device="", io=[("clk", 0, Pins(1)), ("rst", 0, Pins(1))], name="core_soc")
        self.crg = CRG(platform.request("clk"), platform.request("rst"))
        SoCMini.__init__(self, platform, clk_freq)

        # In place of a processor: a host at pins. A SoC with one takes its own base class and loses these lines.
        host = wishbone.Interface(data_width=32, address_width=32, addressing="byte")
        platform.add_extension(host.get_ios("host"))
        self.comb += host.connect_to_pads(platform.request("host"), mode="slave")
        self.bus.add_master("host", host)

        # SDRAM, with the image in it from the beginning.
        module = MT41K128M16(clk_freq, "1:4")
        self.sdrphy = SDRAMPHYModel(module, data_width=16, clk_freq=clk_freq,
            init=get_mem_data(image, endianness="little"))
        self.add_sdram("sdram", phy=self.sdrphy, module=module, origin=0x4000_0000, l2_cache_size=0)

        self.core = HitpipeCore(platform, rtl)
        self.core.add_to(self)


def main():
    parser = argparse.ArgumentParser(description="A SoC with a traversal core, as Verilog")
    parser.add_argument("--rtl", required=True, help="folder of `hitpipe rtl core`")
    parser.add_argument("--image", required=True, help="file of `hitpipe image`")
    parser.add_argument("--output-dir", default="build", help="folder for the Verilog and csr.csv")
    args = parser.parse_args()
    Builder(CoreSoC(args.rtl, args.image), output_dir=args.output_dir, compile_software=False,
        csr_csv=os.path.join(args.output_dir, "csr.csv")).build(build_name="core_soc")


if __name__ == "__main__":
    main()
