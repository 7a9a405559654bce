#!/usr/bin/env python3
"""Yosys proves a fault that changes nothing, and does not prove one that changes a register, an enable or a reset."""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from equivalence import equivalent

TEXT = """\
module least (
  input  wire clk,
  input  wire rst,
  input  wire [3:0] a,
  input  wire [3:0] b,
  input  wire put,
  output wire [3:0] p
);
  reg [3:0] least;
  reg [3:0] kept [0:3];
  reg [3:0] word;
  wire less = a < b;
  wire [3:0] next = less ? a : b;
  assign p = least ^ word;
  always @(posedge clk) begin
    if (rst) begin
      least <= 4'h0;
    end else begin
      least <= next;
    end
  end
  always @(posedge clk) begin
    if (put) kept[a[1:0]] <= b;
    word <= kept[b[1:0]];
  end
endmodule
"""
CASES = [("a < b", "a <= b", True), ("a < b", "a > b", False), ("least <= 4'h0;", ";", False), ("least <= 4'h0;", "least <= 4'h1;", False),
         ("if (put)", "if (1'b1)", False), ("kept[b[1:0]]", "kept[b[2:1]]", False), ("least ^ word", "least | word", False)]


class Fault:
    file, module = "least.v", "least"

    def __init__(self, before, after):
        self.before, self.after = before, after

    def text_with_it(self, text):
        return text.replace(self.before, self.after)


with tempfile.TemporaryDirectory() as folder:
    for before, after, same in CASES:
        if equivalent({"least.v": TEXT}, Fault(before, after), pathlib.Path(folder), 60) != same:
            sys.exit(f"{before} -> {after}: {'not proved' if same else 'proved'}")
