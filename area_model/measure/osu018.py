"""Synthesis and timing in OSU 0.18 um standard cells: Yosys with ABC, then OpenSTA on the netlist.

Both run at the library's only corner (typical, 1.8 V, 25 C), with ideal clock and wires without load. A path
counts from register to register: clock to output, logic, set-up.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

CELLS = Path("/usr/share/qflow/tech/osu018/osu018_stdcells.lib")
PACKAGES = {"yosys": "yosys", "berkeley-abc": "berkeley-abc", "sta": "opensta", str(CELLS): "qflow-tech-osu018"}

# The recipes of ABC. `timed` is Yosys's own without `dc2` and its companions, which turn carry trees into chains;
# then nets with many readers get buffers and cells their size. `small` is Yosys's own: no buffers, no sizes.
TIMED = "+strash;&get,-n;&dch,-f;&nf;&put;buffer,-c;upsize;dnsize"
# What ABC supposes at its borders, which are the registers.
CONSTRAINTS = "set_driving_cell BUFX2\nset_load 0.009 [all_outputs]\n"  # pF, the data pin of a register
RECIPES = ("timed", "small")


def fail(message):
    """Asked wrongly, or a tool or file is not there."""
    print(f"{Path(sys.argv[0]).stem}: {message}", file=sys.stderr)
    sys.exit(2)


def missing():
    """One line that names what to install, or nothing."""
    absent = [package for tool, package in PACKAGES.items() if not (shutil.which(tool) or Path(tool).is_file())]
    return f"apt-get install {' '.join(absent)}" if absent else ""


def versions():
    """`package version` of each tool."""
    found = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version}\n", *PACKAGES.values()],
                           capture_output=True, text=True, check=False).stdout
    return sorted(found.split("\n")[:-1])


def run(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        fail(f"{command[0]}: {(done.stderr or done.stdout).strip()[-2000:]}")
    return done.stdout


def synthesise(folder, verilog, top, tied=(), recipe="timed"):
    """Maps `top` of the file `verilog`. Returns area in um2 and registers; the netlist is folder/netlist.v.

    `tied` are inputs that are held at 1.
    """
    folder = Path(folder)
    (folder / "constraints").write_text(CONSTRAINTS)
    abc = f"abc -liberty {CELLS}" + (f" -constr constraints -script {TIMED}" if recipe == "timed" else "")
    ties = "".join(f"connect -set {port} 1'b1\n" for port in tied)
    (folder / "synthesis.ys").write_text(
        f"read_verilog {verilog}\nhierarchy -check -top {top}\nproc\nflatten\n{ties}synth -flatten -top {top}\n"
        f"dfflibmap -liberty {CELLS}\n{abc}\nopt_clean\ntee -o stat stat -liberty {CELLS}\n"
        f"write_verilog -noattr netlist.v\n")
    run(["yosys", "-q", "synthesis.ys"], folder)
    stat = (folder / "stat").read_text()
    area = round(float(re.search(r"Chip area for module .*: ([0-9.]+)", stat)[1]))
    return area, sum(int(n) for n in re.findall(r"DFF\w+ +(\d+)", stat))


def period_ps(folder, top):
    """The smallest clock period that the netlist's paths between registers allow."""
    (Path(folder) / "timing.tcl").write_text(
        f"read_liberty {CELLS}\nread_verilog netlist.v\nlink_design {top}\n"
        "create_clock -name clk -period 1000 [get_ports clk]\nreport_checks -path_delay max -digits 4\n")
    report = run(["sta", "-no_splash", "-exit", "timing.tcl"], folder)
    arrival = re.search(r"(\S+) +data arrival time", report)
    setup = re.search(r"(\S+) +\S+ +library setup time", report)
    if not arrival or not setup:
        fail(f"sta: {top} has no path between registers\n{report[-2000:]}")
    return round(1000 * (float(arrival[1]) - float(setup[1])))
