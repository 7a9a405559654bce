#!/usr/bin/env python3
"""Makes docs/measured/core_fit.md again: docs/core_fit.py [PROGRAM]. It takes half an hour, Yosys and nextpnr-ice40."""
import json
import pathlib
import subprocess
import sys
import tempfile

page = pathlib.Path(__file__).parent / "measured/core_fit.md"
program = sys.argv[1] if len(sys.argv) > 1 else "build/hitpipe"
SCENES = ["spheres", "statue", "terrain", "plant_front", "city", "reading_room"]
# What is fixed on each chip, what is counted there, and the core that the fitted ones are compared with.
CHIPS = {
    "xc7": (["--rays", "32", "--triangle-ii", "8"], "luts", ["--rays", "32", "--triangle-ii", "8"]),
    "ice40_up5k": (["--bits", "12+0s12"], "logic_cells",
                   ["--bits", "12+0/7s12", "--rays", "2", "--stack", "2", "--levels", "24", "--triangle-ii", "serial", "--clock-ps", "70000",
                    "--block-bits", "16", "--address-bits", "21", "--tag-bits", "8", "--block-rams", "30"]),
}


def run(*command):
    with tempfile.TemporaryDirectory() as folder:
        answer = subprocess.run([program, "core", *command, "--out", folder, "--format", "json"], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)
    # A core that does not fit the chip is a result.
    return json.loads(answer.stdout) if answer.stdout else answer.stderr.strip().splitlines()[-1].removeprefix("hitpipe: ")


def boxes(bits):
    """What follows n+g of a format: 20+1/11s20 gives /11."""
    return bits[bits.index("/"):bits.index("s")]


rows = []
for chip, (fixed, counted, usual) in CHIPS.items():
    before = run("implement", *usual, "--target", chip)[0][counted]
    rows.append(f"| {chip} | without a fit | {CHIPS[chip][2][1] if chip != 'xc7' else '20+1/11s20'} | | | | {before:,} | | | |\n")
    for scene in SCENES:
        fit = run("fit", "--scene", scene, *fixed, "--target", chip)
        if isinstance(fit, str):
            rows.append(f"| {chip} | {scene} | {fit} | | | | | | | |\n")
            continue
        core, traced, taken = fit["fitted"], fit["scenes"][0], fit["mapped"][counted]
        rows.append(f"| {chip} | {scene} | {core['bits']} | {core['stack']} | {core['levels']} | {core['block_bits']} / {core['number_bits']} | "
                    f"{taken:,} | {100 * (taken - before) / before:+.1f} | {traced['other_triangles_pct']:.3f} ({traced['other_triangles_pct_low']:.3f} to {traced['other_triangles_pct_high']:.3f}) | "
                    f"{traced['wrong']} |\n")
page.write_text("""# Cores that are fitted to scenes

By `docs/core_fit.py`, from `hitpipe core fit --scene SCENE` with `--target xc7 --rays 32 --triangle-ii 8`, and
with `--target ice40_up5k --bits 12+0s12`. Sizes are mapped: LUTs, and packed logic cells. *other* is the percent of
rays that find another triangle than in floats, with Wilson's 95 % interval.

| chip | scene | bits | stack | levels | bits of blocks / numbers | size | % | other | wrong |
|---|---|---|--:|--:|--:|--:|--:|--:|--:|
""" + "".join(rows))
