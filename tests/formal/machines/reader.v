  // Rays outside: those that may go, those whose triangle is on its way, those whose hit is compared.
  reg [3:0] walking, testing, comparing;
  always @(posedge clk) begin
    if (rst) {walking, testing, comparing} <= 12'hf00;
    else begin
      if (goes) walking[walk_ray] <= 1'b0;
      if (asks & granted & triangle) testing[asker] <= 1'b1;
      if (asks & granted & ~triangle) walking[asker] <= 1'b1;
      if (tested) testing[tester] <= 1'b0;
      if (tested & hit) comparing[tester] <= 1'b1;
      if (divided) comparing[divided_ray] <= 1'b0;
      if (leaf_done) walking[leaf_ray] <= 1'b1;
    end
  end
  // What comes in is of a ray that is there. A leaf has a triangle. The image stays while a ray is in flight.
  reg [3:0] last_before;
  always @(posedge clk) last_before <= last;
  always @* begin
    if (goes) assume (walking[walk_ray] && triangles != 0);
    if (tested) assume (testing[tester]);
    if (reads) assume (testing[read_ray]);
    if (divided) assume (comparing[divided_ray]);
    if (walking != 4'hf) assume (last == last_before);
  end

  // The ray at each place of the queues.
  wire [3:0] goes_at [0:3], missed_at [0:3], divided_at [0:3];
  genvar p;
  generate
    for (p = 0; p < 4; p = p + 1) begin : place
      wire [1:0] goes_turn = p - goes_oldest, missed_turn = p - missed_oldest, divided_turn = p - divided_oldest;
      assign goes_at[p] = goes_turn < goes_used ? 4'd1 << go_words[p][7:6] : 4'd0;
      assign missed_at[p] = missed_turn < missed_used ? 4'd1 << missed_rays[p] : 4'd0;
      assign divided_at[p] = divided_turn < divided_used ? 4'd1 << divided_rays[p][2:1] : 4'd0;
    end
  endgenerate
  wire [3:0] in_goes = goes_at[0] | goes_at[1] | goes_at[2] | goes_at[3];
  wire [3:0] in_missed = missed_at[0] | missed_at[1] | missed_at[2] | missed_at[3];
  wire [3:0] in_divided = divided_at[0] | divided_at[1] | divided_at[2] | divided_at[3];
  wire [3:0] in_stage = there_1 ? 4'd1 << ray_1 : 4'd0;
  function [2:0] count(input [3:0] rays);
    count = rays[0] + rays[1] + rays[2] + rays[3];
  endfunction

  // Every ray is in one place. A queue has as many words as rays, so it has none twice and cannot overflow.
  genvar r;
  generate
    for (r = 0; r < 4; r = r + 1) begin : ray
      wire [6:0] places = {in_goes[r], in_missed[r], in_divided[r], in_stage[r],
                           walking[r], testing[r], comparing[r]};
      always @(posedge clk) if (was_reset & ~rst) assert (places != 7'd0 && (places & (places - 7'd1)) == 7'd0);
    end
  endgenerate
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (goes_used == count(in_goes) && missed_used == count(in_missed) && divided_used == count(in_divided));
    assert (!goes_there || (goes_used != 3'd0 && go_words_word == go_words[goes_oldest]));
    assert (!missed_there || (missed_used != 3'd0 && missed_rays_word == missed_rays[missed_oldest]));
    assert (!divided_there || (divided_used != 3'd0 && divided_rays_word == divided_rays[divided_oldest]));
    cover (leaf_lost == 2'd2 && triangle && !stops_1);
    cover (leaf_lost == 2'd3);
    cover (goes_used == 3'd4);
  end

  // What was no triangle is known before its test has ended.
  reg [3:0] seen, bad;
  always @(posedge clk) begin
    if (asks & granted & triangle) seen[asker] <= 1'b0;
    if (reads) seen[read_ray] <= 1'b1;
    if (reads) bad[read_ray] <= unread;
  end
  always @* begin
    if (tested) assume (seen[tester] && !(reads && read_ray == tester));
    if (reads) assume (!seen[read_ray] && !(tested && tester == read_ray));
  end

  // Any ray, and what it wants next: a record, or the first of the triangles that are left, or nothing since a hit.
  (* anyconst *) reg [1:0] one;
  reg is_record, stops_here;
  wire in_leaf = in_missed[one] | in_divided[one] | in_stage[one] | testing[one] | comparing[one];
`ifdef QUESTIONS
  // It wants the last triangle again.
  reg repeats;
  always @(posedge clk) begin
    if (rst) repeats <= 1'b0;
    else if (tested & tester == one) repeats <= again & ~hit;
    else if ((asks & granted & asker == one) | (goes & walk_ray == one) | (leaf_done & leaf_ray == one))
      repeats <= 1'b0;
  end
  integer m;
  always @(posedge clk) if (was_reset & ~rst) begin
    for (m = 0; m < 4; m = m + 1) assert (!missed_at[m][one] || missed_again[m] == repeats);
    assert (!missed_there || missed_again_word == missed_again[missed_oldest]);
    assert (!in_stage[one] || again_1 == repeats);
    assert (!repeats || ((in_missed[one] || in_stage[one]) && !stops_here));
    assert (!in_leaf || coming != 5'd0);
    cover (repeats && asks && granted && asker == one && left == 0);
  end
`else
  wire repeats = 1'b0;
`endif
  reg [4:0] coming;
  reg [LEAF_BITS-1:0] left;
  always @(posedge clk) begin
    if (goes & walk_ray == one)
      {is_record, stops_here, coming, left} <= {&triangles, 2'd0, wanted, triangles};
    else if (asks & granted & asker == one & ~repeats) {coming, left} <= {coming + 5'd1, left - 1'd1};
    if (divided & divided_ray == one) stops_here <= divided_stops;
  end

  // A leaf's word is of the triangle that comes next. Before the first is asked for, it is of the second.
  wire [LEAF_BITS+4:0] leaf_word = writes & writer == one ? leaf : leaves[one];
  wire [4:0] behind = coming + 5'd1, end_of_image = last + 5'd1;
  integer q;
  always @(posedge clk) if (was_reset & ~rst) begin
    for (q = 0; q < 4; q = q + 1) begin
      assert (!goes_at[q][one] || go_words[q][5:0] == {coming > last, !is_record, coming[3:0]});
      assert (!divided_at[q][one] || divided_rays[q][0] == stops_here);
    end
    if (in_goes[one]) begin
      assert (!coming[4] && left != 0);
      assert (is_record || leaf_word == {behind == end_of_image, left - 1'd1, behind[3:0]});
    end
    if (in_leaf) begin
      assert (!is_record && coming <= end_of_image);
      assert (leaf_word == {coming == end_of_image, left, coming[3:0]});
    end
    assert (!writes || writer != one || in_leaf);
    assert (!stops_here || in_divided[one] || in_stage[one] || walking[one]);
    assert (!in_stage[one] || stops_1 == stops_here);
    if (in_missed[one] | in_divided[one] | in_stage[one] | comparing[one]) assert (seen[one]);
    if (in_leaf && seen[one]) assert (flaws[one] == bad[one]);
    assert (!in_stage[one] || flaws_word == flaws[one]);
    assert (!in_stage[one] || !settled_1 || leaves_word == leaves[one]);
    // A block that is asked for is the next one, and in the image. So triangles come in turn, each once.
    if (asks && asker == one) begin
      assert (triangle == !is_record && asked_block == coming - {4'd0, repeats} && asked_block <= last);
      assert ((repeats || left != 0) && !stops_here);
      assert (in_goes[one] || !bad[one]);
    end
    // A ray is done when no triangle is left, when its hit said so, when the next block is not in the image, or when
    // what was tested was no triangle.
    if (leaf_done && leaf_ray == one) begin
      assert (leaf_lost == 2'd0 || leaf_lost == 2'd2 || leaf_lost == 2'd3);
      assert (leaf_stops == (leaf_lost != 2'd0 | stops_here));
      assert (leaf_stops || left == 0);
      assert (!repeats || leaf_lost == 2'd3);
      assert ((leaf_lost == 2'd3) == (!in_goes[one] && bad[one]));
      assert (leaf_lost != 2'd2 || (coming > last && left != 0 && !stops_here));
    end
  end
