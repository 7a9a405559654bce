#!/usr/bin/env python3
"""The choice of faults on a small Verilog text: the seed decides it, each fault changes one line's code, and skipped lines stay."""
import sys

sys.dont_write_bytecode = True
from choice import faults_in_order
from known import Known, machine_of

TEXT = """\
// counter & its comment <= 3'h1;
module counter (
  input  wire clk,
  input  wire rst,
  input  wire [2:0] step,  // 0 & 1
  output wire [3:0] sum
);
  reg [3:0] count;  // 2'd1 after a reset
  reg [3:0] steps [0:7];
  reg [3:0] word;
  wire goes = step == 3'h2 | count[1];  // goes & ~rst
  wire both = goes & count[0];
  wire [3:0] next = goes ? count + {1'd0, step} : ~count;
  wire unused = &{1'b0, step[0]};
  /* verilator lint_off WIDTH */
  wire [3:0] wide = step & count;  // lint
  /* verilator lint_on WIDTH */
  assign sum = count;
  always @(posedge clk) begin
    if (rst) begin
      count <= 4'h0;
    end else begin
      count <= next;
    end
  end
  always @(posedge clk) begin
    if (goes) steps[step] <= count;
    word <= steps[step];
  end
  counter_part part (
    .clk(clk),
    .a(count),
    .b(next),
    .p(wide)
  );
endmodule
"""
SKIPPED = ("//", "module", "  input", "  output", "  reg", "  wire unused", "  /*", "  wire [3:0] wide", "  always", "  counter_part", ")",
           "endmodule")
KINDS = {"operator", "operand", "constant", "slice", "address", "arms", "enable", "tied", "stuck bit", "another's value", "reset"}


def shown(faults):
    return [(fault.number, fault.kind, fault.after) for fault in faults]


def fail(what):
    print(what)
    sys.exit(1)


faults = faults_in_order({"counter.v": TEXT}, 1)
if len(faults) < 60:
    fail(f"only {len(faults)} faults")
if shown(faults) != shown(faults_in_order({"counter.v": TEXT}, 1)):
    fail("the same seed gives other faults")
if shown(faults)[:10] == shown(faults_in_order({"counter.v": TEXT}, 2))[:10]:
    fail("another seed gives the same faults")
if {fault.kind for fault in faults} != KINDS:
    fail(f"kinds that are not there: {KINDS - {fault.kind for fault in faults}}")

lines = TEXT.split("\n")
for fault in faults:
    changed = fault.text_with_it(TEXT).split("\n")
    different = [number for number, (line, other) in enumerate(zip(lines, changed)) if line != other]
    if len(changed) != len(lines) or different != [fault.number]:
        fail(f"{fault.kind} changes the lines {different}, not {fault.number}")
    before, after = lines[fault.number], changed[fault.number]
    if before.startswith(SKIPPED):
        fail(f"changed: {before}")
    if before.partition("//")[1:] != after.partition("//")[1:]:
        fail(f"a comment is changed: {after}")

first = faults[0]
entry = f"# A note.\n\ncounter\n{first.before.strip()}\n{first.after.strip()}\nNobody reads it.\n"
if Known(entry).reason("counter", first) != "Nobody reads it." or Known(entry).reason("counter", faults[1]):
    fail("the list of equivalent faults is read wrongly")
patterns = "/count.*/\n/.* <= .*/\n;\nIt begins with any.\n"
if [fault for fault in faults if Known(patterns).reason("counter", fault) and fault.after.strip() != ";"]:
    fail("a pattern of equivalent faults fits too many")
if not [fault for fault in faults if Known(patterns).reason("counter", fault)]:
    fail("a pattern of equivalent faults fits none")
if machine_of("hitpipe_core_8p0_4s8_door", "hitpipe_core_8p0_4s8") != "door" or machine_of("int_slabs", "int_slabs") != "int_slabs":
    fail("a machine has another name")
