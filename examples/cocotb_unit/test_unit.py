"""The test that cocotb runs: DESIGN, BITS and TESTS are environment variables, which the Makefile sets."""
import os

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, ReadOnly

from driver import drive
from pairs import Pairs


@cocotb.test()
async def every_answer_is_the_software_s(dut):
    cocotb.start_soon(Clock(dut.clk, 10, unit="ns").start())
    pairs = Pairs(os.environ["DESIGN"], os.environ["BITS"], int(os.environ["TESTS"]))
    judge, cycles = await drive(dut, pairs, lambda: FallingEdge(dut.clk), ReadOnly)
    cocotb.log.info("%s, %d cycles", judge, cycles)
    assert judge.passed(), str(judge)
