#!/usr/bin/env python3
"""Counts which lines and bits of emitted cores their own testbench and harness reach, as Verilator counts them.

The exit code is 1 if they reach too little, or if something they do not reach is not in not_covered.txt with its reason.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "mutants"))
from configurations import CORES
from constants import constants
from known import machine_of
from points import LINE, TOGGLE, joined, not_covered, ranges, read_rules, shares

SIMULATIONS = ["testbench", "harness"]
LEAST = {LINE: 95, TOGGLE: 90}
# Registers begin with 0, and so do the copies with which Verilator compares bits. Bits that change before a reset has ended do not count.
FLAGS = ["-Wno-fatal", "-Wno-lint", "-Wno-style", "-DHITPIPE_CHECK", "--x-initial", "0", "--coverage-line", "--coverage-toggle"]
COVERAGE = "Verilated::threadContextp()->coveragep()"
FORGET = f'{COVERAGE}->write("before.dat"), {COVERAGE}->zero();'
# The testbench's first edge of the clock, in a reset, is at 5.
MAIN = f"""\
#include "Vtop.h"
#include "verilated.h"
#include "verilated_cov.h"
int main(int count, char** arguments) {{
  VerilatedContext& context = *Verilated::threadContextp();
  context.commandArgs(count, arguments);
  Vtop top;
  bool begins = true;
  while (!context.gotFinish()) {{
    top.eval();
    if (begins && context.time() >= 10) {{
      begins = false;
      {FORGET}
    }}
    if (!top.eventsPending()) break;
    context.time(top.nextTimeSlot());
  }}
  top.final();
  {COVERAGE}->write("coverage.dat");
}}
"""
# The harness's first reset takes two cycles, each of two calls.
COUNTING_TOP = f"""\
#include "verilated_cov.h"
struct Top : Vtop {{
  int calls = 0;
  void eval() {{
    Vtop::eval();
    if (++calls == 4) {FORGET}
  }}
}};
"""


def replace(file, old, new):
    text = file.read_text()
    if len(re.findall(old, text, re.M)) != 1:
        raise SystemExit(f"coverage: {file.name} of a harness has not one line {old}")
    file.write_text(re.sub(old, lambda _: new, text, flags=re.M))


def harness_with_coverage(folder):
    """The source of the harness in the folder, which writes its coverage from now on."""
    replace(folder / "core.hpp", r'^#include "V\w+\.h"$', '#include "Vtop.h"')
    replace(folder / "core.hpp", r"^using Top = V\w+;$", COUNTING_TOP)
    replace(folder / "harness.cpp", r'^  std::printf\("PASS', f'  {COVERAGE}->write("coverage.dat");\n  std::printf("PASS')
    return folder / "harness.cpp"


def run(command, folder):
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
    if done.returncode != 0:
        raise SystemExit(f"coverage: {' '.join(map(str, command))}: {done.stdout[-2000:]}")
    return done.stdout


def simulate(verilog, folder, top, main, jobs, sources=()):
    """The coverage file of a simulation whose C++ is the file `main`."""
    build = folder / f"build_{top}"
    build.mkdir()
    run(["verilator", "--cc", "--exe", "--timing", *FLAGS, "--prefix", "Vtop", "--top-module", top, "-y", folder, "--Mdir", build,
         *sources, verilog, main], folder)
    # Without optimisation it compiles in a minute and runs in a minute.
    run(["make", "-s", f"-j{jobs}", "-f", "Vtop.mk", "OPT_FAST=-O0", "OPT_SLOW=-O0", "OPT_GLOBAL=-O0", "VM_PARALLEL_BUILDS=1",
         f"USER_CPPFLAGS=-I{folder}"], build)
    said = run([build / "Vtop"], folder / "tb")
    if "PASS" not in said or "FAIL" in said:
        raise SystemExit(f"coverage: {top}: {said[-2000:]}")
    before, behind = ((folder / "tb" / f"{name}.dat").read_text(errors="replace") for name in ("before", "coverage"))
    return without_toggles(before) + behind


def without_toggles(data):
    return "".join(line for line in data.splitlines(keepends=True) if "v_toggle/" not in line)


def measure(hitpipe, options, folder, jobs, kept):
    """The core's name, its coverage by its testbench and its harness, and its constant bits."""
    run([hitpipe, "core", "rtl", *options.split(), "--out", folder], folder.parent)
    tb = folder / "tb"
    # Its units have testbenches too, whose names are longer.
    core = min((file.name for file in tb.glob("*_tb.sv")), key=len)[:-len("_tb.sv")]
    if kept and (kept / "harness.dat").exists():
        datas = [(kept / f"{name}.dat").read_text(errors="replace") for name in SIMULATIONS]
    else:
        main = folder / "main.cpp"
        main.write_text(MAIN)
        bench = simulate(folder / f"{core}.v", folder, f"{core}_tb", main, jobs, [tb / f"{core}_tb.sv"])
        harness = harness_with_coverage(tb / f"{core}_axi_harness")
        datas = [bench, simulate(folder / f"{core}_axi.v", folder, f"{core}_axi", harness, jobs)]
    if kept:
        kept.mkdir(parents=True, exist_ok=True)
        for name, data in zip(SIMULATIONS, datas):
            (kept / f"{name}.dat").write_text(data)
    return core, datas, constants([folder / f"{core}.v", folder / f"{core}_axi.v"], f"{core}_axi", folder)


