// Units whose results are a function of what they are given, after fewer cycles than the true ones: bits of a record's
// planes or of a triangle's corners, which are any, as the ray's origin changes them.
module core_pair #(parameter TAG_BITS = 1) (
  input wire clk, rst, in_valid,
  input wire [TAG_BITS-1:0] in_tag,
  output reg out_valid,
  output reg [TAG_BITS-1:0] out_tag,
`include "pair_ports.v"
);
  reg [7:0] said, low, high;
  always @(posedge clk) begin
    {out_valid, out_tag} <= {in_valid & ~rst, in_tag};
    said <= xmin ^ origin_m;
    low <= ymin ^ origin_a;
    high <= parent_far;
  end
  assign {hit_0, hit_1, second_first} = said[2:0];
  assign {near_0, near_1} = {6'd0, low[1:0], 6'd0, low[3:2]};
  assign {far_0, far_1} = {high, high};
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
  reg [7:0] said;
  always @(posedge clk) begin
    {out_valid, out_tag} <= {in_valid & in_ready & ~rst, in_tag};
    said <= x0 ^ origin_m;
  end
  // The divider's quotient is its numerator.
  assign {hit, det_high, det_low, num_high, num_low} = {said[0], 25'd1, 12'd0, 10'd0, said[2:1]};
endmodule
