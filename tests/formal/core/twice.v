// Two cores with the same rays, image and units. Each has a memory with its own timing, and its own times of rays and
// answers.
module side #(parameter EAGER = 0) (
  input wire clk, rst,
  input wire [1:0] any,
  input wire [7:0] origin,
  input wire [13:0] lengths,
  input wire [1:0] last,
  input wire [4*19-1:0] image,
  output reg [1:0] answered,
  output reg [25:0] answers
);
  (* anyseq *) reg ray_valid, ray_tag, hit_ready, request_ready, read_valid;
  (* anyseq *) reg [1:0] read_id;
  wire ray_ready, hit_valid, hit_tag, request_valid;
  wire [2:0] hit_failed;
  wire [31:0] hit_number;
  wire [6:0] hit_t;
  wire [8:0] request_address;
  wire [1:0] request_id;

  // Each ray is taken once.
  reg [1:0] taken;
  always @(posedge clk) taken <= rst ? 2'd0 : taken | (ray_valid & ray_ready ? 2'd1 << ray_tag : 2'd0);
  always @* if (ray_valid) assume (!taken[ray_tag]);

  // Requests on their way, and the blocks they are for.
  reg [3:0] asked;
  reg [1:0] blocks [0:3];
  wire asks = request_valid & request_ready;
  always @(posedge clk) begin
    asked <= rst ? 4'd0 : (asked & ~(read_valid ? 4'd1 << read_id : 4'd0)) | (asks ? 4'd1 << request_id : 4'd0);
    if (asks) blocks[request_id] <= request_address[6:5];
  end
  always @* if (read_valid) assume (asked[read_id]);
  // One side is never slow, and its order is always the same. If every other timing gives its answers, any two give the same.
  generate if (EAGER) begin : eager
    always @* assume (hit_ready && request_ready && read_valid == (asked != 4'd0) && ray_valid == (taken != 2'd3) && ray_tag == taken[0]);
    always @* if (read_valid) assume ((asked & ((4'd1 << read_id) - 4'd1)) == 4'd0);
  end else begin : slow
    // The other holds something back in so many cycles, whichever: a ray, a request, a block or an answer.
    reg [3:0] held;
    wire holds = ~hit_ready | ~request_ready | (asked != 4'd0 & ~read_valid) | (taken != 2'd3 & ~ray_valid);
    always @(posedge clk) held <= rst ? 4'd0 : held + holds;
    always @* assume (held <= `HELD);
  end endgenerate

  // A block in few bits: pointer, children, bits for the units and the number, which grid, kind.
  wire [18:0] block = image >> (19 * blocks[read_id]);
  function [7:0] count(input [1:0] few);
    count = few == 2'd3 ? 8'd255 : {6'd0, few};
  endfunction
  wire [1:0] pointer = block[1:0];
  wire [7:0] of_units = block[13:6];
  wire [7:0] kind = block[14] ? 8'h00 : read_id[1] ^ block[15] ? 8'h68 : 8'h48;
  wire [255:0] record = {kind, 40'd0, count(block[5:4]), count(block[3:2]), 30'd0, pointer, 16'd0,
                         96'd0, 16'd0, {4'd0, of_units[7:4]}, 16'd0, {4'd0, of_units[3:0]}};
  wire [255:0] triangle = {kind, 30'd0, of_units[7:6], 208'd0, of_units};
  wire [255:0] words = read_id[1] ? triangle : record;

  core core (
    .clk(clk), .rst(rst), .ray_valid(ray_valid), .ray_ready(ray_ready), .ray_tag(ray_tag), .ray_any(any[ray_tag]),
    .ray_error(1'b0), .ray_major_y(1'b0), .ray_major_z(1'b0), .ray_back_m(1'b1), .ray_back_a(1'b1), .ray_back_b(1'b1),
    .ray_origin_m({4'd0, ray_tag ? origin[7:4] : 4'd0}), .ray_origin_a({4'd0, ray_tag ? origin[3:0] : 4'd0}),
    .ray_origin_b(8'd0), .ray_s_a(9'd0), .ray_s_b(9'd0), .ray_floor_a(4'd0), .ray_ceil_a(4'd0), .ray_exp_a(3'd0),
    .ray_floor_b(4'd0), .ray_ceil_b(4'd0), .ray_exp_b(3'd0), .ray_length(ray_tag ? lengths[13:7] : lengths[6:0]),
    .hit_valid(hit_valid), .hit_ready(hit_ready), .hit_tag(hit_tag), .hit_failed(hit_failed),
    .hit_number(hit_number), .hit_t(hit_t), .request_valid(request_valid), .request_ready(request_ready),
    .request_address(request_address), .request_id(request_id), .read_valid(read_valid), .read_id(read_id),
    .read_word_0(words[63:0]), .read_word_1(words[127:64]), .read_word_2(words[191:128]),
    .read_word_3(words[255:192]), .read_error(1'b0),
    .base(3'd0), .last({2'd0, last}), .most_steps(20'd2), .most_rays(2'd2));

  // The answers. Those of failed rays mean nothing.
  wire [12:0] answer = {hit_failed, hit_failed == 3'd0 ? {&hit_number, hit_number[1:0], hit_t} : 10'd0};
  always @(posedge clk) begin
    if (rst) answered <= 2'd0;
    else if (hit_valid & hit_ready) answered[hit_tag] <= 1'b1;
    if (hit_valid & hit_ready) begin
      if (hit_tag) answers[25:13] <= answer;
      else answers[12:0] <= answer;
    end
  end
endmodule

module twice (input wire clk);
  reg rst = 1'b1;
  always @(posedge clk) rst <= 1'b0;
  (* anyconst *) reg [1:0] any, last;
  (* anyconst *) reg [7:0] origin;
  (* anyconst *) reg [13:0] lengths;
  (* anyconst *) reg [4*19-1:0] image;
  wire [1:0] done_0, done_1;
  wire [25:0] answers_0, answers_1;
  side #(.EAGER(1)) side_0 (clk, rst, any, origin, lengths, last, image, done_0, answers_0);
`ifdef REACHED
  side #(.EAGER(1)) side_1 (clk, rst, any, origin, lengths, last, image, done_1, answers_1);
`else
  side side_1 (clk, rst, any, origin, lengths, last, image, done_1, answers_1);
`endif
  wire both = &done_0 & &done_1;
`ifdef REACHED
  // A triangle met by each ray, in a leaf of the root's record.
  wire [3:0] failed = {answers_0[25:23] == 0, answers_0[12:10] == 0, ~answers_0[22], ~answers_0[9]};
  always @* if (!rst) assert (!(both && &failed));
`else
  wire [1:0] compared = done_0 & done_1;
  always @* if (!rst) begin
    assert (!compared[0] || answers_0[12:0] == answers_1[12:0]);
    assert (!compared[1] || answers_0[25:13] == answers_1[25:13]);
  end
`endif
endmodule
