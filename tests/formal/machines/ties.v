  // What the unit said in the cycle before.
  reg was_tested, was_hit, was_tie, was_once, was_down, was_of;
  reg [1:0] was_is;
  reg [2:0] was_zero, was_inner;
  reg [48:0] was_numbers;
  wire [48:0] numbers = {det_high, det_low, num_high, num_low};
  always @(posedge clk) begin
    was_tested <= tested & ~rst;
    if (tested) begin
      {was_hit, was_tie, was_once, was_down, was_of} <= {hit, tie, tested_once, tested_down, tester};
      {was_is, was_zero, was_inner, was_numbers} <= {tested_is, zero, inner, numbers};
    end
  end

  // Any ray, and what was 0 in its tests of a triangle so far.
  (* anyconst *) reg one;
  reg known;
  reg [2:0] open;
  wire ours = was_tested & was_of == one;
  wire is_1st = was_is == 2'd0, is_4th = was_is == 2'd3, by_move = ~is_1st & ~is_4th;
  always @(posedge clk) begin
    if (rst) known <= 1'b0;
    else if (ours & is_1st) known <= 1'b1;
    if (ours) open <= is_1st ? was_zero : open & was_zero;
  end
  // A ray's next test comes later, and one with a moved origin behind another of the triangle.
  always @* begin
    if (tested & tester == one) assume (!ours);
    if (tested & tester == one & tested_is != 2'd0) assume (known);
  end

  wire [2:0] right = was_inner ^ {3{was_down}};
  wire fails = |(open & ~was_zero & ~right);
  wire [1:0] behind = was_is == 2'd1 && |(open & was_zero) ? 2'd2 : 2'd3;
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (settled == was_tested);
    assert (there == was_tested);
    if (was_tested) begin
      assert (settler == was_of && next_ray == was_of);
      assert ({settled_det_high, settled_det_low, settled_num_high, settled_num_low} == was_numbers);
      assert ({hit_1, tie_1, tested_once_1, tested_down_1} == {was_hit, was_tie, was_once, was_down});
      assert ({tested_is_1, zero_1, inner_1} == {was_is, was_zero, was_inner});
    end
    assert (!known || meets[one] == open);
    assert (!(ours & ~is_1st) || (known && meets_word == open));
    if (ours & is_1st) begin
      assert (settled_again == (was_once & was_tie));
      assert (settled_hit == (was_hit & ~settled_again));
      assert (next_is_other == settled_again && (!settled_again || next_is == 2'd1));
    end
    if (ours & by_move) begin
      assert (!settled_hit && settled_again == !fails);
      assert (next_is_other && next_is == (fails ? 2'd0 : behind));
    end
    if (ours & is_4th) assert (settled_hit == was_hit && !settled_again && next_is_other && next_is == 2'd0);
    assert (settled || !next_is_other);
    cover (ours && settled_again && next_is == 2'd2);
    cover (ours && by_move && !settled_again);
  end
