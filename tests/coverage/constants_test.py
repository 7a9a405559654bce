#!/usr/bin/env python3
"""Yosys calls a bit constant if no input and no state changes it, and only if that is so in each instance of its module."""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from constants import constants

TEXT = """\
module part #(parameter BIT = 0) (
  input  wire clk,
  input  wire [3:0] a,
  output reg [3:0] b
);
  wire [7:0] wide = {4'd5, a};
  wire [1:0] place = 2'd1 << BIT;
  always @(posedge clk) b <= wide[3:0];
endmodule
module top (
  input  wire clk,
  input  wire [3:0] a,
  output wire [3:0] b,
  output wire [3:0] c
);
  wire unused = &{1'b0, a[0]};
  part #(.BIT(0)) one (.clk(clk), .a({a[3:1], 1'b0}), .b(b));
  part #(.BIT(1)) other (.clk(clk), .a({a[3], 3'd0}), .b(c));
endmodule
"""
EXPECTED = {("top", "unused"): {0}, ("top", "b"): {0}, ("top", "c"): {0, 1, 2}, ("part", "a"): {0},
            ("part", "b"): {0}, ("part", "place"): {0, 1},
            ("part", "wide"): {0, 4, 5, 6, 7}}

with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "top.v").write_text(TEXT)
    found = constants([folder / "top.v"], "top", folder)
if found != EXPECTED:
    print(f"constant bits: {found}, expected {EXPECTED}")
    sys.exit(1)
