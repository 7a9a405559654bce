"""examples/cocotb_unit without cocotb: its words and its judge, and its driver on the Verilog that `hitpipe rtl` writes, which Icarus
Verilog runs behind two pipes."""
import asyncio
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

import hitpipe
import numpy

from program import SOURCE, hitpipe_prints

sys.path.append(str(SOURCE / "examples/cocotb_unit"))
from driver import drive
from pairs import Judge, Pairs

INPUTS, OUTPUTS = ["rst", "in_valid", "out_ready"], ["in_ready", "out_valid"]


def bench(unit):
    """Reads a line of inputs, shows the outputs and then lets clk rise and fall, again and again."""
    widths = {p.name: p.width for p in [*unit.ports, *unit.results]}
    inputs, outputs = INPUTS + [p.name for p in unit.ports], OUTPUTS + [r.name for r in unit.results]
    declared = [f"{kind} [{widths.get(name, 1) - 1}:0] {name};" for kind, names in (("reg", inputs), ("wire", outputs)) for name in names]
    pins = ", ".join(f".{name}({name})" for name in ["clk", *inputs, *outputs])
    return "\n".join([
        "module bench;", "reg clk = 0;", *declared, f"unit dut({pins}, .in_tag(16'd0));", "initial begin",
        f'  while ($fscanf(32\'h8000_0000, "{" ".join(["%h"] * len(inputs))}", {", ".join(inputs)}) == {len(inputs)}) begin',
        f'    #1 $display("{" ".join(["%h"] * len(outputs))}", {", ".join(outputs)}); $fflush;',
        "    #1 clk = 1; #1 clk = 0;", "  end", "  $finish;", "end", "endmodule", ""])


