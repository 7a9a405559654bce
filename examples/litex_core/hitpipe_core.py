"""A traversal core of hitpipe in a LiteX SoC. `hitpipe core rtl --door float --out FOLDER` writes what it needs."""

import json
from pathlib import Path

from migen import ClockSignal, Instance, ResetSignal

from litex.gen import LiteXModule
from litex.soc.integration.soc import SoCRegion
from litex.soc.interconnect import axi, stream
from litex.soc.interconnect.csr import CSR, CSRStatus, CSRStorage
from litex.soc.interconnect.csr_eventmanager import EventManager, EventSourceLevel


class HitpipeCore(LiteXModule):
    """Registers are a slave of the bus, reads are a master, and rays and answers pass FIFOs that have CSRs.

    registers   AXI4-Lite, 32 bits: for soc.bus.add_slave()
    memory      AXI4, reads only, as wide as the core: for soc.bus.add_master() or a port of LiteDRAM

    A core with --rings reads its rays from memory and writes the answers there. It has no FIFOs and no CSRs of its own:

    rings       AXI4, another master, of 64 or 128 bits
    ev          an event: so many answers are in memory as the register says

    CSRs        ray_0, ray_1, ...  a ray as core_pack_ray() of the core's header makes it, a word each, the lowest first
                ray_tag            its tag
                ray_send           a write sends it. Reads 1: there is room
                hit_0, hit_1, ...  the oldest answer, for core_unpack_hit()
                hit_tag            its tag
                hit_take           a write goes on to the next one. Reads 1: there is an answer
    """

    def __init__(self, platform, rtl, fifo_depth=16):
        rtl = Path(rtl).resolve()
        manifests = [json.loads(file.read_text()) for file in sorted(rtl.glob("*.json"))]
        cores = [manifest for manifest in manifests if "axi" in manifest]
        if len(cores) != 1:
            raise ValueError(f"{rtl}: has {len(cores)} manifests of cores; a folder of `hitpipe core rtl` has one")
        manifest = cores[0]
        core_axi = manifest["axi"]
        if not core_axi["has_one_id"]:
            # LiteDRAM and the adapters of the bus answer in the order of requests, so identifiers buy nothing.
            raise ValueError(f"{rtl}: write the core with --in-order")
        for source in (manifest["module"] + ".v", core_axi["verilog"]):
            platform.add_source(str(rtl / source))

        self.registers = registers = axi.AXILiteInterface(data_width=32, address_width=32)
        self.memory = memory = axi.AXIInterface(data_width=core_axi["data_bits"], address_width=32, mode="r")

        ports = self.add_rings(core_axi["ring_bits"]) if manifest["rings"] else self.add_fifos(manifest, fifo_depth)
        self.specials += Instance(core_axi["module"],
            i_aclk    = ClockSignal("sys"),
            i_aresetn = ~ResetSignal("sys"),
            # Registers.
            i_s_axi_awvalid = registers.aw.valid,
            o_s_axi_awready = registers.aw.ready,
            i_s_axi_awaddr  = registers.aw.addr[:8],
            i_s_axi_wvalid  = registers.w.valid,
            o_s_axi_wready  = registers.w.ready,
            i_s_axi_wdata   = registers.w.data,
            i_s_axi_wstrb   = registers.w.strb,
            o_s_axi_bvalid  = registers.b.valid,
            i_s_axi_bready  = registers.b.ready,
            o_s_axi_bresp   = registers.b.resp,
            i_s_axi_arvalid = registers.ar.valid,
            o_s_axi_arready = registers.ar.ready,
            i_s_axi_araddr  = registers.ar.addr[:8],
            o_s_axi_rvalid  = registers.r.valid,
            i_s_axi_rready  = registers.r.ready,
            o_s_axi_rdata   = registers.r.data,
            o_s_axi_rresp   = registers.r.resp,
            # Memory.
            o_m_axi_arvalid = memory.ar.valid,
            i_m_axi_arready = memory.ar.ready,
            o_m_axi_araddr  = memory.ar.addr,
            o_m_axi_arlen   = memory.ar.len,
            o_m_axi_arsize  = memory.ar.size,
            o_m_axi_arburst = memory.ar.burst,
            o_m_axi_arcache = memory.ar.cache,
            o_m_axi_arprot  = memory.ar.prot,
            i_m_axi_rvalid  = memory.r.valid,
            o_m_axi_rready  = memory.r.ready,
            i_m_axi_rdata   = memory.r.data,
            i_m_axi_rresp   = memory.r.resp,
            i_m_axi_rlast   = memory.r.last,
            **ports,
        )

    def add_fifos(self, manifest, fifo_depth):
        """FIFOs with CSRs. Returns what the core's streams are joined to."""
        tag_bits = manifest["tag_bits"]
        ray_bits = manifest["axi"]["s_axis_ray"]["tdata_bits"]
        hit_bits = manifest["axi"]["m_axis_hit"]["tdata_bits"]
        # FIFOs, so that software need not come in every cycle.
        self.rays = rays = stream.SyncFIFO([("data", ray_bits), ("tag", tag_bits)], fifo_depth)
        self.hits = hits = stream.SyncFIFO([("data", hit_bits), ("tag", tag_bits)], fifo_depth)

        # CSRs. A ray and an answer have more bits than a word; each word has its own CSR.
        for first in range(0, ray_bits, 32):
            word = CSRStorage(min(32, ray_bits - first), name=f"ray_{first // 32}")
            setattr(self, f"ray_{first // 32}", word)
            self.comb += rays.sink.data[first:first + 32].eq(word.storage)
        for first in range(0, hit_bits, 32):
            word = CSRStatus(min(32, hit_bits - first), name=f"hit_{first // 32}")
            setattr(self, f"hit_{first // 32}", word)
            self.comb += word.status.eq(hits.source.data[first:first + 32])
        self.ray_tag = CSRStorage(tag_bits)
        self.ray_send = CSR()
        self.hit_tag = CSRStatus(tag_bits)
        self.hit_take = CSR()
        self.comb += [
            rays.sink.tag.eq(self.ray_tag.storage),
            rays.sink.valid.eq(self.ray_send.re),
            self.ray_send.w.eq(rays.sink.ready),
            self.hit_tag.status.eq(hits.source.tag),
            hits.source.ready.eq(self.hit_take.re),
            self.hit_take.w.eq(hits.source.valid),
        ]
        return dict(
            i_s_axis_ray_tvalid = rays.source.valid,
            o_s_axis_ray_tready = rays.source.ready,
            i_s_axis_ray_tdata  = rays.source.data,
            i_s_axis_ray_tid    = rays.source.tag,
            o_m_axis_hit_tvalid = hits.sink.valid,
            i_m_axis_hit_tready = hits.sink.ready,
            o_m_axis_hit_tdata  = hits.sink.data,
            o_m_axis_hit_tid    = hits.sink.tag,
        )

    def add_rings(self, ring_bits):
        """The port to rays and answers in memory. Returns what the core's port is joined to."""
        self.rings = rings = axi.AXIInterface(data_width=ring_bits, address_width=32, mode="rw")
        self.ev = EventManager()
        self.ev.answers = EventSourceLevel()
        self.ev.finalize()
        ports = dict(o_irq=self.ev.answers.trigger)
        fields = ["addr", "len", "size", "burst", "cache", "prot"]
        for channel, names, from_core in (("ar", fields, True), ("r", ["data", "resp", "last"], False), ("aw", fields, True),
                                          ("w", ["data", "strb", "last"], True), ("b", ["resp"], False)):
            signals = getattr(rings, channel)
            given, taken = ("o", "i") if from_core else ("i", "o")
            ports[f"{given}_m_axi_ring_{channel}valid"] = signals.valid
            ports[f"{taken}_m_axi_ring_{channel}ready"] = signals.ready
            for name in names:
                ports[f"{given}_m_axi_ring_{channel}{name}"] = getattr(signals, name)
        return ports

    def add_to(self, soc, name="core", origin=0x8000_0000):
        """Gives the registers a region, and the core its own ports of LiteDRAM if the SoC has one, else the bus."""
        soc.bus.add_slave(name, self.registers, SoCRegion(origin=origin, size=0x100, cached=False))
        masters = [("", "read", self.memory)]
        if hasattr(self, "rings"):
            masters.append(("_rings", "both", self.rings))
            if soc.irq.enabled:
                soc.irq.add(name)
        for suffix, mode, master in masters:
            if not hasattr(soc, "sdram"):
                soc.bus.add_master(name + suffix, master)
                continue
            from litedram.frontend.axi import LiteDRAMAXI2Native
            setattr(self, "port" + suffix, LiteDRAMAXI2Native(
                axi          = master,
                port         = soc.sdram.crossbar.get_port(mode=mode, data_width=master.data_width),
                base_address = soc.bus.regions["main_ram"].origin,
            ))
