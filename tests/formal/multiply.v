// Every product becomes the symbol uf_mul of its operands, extended to 64 bits: what is proved with it holds
// for whatever a multiplier does.
(* techmap_celltype = "$mul" *)
module product_as_symbol (A, B, Y);
  parameter A_SIGNED = 0;
  parameter B_SIGNED = 0;
  parameter A_WIDTH = 1;
  parameter B_WIDTH = 1;
  parameter Y_WIDTH = 1;
  input [A_WIDTH-1:0] A;
  input [B_WIDTH-1:0] B;
  output [Y_WIDTH-1:0] Y;
  wire [63:0] y;
  uf_mul symbol (
    .a({{(64 - A_WIDTH){A_SIGNED ? A[A_WIDTH-1] : 1'b0}}, A}),
    .b({{(64 - B_WIDTH){B_SIGNED ? B[B_WIDTH-1] : 1'b0}}, B}),
    .y(y));
  assign Y = y[Y_WIDTH-1:0];
endmodule