class Device:
    """What cocotb calls dut, with the two waits that drive() takes."""

    def __init__(self, program, unit):
        self.inputs, self.outputs = INPUTS + [p.name for p in unit.ports], OUTPUTS + [r.name for r in unit.results]
        for name in self.inputs + self.outputs:
            setattr(self, name, types.SimpleNamespace(value=0))
        self.process = subprocess.Popen(["vvp", "-n", str(program)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.shown = False

    async def settled(self):
        words = [f"{getattr(self, name).value:x}" for name in self.inputs]
        self.process.stdin.write(" ".join(words) + "\n")
        self.process.stdin.flush()
        for name, word in zip(self.outputs, self.process.stdout.readline().split(), strict=True):
            # A result is unknown until the first test has come through.
            getattr(self, name).value = int(word, 16) if "x" not in word else None
        self.shown = True

    async def falling(self):
        if not self.shown:
            await self.settled()
        self.shown = False

    def close(self):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()


class Verilog(unittest.TestCase):
    def run_unit(self, design, bits, damage=None, count=300):
        with tempfile.TemporaryDirectory() as folder:
            hitpipe_prints("rtl", design, "--bits", bits, "--name", "unit", "--out", folder)
            verilog = pathlib.Path(folder, "unit.v")
            if damage:
                text = verilog.read_text()
                self.assertIn(damage[0], text)
                verilog.write_text(text.replace(*damage))
            pairs = Pairs(design, bits, count)
            pathlib.Path(folder, "bench.v").write_text(bench(pairs.unit))
            program = pathlib.Path(folder, "bench.vvp")
            subprocess.run(["iverilog", "-g2005", "-o", str(program), str(verilog), str(pathlib.Path(folder, "bench.v"))], check=True)
            device = Device(program, pairs.unit)
            try:
                return asyncio.run(drive(device, pairs, device.falling, device.settled))
            finally:
                device.close()

    def test_answers_as_the_module_does(self):
        for design, bits in (("int_slabs", "20/24"), ("int_major_pair", "16+1/11"), ("fp_slabs", "fp32")):
            with self.subTest(design):
                judge, cycles = self.run_unit(design, bits)
                self.assertTrue(judge.passed(), str(judge))
                self.assertGreater(judge.hits, 60)
                self.assertTrue(300 < cycles < 1000)

    def test_damage_is_seen(self):
        judge, _ = self.run_unit("int_slabs", "20/24", ("$signed(it_far) < $signed(it_near)", "$signed(it_near) < $signed(it_far)"))
        self.assertFalse(judge.passed())
        self.assertGreater(judge.mismatches, 0)
        # A unit that never answers ends the run too.
        judge, cycles = self.run_unit("int_slabs", "20/24", ("assign out_valid =", "assign out_valid = 1'b0 &"), count=20)
        self.assertEqual((judge.came, judge.passed(), cycles), (0, False, 1080))


class Makefile(unittest.TestCase):
    """The example's Makefile. In place of cocotb's, one that compiles the Verilog when it is newer, and says for what it would run."""
    RULES = """
.PHONY: sim
sim: model
	@echo "$$DESIGN,$$BITS"
model: $(VERILOG_SOURCES)
	cp $< $@
"""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.example = pathlib.Path(folder.name, "cocotb_unit")
        shutil.copytree(SOURCE / "examples/cocotb_unit", self.example, ignore=shutil.ignore_patterns("rtl", "sim_build"))
        pathlib.Path(folder.name, "Makefile.sim").write_text(self.RULES)
        config = pathlib.Path(folder.name, "cocotb-config")
        config.write_text(f"#!/bin/sh\necho '{folder.name}'\n")
        config.chmod(0o755)
        self.environment = {name: value for name, value in os.environ.items() if name not in ("DESIGN", "BITS", "TESTS", "MAKEFLAGS")}
        self.environment["PATH"] = f"{folder.name}:{os.environ['PATH']}"

    def unit_of(self, *variables):
        """What `make` compiles: the unit's design and format, as the manifest beside it says. DESIGN and BITS are of the same."""
        run = subprocess.run(["make", "-s", f"HITPIPE={os.environ['HITPIPE']}", *variables], cwd=self.example, env=self.environment,
                             capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        manifest = json.loads((self.example / "rtl/unit.json").read_text())
        self.assertEqual((self.example / "model").read_text(), (self.example / "rtl/unit.v").read_text())
        unit = hitpipe.Unit(*run.stdout.splitlines()[-1].split(","))
        self.assertEqual((unit.design, unit.format), (manifest["design"], manifest["bits"]))
        return f"{unit.design} {unit.format}"

    def test_compiles_what_was_asked_for_and_not_what_was_there(self):
        self.assertEqual(self.unit_of(), "int_slabs 20/24")
        for design, bits in (("int_slabs", "16/16"), ("int_slabs", "20/24"), ("fp_slabs", "fp32")):
            self.assertEqual(self.unit_of(f"DESIGN={design}", f"BITS={bits}"), f"{design} {bits}")

    def test_format_is_the_design_s_own_unless_said(self):
        for design in ("int_major", "fp_slabs", "int_slabs"):
            self.assertEqual(self.unit_of(f"DESIGN={design}"), f"{design} {hitpipe.Unit(design).format}")


class Words(unittest.TestCase):
    def test_are_the_module_s_numbers(self):
        for design in ("int_slabs", "fp_slabs", "int_major_pair"):
            pairs = Pairs(design, count=200)
            bits = pairs.unit.port_bits(pairs.answers.operands)
            numpy.testing.assert_array_equal([list(test.values()) for test in pairs.operands], bits)
            self.assertEqual(list(pairs.operands[0]), [port.name for port in pairs.unit.ports])
            results = pairs.unit.test_operands(pairs.answers.operands)
            masks = [(1 << result.width) - 1 for result in pairs.unit.results]
            numpy.testing.assert_array_equal([list(test.values()) for test in pairs.results], results & numpy.array(masks))
            self.assertTrue(50 < numpy.count_nonzero(pairs.answers.hit) < 350)


class Judgement(unittest.TestCase):
    def judge(self, change, design="int_slabs"):
        pairs = Pairs(design, count=100)
        judge = Judge(pairs)
        for results in change([dict(each) for each in pairs.results]):
            judge.take(results)
        return judge

    def test_passes_what_is_right(self):
        judge = self.judge(lambda results: results)
        self.assertTrue(judge.passed())
        self.assertRegex(str(judge), "^100 of 100 tests: [0-9]+ hits, 0 mismatches, 0 false misses$")

    def test_sees_what_is_wrong(self):
        none = self.judge(lambda results: [{"hit": 0}] * len(results))
        self.assertEqual(none.false_misses, int(none.pairs.answers.exact.sum()))
        self.assertEqual(none.mismatches, int(none.pairs.answers.hit.sum()))
        for change in (lambda r: r[:-1], lambda r: r + r[-1:], lambda r: r[::-1], lambda r: [{"hit": 1 - r[0]["hit"]}] + r[1:]):
            self.assertFalse(self.judge(change).passed())


unittest.main()
