  // Rays in flight, and those that wait for a record. A ray ends when the others say so.
  (* anyseq *) reg [1:0] ends;
  reg [1:0] flying, waits;
  wire comes = read_valid & ~read_id[1];
  always @(posedge clk) begin
    if (rst) {flying, waits} <= 4'd0;
    else begin
      flying <= flying & ~ends;
      if (ray_valid & ray_ready) flying[begun_at] <= 1'b1;
      if (comes) waits[read_id[0]] <= 1'b0;
      if (goes) waits[walk_ray] <= 1'b1;
    end
  end
  // A number in flight does not begin again. A ray in flight goes on, and a record comes for a ray that waits.
  always @* begin
    if (ray_valid & ray_ready) assume (!flying[begun_at]);
    if (goes) assume (flying[walk_ray] && !(comes && read_id[0] == walk_ray));
    if (comes) assume (waits[read_id[0]]);
    assume ((ends & waits) == 2'd0 && !(goes && ends[walk_ray]));
  end

  // Any ray, and the words that it was given: the unit's origin, the rest, and where it is in its record.
  (* anyconst *) reg our;
  reg [7:0] our_m, our_a, our_b;
  reg [26:0] our_rest;
  reg [15:0] our_interval;
  always @(posedge clk) begin
    if (ray_valid & ray_ready & begun_at == our) begin
      our_m <= ray_back_m ? ray_origin_m + 8'd1 : 8'd0 - ray_origin_m;
      our_a <= ray_back_a ? ray_origin_a + 8'd1 : 8'd0 - ray_origin_a;
      our_b <= ray_back_b ? ray_origin_b + 8'd1 : 8'd0 - ray_origin_b;
      our_rest <= {ray_major_y, ray_major_z, ray_back_m, ray_back_a, ray_back_b,
                   ray_floor_a, ray_ceil_a, ray_exp_a, ray_floor_b, ray_ceil_b, ray_exp_b};
    end
    if (goes & walk_ray == our) our_interval <= {enters_at, leaves_at};
  end

  // The record that came in the last cycle, and its ray's words then.
  wire [255:0] whole = {read_word_3, read_word_2, read_word_1, read_word_0};
  reg came, came_ray;
  reg [255:0] record;
  reg error;
  reg [66:0] then_words;
  always @(posedge clk) begin
    came <= ~rst & comes;
    came_ray <= read_id[0];
    record <= whole;
    error <= read_error;
    then_words <= {our_m, our_a, our_b, our_rest, our_interval};
  end

  // All ones of the image's bits is a record. All ones of the core's is no leaf.
  function is_large(input [7:0] count);
    is_large = count != 8'hff && count >= (9'd1 << LEAF_BITS) - 9'd1;
  endfunction
  always @(posedge clk) if (was_reset & ~rst) begin
    assert ((waits & ~flying) == 2'd0);
    if (flying[our]) begin
      assert (origins[our] == {our_rest[26:22], our_m, our_a, our_b});
      assert ({bounds_a[our], bounds_b[our]} == our_rest[21:0]);
    end
    assert (!waits[our] || intervals[our] == our_interval);
    // A record is tested once, in the next cycle, with its ray.
    assert (begins == came);
    if (begins) begin
      assert (test_ray == came_ray);
      assert ({zmin, ymin, xmin} == {record[55:48], record[31:24], record[7:0]});
      assert ({zmax, ymax, xmax} == {record[127:120], record[103:96], record[79:72]});
      assert ({own_zmax, own_ymax, own_xmax, own_zmin, own_ymin, own_xmin} == record[149:144]);
      assert ({count_1, count_0, block} == {record[199+LEAF_BITS:200], record[191+LEAF_BITS:192], record[163:160]});
      // It is a record of this grid, and no pointer or count of it is too large; else its ray is lost.
      assert (flaw[0] == (error || record[255:248] != 8'h48));
      assert (flaw[1] == (flaw[0] || record[191:164] != 28'd0 || is_large(record[199:192]) || is_large(record[207:200])));
      if (test_ray == our)
        assert ({origin_m, origin_a, origin_b, major_y, major_z, back_m, back_a, back_b, floor_a, ceil_a, exp_a,
                 floor_b, ceil_b, exp_b, parent_near, parent_far} == then_words);
    end
    cover (begins && comes && read_id[0] != test_ray);
  end
