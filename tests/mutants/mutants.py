#!/usr/bin/env python3
"""Plants faults in the Verilog of cores and units, and counts which of them the emitted testbenches and harnesses find.

A fault changes one line. The testbench runs in Icarus, then a core's harness in Verilator. Yosys tries to prove that survivors are
equivalent; equivalent.txt lists others with the reason. The exit code is 1 if a survivor is in neither.
"""
import argparse
import concurrent.futures
import pathlib
import shutil
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import equivalence
from choice import faults_in_order
from configurations import configurations
from known import Known, machine_of
from simulation import FAILED, NOT_COMPILED, Harness, Written

BENCH, HARNESS, EQUIVALENT, LISTED, SURVIVES = "testbench", "harness", "proved", "listed", "survive"


class Plants:
    """One configuration's faults."""

    def __init__(self, configuration, hitpipe, folder, known, proof_seconds):
        self.configuration = configuration
        self.folder = folder
        self.known = known
        self.proof_seconds = proof_seconds
        configuration.write(hitpipe, folder / "written")
        self.written = Written(folder / "written", configuration.is_core)
        self.top = self.written.core or self.written.benches[0]
        self.harness = Harness(self.written, folder / "base") if configuration.is_core else None
        self.seconds = {"icarus": [], "harness": [], "yosys": []}

    def timed(self, what, function, *arguments):
        begin = time.monotonic()
        result = function(*arguments)
        self.seconds[what].append(time.monotonic() - begin)
        return result

    def fate(self, number, fault):
        """What finds it; None if it is no fault, as it does not compile."""
        folder = self.folder / f"fault_{number}"
        self.written.copy_with(fault, folder)
        try:
            return self.fate_in(folder, fault)
        finally:
            shutil.rmtree(folder)

    def fate_in(self, folder, fault):
        # The wrapper has no testbench.
        if not self.harness or fault.file != f"{self.written.wrapper}.v":
            verdict = self.timed("icarus", self.written.icarus, folder, fault)
            if verdict == NOT_COMPILED:
                return None
            if verdict == FAILED:
                return BENCH
        if self.harness:
            verdict = self.timed("harness", self.harness.verdict, folder)
            if verdict == NOT_COMPILED:
                return None
            if verdict == FAILED:
                return HARNESS
        if self.known.reason(machine_of(fault.module, self.top), fault):
            return LISTED
        if self.timed("yosys", equivalence.equivalent, self.written.texts, fault, folder, self.proof_seconds):
            return EQUIVALENT
        return SURVIVES

    def run(self, seed, count, pool):
        """(fault, fate) of the first `count` faults that compile."""
        order = faults_in_order(self.written.texts, seed)
        found, next_fault = [], 0
        while len(found) < count and next_fault < len(order):
            some = order[next_fault:next_fault + count - len(found)]
            runs = [pool.submit(self.fate, next_fault + i, fault) for i, fault in enumerate(some)]
            for fault, run in zip(some, runs):
                fate = run.result()
                if fate is None:
                    continue
                found.append((fault, fate))
                if fate == SURVIVES:
                    print(survivor(self, fault), file=sys.stderr, flush=True)
                if len(found) % 50 == 0:
                    print(f"{self.configuration.name}: {len(found)} of {count} faults", file=sys.stderr, flush=True)
            next_fault += len(some)
        return found


def survivor(plants, fault):
    return (f"{plants.configuration.name}: {fault.file}:{fault.number + 1}: {fault.kind}\n  {machine_of(fault.module, plants.top)}\n"
            f"  {fault.before.strip()}\n  {fault.after.strip()}")


def print_table(title, rows):
    fates = [BENCH, HARNESS, EQUIVALENT, LISTED, SURVIVES]
    print(f"\n| {title} | faults | " + " | ".join(fates) + " |")
    print("|---|" + "--:|" * (len(fates) + 1))
    total = [fate for row in rows.values() for fate in row]
    for name, row in [*sorted(rows.items()), ("all", total)]:
        print(f"| {name} | {len(row):,} | " + " | ".join(f"{row.count(fate):,}" for fate in fates) + " |")


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("hitpipe", help="the program")
    options.add_argument("--seed", type=int, default=1, help="another seed chooses other faults (default 1)")
    options.add_argument("--core-faults", type=int, default=500, help="faults of each core (default 500)")
    options.add_argument("--unit-faults", type=int, default=100, help="faults of each unit (default 100)")
    options.add_argument("--only", default="", help="only configurations whose name holds this")
    options.add_argument("--jobs", type=int, default=2, help="faults at a time (default 2)")
    options.add_argument("--proof-seconds", type=float, default=30, help="what Yosys may take for a survivor (default 30)")
    chosen = options.parse_args()
    known = Known((pathlib.Path(__file__).parent / "equivalent.txt").read_text())
    selected = [configuration for configuration in configurations(chosen.hitpipe) if chosen.only in configuration.name]
    if not selected:
        options.error(f"--only {chosen.only}: no configuration has this in its name")

    by_module, by_configuration, survivors, seconds = {}, {}, [], {}
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
        for number, configuration in enumerate(selected):
            plants = Plants(configuration, chosen.hitpipe, pathlib.Path(folder) / str(number), known, chosen.proof_seconds)
            for fault, fate in plants.run(chosen.seed, chosen.core_faults if configuration.is_core else chosen.unit_faults, pool):
                by_configuration.setdefault(configuration.name, []).append(fate)
                by_module.setdefault(machine_of(fault.module, plants.top), []).append(fate)
                if fate == SURVIVES:
                    survivors.append(survivor(plants, fault))
            for what, times in plants.seconds.items():
                seconds.setdefault(what, []).extend(times)
    print_table("configuration", by_configuration)
    print_table("module", by_module)
    for what, times in seconds.items():
        if times:
            print(f"\n{what}: {len(times):,} runs of {sum(times) / len(times):.2f} s", end="")
    print(f"\n\n{len(survivors)} survive." + "".join(f"\n\n{text}" for text in survivors))
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
