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
from known import machine_of
from points import LINE, TOGGLE, joined, not_covered, percent, ranges, read_rules, shares

LEAST = {LINE: 95, TOGGLE: 90}
# Registers begin with 0. The copies with which Verilator compares bits do too; what it counts before a reset is taken back.
FLAGS = ["-Wno-fatal", "-Wno-lint", "-Wno-style", "-DHITPIPE_CHECK", "--x-initial", "0", "--coverage-line", "--coverage-toggle"]
COVERAGE = "Verilated::threadContextp()->coveragep()"
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
      {COVERAGE}->zero();
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
    if (++calls == 4) {COVERAGE}->zero();
  }}
}};
"""


def replaced(text, old, new):
    if len(re.findall(old, text, re.M)) != 1:
        raise SystemExit(f"coverage: a harness has not one line {old}")
    return re.sub(old, lambda _: new, text, flags=re.M)


def harness_with_coverage(text):
    text = replaced(text, r'^#include "V\w+\.h"$', '#include "Vtop.h"')
    text = replaced(text, r"^using Top = V\w+;$", COUNTING_TOP)
    return replaced(text, r'^  std::printf\("PASS', f'  {COVERAGE}->write("coverage.dat");\n  std::printf("PASS')


def run(command, folder):
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
    if done.returncode != 0:
        raise SystemExit(f"coverage: {' '.join(map(str, command))}: {done.stdout[-2000:]}")
    return done.stdout


def simulate(verilog, folder, top, main, jobs, sources=()):
    """The coverage file of a simulation whose C++ is `main`."""
    build = folder / f"build_{top}"
    build.mkdir()
    (build / "main.cpp").write_text(main)
    run(["verilator", "--cc", "--exe", "--timing", *FLAGS, "--prefix", "Vtop", "--top-module", top, "-y", folder, "--Mdir", build,
         *sources, verilog, build / "main.cpp"], folder)
    # Without optimisation it compiles in a minute and runs in a minute.
    run(["make", "-s", f"-j{jobs}", "-f", "Vtop.mk", "OPT_FAST=-O0", "OPT_SLOW=-O0", "OPT_GLOBAL=-O0", "VM_PARALLEL_BUILDS=1",
         f"USER_CPPFLAGS=-I{folder}"], build)
    said = run([build / "Vtop"], folder / "tb")
    if "PASS" not in said or "FAIL" in said:
        raise SystemExit(f"coverage: {top}: {said[-2000:]}")
    return (folder / "tb" / "coverage.dat").read_text(errors="replace")


def measure(hitpipe, options, folder, jobs):
    """The core's name, and its coverage by its testbench and its harness."""
    run([hitpipe, "core", "rtl", *options.split(), "--out", folder], folder.parent)
    tb = folder / "tb"
    core = next(tb.glob("*_tb.sv")).name[:-len("_tb.sv")]
    bench = simulate(folder / f"{core}.v", folder, f"{core}_tb", MAIN, jobs, [tb / f"{core}_tb.sv"])
    harness = harness_with_coverage((tb / f"{core}_axi_harness.cpp").read_text())
    wrapper = simulate(folder / f"{core}_axi.v", folder, f"{core}_axi", harness, jobs)
    return core, {"testbench": bench, "harness": wrapper}


def cells(found, module):
    return " | ".join(f"{found[module, kind][1]:,} | {percent(found[module, kind]):.1f}" for kind in (LINE, TOGGLE))


def print_modules(name, counts, machine):
    found = shares(counts)
    print(f"\n| {name} | lines | % | bits | % |\n|---|--:|--:|--:|--:|")
    for module in sorted({module for module, _ in found}):
        print(f"| {machine(module)} | {cells(found, module)} |")


def total(counts):
    """kind: [reached, all]."""
    found = {LINE: [0, 0], TOGGLE: [0, 0]}
    for (_, kind), (reached, every) in shares(counts).items():
        found[kind][0] += reached
        found[kind][1] += every
    return found


def print_not_covered(name, left):
    """Lines of Markdown: a reason, and below it what it is the reason of."""
    for reason in sorted({reason for reason, _, _ in left}, key=str):
        entries = [(module, what, bits) for (of, module, what), bits in sorted(left.items(), key=str) if of == reason]
        count = sum(max(len(bits), 1) for _, _, bits in entries)
        print(f"\n{name}, {count:,}: {reason or 'NO REASON'}")
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
            core, datas = kept(chosen.keep, name) or measure(chosen.hitpipe.resolve(), core_options, pathlib.Path(temporary) / str(number),
                                                             chosen.jobs)
            if chosen.keep:
                keep(chosen.keep, name, core, datas)

            def machine(module, core=core):
                return machine_of(module, core)

            def of_core(module, core=core):
                return module.startswith(core) and not module.endswith("_tb")

            counts = joined(datas.values(), of_core)
            print_modules(name, counts, machine)
            sys.stdout.flush()
            reached = total(counts)
            alone = [total(joined([data], of_core)) for data in datas.values()]
            left = not_covered(counts, name, machine, rules)
            without_reason = sum(max(len(bits), 1) for (reason, _, _), bits in left.items() if reason is None)
            rows.append((name, *(f"{count:,} | {percent((done, count)):.1f}" for done, count in (reached[LINE], reached[TOGGLE])),
                         *(f"{percent(each[TOGGLE]):.1f}" for each in alone), f"{without_reason:,}"))
            lefts.append((name, left))
            good = good and not without_reason and all(percent(reached[kind]) >= LEAST[kind] for kind in LEAST)
    print("\n| core | lines | % | bits | % | testbench's bits % | harness's bits % | without a reason |\n|---|" + "--:|" * 7)
    for row in rows:
        print(f"| {' | '.join(row)} |")
    for name, left in lefts:
        print_not_covered(name, left)
    if not chosen.only:
        for rule in rules:
            if not rule.used:
                print(f"\nnot_covered.txt: all that {rule.text} names is reached")
    sys.exit(0 if good else 1)


def kept(folder, name):
    files = sorted(folder.glob(f"{name}.*.dat")) if folder else []
    return (files[0].name.split(".")[1], {file.name.split(".")[2]: file.read_text() for file in reversed(files)}) if len(files) == 2 else None


def keep(folder, name, core, datas):
    folder.mkdir(parents=True, exist_ok=True)
    for what, data in datas.items():
        (folder / f"{name}.{core}.{what}.dat").write_text(data)


if __name__ == "__main__":
    main()
