"""What a report tells of the core: a small picture of the scene, traced cycle by cycle."""
from __future__ import annotations

from collections.abc import Sequence

from diagrams import lines_picture
from plots import Picture
from tables import Row

MOST_PIXELS = 32  # of the longer side, so that all results of a usual scene are there in a minute
USUAL = {"bits": "20+1s20", "triangle_ii": "4", "memory": "ideal", "latency": "100", "cache_kib": "0"}
CACHES = ("0", "4", "16", "64")
MEMORIES = {"dram": "256", "litedram-128": "128", "axi-256": "256"}  # with the width of their bus
SHOWN = ("bits triangle_ii memory latency cache_kib rays_in_flight wrong bytes_a_ray cycles_a_ray mrays_s "
         "port_busy_pct triangle_busy_pct cache_hits_pct").split()


def settings() -> list[tuple[dict[str, str], str]]:
    """Each core and memory once, with its numbers of rays in flight."""
    made = [({**USUAL, "bits": bits, "triangle_ii": ii}, "32,128") for bits in ("16+1s16", "20+1s20")
            for ii in ("4", "8", "16") if (bits, ii) != ("20+1s20", "4")]
    made += [({**USUAL, "latency": latency}, "8,16,32,64,128,192,256") for latency in ("20", "100", "200")]
    made += [({**USUAL, "cache_kib": cache}, "128") for cache in CACHES[1:]]
    made += [({**USUAL, "memory": memory, "latency": "", "cache_kib": cache}, "32") for memory in MEMORIES
             for cache in CACHES]
    return made


def commands(view: Sequence[str], library: Sequence[str], width: int, height: int) -> list[list[str]]:
    """They trace with these settings."""
    scale = min(1.0, MOST_PIXELS / max(width, height))
    made = []
    for of, rays in settings():
        memory = f"ideal,latency={of['latency']}" if of["memory"] == "ideal" else of["memory"]
        bus = MEMORIES.get(of["memory"], "256")
        made.append(["core", "trace", "--native", *view, "--width", str(max(1, round(width * scale))), "--height",
                     str(max(1, round(height * scale))), "--bits", of["bits"], "--triangle-ii", of["triangle_ii"],
                     "--rays-in-flight", rays, "--memory", memory, *([] if bus == "256" else ["--data-bits", bus]),
                     *([] if of["cache_kib"] == "0" else ["--cache", of["cache_kib"]]), *library])
    return made


def area_settings() -> list[dict[str, str]]:
    """The cores of the diagram of rates."""
    return [{"core_bits": bits, "triangle_ii": ii, "rays_in_flight": rays} for bits in ("16+1s16", "20+1s20")
            for ii in ("4", "8", "16") for rays in ("32", "128")]


def area_commands(library: Sequence[str]) -> list[list[str]]:
    """They price these cores."""
    return [["core", "area", "--bits", of["core_bits"].replace("s", "/11s"), "--triangle-ii", of["triangle_ii"],
             "--rays", of["rays_in_flight"], *library] for of in area_settings()]


def pictures(scene: str, rows: Sequence[Row], areas: Sequence[Row], width_mm: float | None) -> list[Picture]:
    """Rays a second by area, the port by rays in flight, what a cache saves, and memories."""
    def chosen(**fixed: str) -> list[Row]:
        return [row for row in rows if all(row[k] == v for k, v in {**USUAL, **fixed}.items())]

    column = "area_mm2" if "area_mm2" in areas[0] else "lut"
    whole = [row for row in areas if row["part"] in ("core", "all", "whole", "sum")]
    rates: dict[str, list[tuple[float, float]]] = {}
    for area in whole:
        traced = [r for r in chosen(bits=area["core_bits"], triangle_ii=area["triangle_ii"])
                  if r["rays_in_flight"] == area["rays_in_flight"]]
        rates.setdefault(f"{area['core_bits']}, {area['rays_in_flight']} rays", []).append(
            (float(area[column]), float(traced[0]["mrays_s"])))
    busy = {f"latency of {latency} cycles": sorted((int(r["rays_in_flight"]), float(r["port_busy_pct"]))
                                                   for r in chosen(latency=latency))
            for latency in ("20", "100", "200")}
    cache = {"128 rays in flight": [(i, float(r["bytes_a_ray"])) for i, kib in enumerate(CACHES)
                                    for r in chosen(cache_kib=kib) if r["rays_in_flight"] == "128"]}
    behind = {memory: [(i, float(r["mrays_s"])) for i, kib in enumerate(CACHES)
                       for r in chosen(memory=memory, latency="", cache_kib=kib)] for memory in MEMORIES}
    kib = ["none", *(f"{c} KiB" for c in CACHES[1:])]

    def drawn(name: str, title: str, x: str, y: str, lines: dict[str, list[tuple[float, float]]],
              ticks: Sequence[str] | None = None, axis: str = "") -> Picture:
        return lines_picture(name, f"{scene}: {title}", (x, y), {k: sorted(v) for k, v in lines.items()},
                             {line: i for i, line in enumerate(lines)}, width_mm, ticks, axis)

    return [drawn("core_rate", "rays a second and area of a core",
                  "logic of the core, mm²" if column == "area_mm2" else "lookup tables of the core",
                  "rays a second, millions", rates, axis="log"),
            drawn("core_busy", "the memory port of a core and rays in flight", "rays in flight",
                  "cycles with a request, %", busy, axis="pct-log2"),
            drawn("core_cache", "what a cache saves", "cache", "bytes that a ray reads from memory", cache, kib),
            drawn("core_memory", "rays a second of a core by cache and memory", "cache", "rays a second, millions",
                  behind, kib)]
