// Units that say anything, after fewer cycles than the true ones. What they are given is not read, so it covers any
// function of it.
module core_pair #(parameter TAG_BITS = 1) (
  input wire clk, rst, in_valid,
  input wire [TAG_BITS-1:0] in_tag,
  output reg out_valid,
  output reg [TAG_BITS-1:0] out_tag,
`include "pair_ports.v"
);
  always @(posedge clk) {out_valid, out_tag} <= {in_valid & ~rst, in_tag};
  (* anyseq *) reg [34:0] said;
  assign {hit_0, hit_1, second_first, near_0, far_0, near_1, far_1} = said;
endmodule

module core_triangle #(parameter TAG_BITS = 1) (
  input wire clk, rst, in_valid,
  output wire in_ready,
  input wire [TAG_BITS-1:0] in_tag,
  output reg out_valid,
  output reg [TAG_BITS-1:0] out_tag,
`include "triangle_ports.v"
);
  reg phase;
  always @(posedge clk) phase <= ~rst & ~phase;
  assign in_ready = ~phase;
  always @(posedge clk) {out_valid, out_tag} <= {in_valid & in_ready & ~rst, in_tag};
  (* anyseq *) reg [49:0] said;
  assign {hit, det_high, det_low, num_high, num_low} = said;
endmodule