def cells(found, module):
    lines, bits = found[module, LINE], found[module, TOGGLE]
    return (f"{lines.every:,} | {lines.percent():.1f} | {bits.every:,} | {bits.percent():.1f} | {bits.constant:,} | "
            f"{bits.percent_of_what_changes():.1f}")


HEAD = "lines | % | bits | % | constant | % of the others"


def print_modules(name, found, machine):
    print(f"\n| {name} | {HEAD} |\n|---|" + "--:|" * 6)
    for module in sorted({module for module, _ in found if module}):
        print(f"| {machine(module)} | {cells(found, module)} |")


def size(bits):
    """Of an entry of what is not covered: a signal of one bit, and a line, have no bits."""
    return max(len(bits), 1)


def print_reasons(lefts):
    """How many bits and lines of each core have each reason, and what they are."""
    print(f"\n| not reached, as | {' | '.join(name for name, _ in lefts)} |\n|---|" + "--:|" * len(lefts))
    reasons = dict.fromkeys(reason for _, left in lefts for reason, _, _ in left)
    for reason in reasons:
        counts = [sum(size(bits) for (of, _, _), bits in left.items() if of == reason) for _, left in lefts]
        print(f"| {reason or 'NO REASON'} | {' | '.join(f'{count:,}' for count in counts)} |")
    for name, left in lefts:
        for reason in reasons:
            entries = [(module, what, bits) for (of, module, what), bits in sorted(left.items(), key=str) if of == reason]
            if entries:
                print(f"\n{name}: {reason or 'NO REASON'}")
            for module, what, bits in entries:
                print(f"  {module}: {what}" + (f"[{ranges(bits)}]" if bits else ""))


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("hitpipe", type=pathlib.Path, help="the program")
    options.add_argument("--only", default="", help="only configurations whose name holds this")
    options.add_argument("--jobs", type=int, default=2, help="files that are compiled at a time (default 2)")
    options.add_argument("--keep", type=pathlib.Path, help="a folder for the coverage files; what is there is not simulated again")
    chosen = options.parse_args()
    rules = read_rules((pathlib.Path(__file__).parent / "not_covered.txt").read_text())
    selected = [(name, core) for name, core in CORES if chosen.only in name]
    if not selected:
        options.error(f"--only {chosen.only}: no configuration has this in its name")

    rows, lefts, good = [], [], True
    with tempfile.TemporaryDirectory() as temporary:
        for number, (name, core_options) in enumerate(selected):
            name = name.removeprefix("core, ")
            core, datas, same = measure(chosen.hitpipe.resolve(), core_options, pathlib.Path(temporary) / str(number), chosen.jobs,
                                        chosen.keep and chosen.keep.resolve() / name)

            def machine(module, core=core):
                return machine_of(module, core)

            def of_core(module, core=core):
                return module.startswith(core) and not module.endswith("_tb")

            counts = joined(datas, of_core)
            found = shares(counts, same)
            print_modules(name, found, machine)
            sys.stdout.flush()
            left = not_covered(counts, same, name, machine, rules)
            lefts.append((name, left))
            without_reason = sum(size(bits) for (reason, _, _), bits in left.items() if reason is None)
            alone = " | ".join(f"{shares(joined([data], of_core), {})[None, TOGGLE].percent():.1f}" for data in datas)
            rows.append(f"| {name} | {cells(found, None)} | {alone} | {without_reason:,} |")
            good = good and not without_reason and all(found[None, kind].percent() >= LEAST[kind] for kind in LEAST)
    print(f"\n| core | {HEAD} | testbench alone, bits % | harness alone, bits % | without a reason |\n|---|" + "--:|" * 9)
    print("\n".join(rows))
    print_reasons(lefts)
    if not chosen.only:
        for rule in rules:
            if not rule.used:
                print(f"\nnot_covered.txt: all that {rule.text} names is reached")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
