  // Triangles in the queue of triangle_feed and of serial_triangle, whose text says `gone`, the oldest one leaves, and
  // `gone_ray`, its ray.
  // Rays in flight, and those whose triangle is here. A ray rays_end when the others say so.
  (* anyseq *) reg [1:0] rays_end;
  reg [1:0] flying, here;
  wire comes = read_valid & read_id[1];
  always @(posedge clk) begin
    if (rst) {flying, here} <= 4'd0;
    else begin
      flying <= flying & ~rays_end;
      if (ray_valid & ray_ready) flying[begun_at] <= 1'b1;
      if (comes) here[read_id[0]] <= 1'b1;
      if (gone) here[gone_ray] <= 1'b0;
    end
  end
  // A number in flight does not begin again. A ray in flight asks for the next triangle when one has been tested.
  always @* begin
    if (ray_valid & ray_ready) assume (!flying[begun_at]);
    if (comes) assume (flying[read_id[0]] && !here[read_id[0]]);
    assume ((rays_end & here) == 2'd0 && !(comes && rays_end[read_id[0]]));
  end

  // Any ray, and the words that it was given. The unit's slopes have the sign of the direction.
  (* anyconst *) reg our;
  reg [46:0] our_words;
  wire [9:0] size_a = {1'b0, ray_s_a}, size_b = {1'b0, ray_s_b};
  always @(posedge clk) if (ray_valid & ray_ready & begun_at == our) begin
    our_words <= {ray_major_y, ray_major_z, ray_back_m, ray_origin_m, ray_origin_a, ray_origin_b,
                  ray_back_a != ray_back_m ? 10'd0 - size_a : size_a,
                  ray_back_b != ray_back_m ? 10'd0 - size_b : size_b};
  end

  // The triangles that have come and are not tested, with their rays, the oldest in the low bits.
  wire [255:0] whole = {read_word_3, read_word_2, read_word_1, read_word_0};
  wire [72:0] triangle = {read_id[0], whole[199:192], whole[175:168], whole[151:144], whole[127:120], whole[103:96],
                          whole[79:72], whole[55:48], whole[31:24], whole[7:0]};
  reg [1:0] waiting;
  reg [145:0] kept;
  wire [1:0] rest = waiting - {1'b0, gone};
  wire [145:0] shifted = gone ? kept >> 73 : kept;
  reg came, came_ray;
  reg [NUMBER_BITS-1:0] came_number;
  reg came_unread;
  always @(posedge clk) begin
    if (rst) waiting <= 2'd0;
    else waiting <= rest + {1'b0, comes};
    kept <= !comes ? shifted : rest == 2'd0 ? {73'd0, triangle} : {triangle, shifted[72:0]};
    came <= ~rst & comes;
    came_ray <= read_id[0];
    came_number <= whole[215+NUMBER_BITS:216];
    came_unread <= read_error || whole[255:248] != 8'h68 ||
                   (NUMBER_BITS < 32 && whole[247:216] >= (33'd1 << NUMBER_BITS) - 33'd1);
  end

  // A place of the queue, as a triangle with its ray.
  wire [23:0] corner_00 = corners_0[0], corner_01 = corners_1[0], corner_02 = corners_2[0];
  wire [23:0] corner_10 = corners_0[1], corner_11 = corners_1[1], corner_12 = corners_2[1];
  function [72:0] at_place(input ray, input [23:0] first, input [23:0] second, input [23:0] third);
    at_place = {ray, third[7:0], third[15:8], third[23:16], second[7:0], second[15:8], second[23:16],
                first[7:0], first[15:8], first[23:16]};
  endfunction
  wire [72:0] place_0 = at_place(rays[0], corner_00, corner_01, corner_02);
  wire [72:0] place_1 = at_place(rays[1], corner_10, corner_11, corner_12);
  wire [72:0] shown = at_place(rays_word, corners_0_word, corners_1_word, corners_2_word);

  wire [1:0] first_ray = waiting != 2'd0 ? 2'd1 << kept[72] : 2'd0;
  wire [1:0] second_ray = waiting == 2'd2 ? 2'd1 << kept[145] : 2'd0;
  always @(posedge clk) if (was_reset & ~rst) begin
    // A triangle is in the queue from the cycle in which it comes until it is tested, and a ray has one at most.
    assert (waiting <= 2'd2 && used == waiting);
    assert ((first_ray ^ second_ray) == here && (first_ray & second_ray) == 2'd0 && (here & ~flying) == 2'd0);
    assert (waiting == 2'd0 || (oldest ? place_1 : place_0) == kept[72:0]);
    assert (waiting != 2'd2 || (oldest ? place_0 : place_1) == kept[145:73]);
    assert (!there || (waiting != 2'd0 && shown == kept[72:0]));
    assert (there == (waiting > {1'b0, came}) && (!ready || there));
    assert (!flying[our] || {origins[our], slopes[our]} == our_words);
    // The number of a triangle is said in the next cycle, and whether it was one.
    assert (reads == came && (!reads || {read_ray, number, unread} == {came_ray, came_number, came_unread}));
  end
