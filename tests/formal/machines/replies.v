  // Rays from their beginning to the edge at which their number comes back, and those whose answer has come.
  reg [1:0] flying, answered_rays;
  // Their tags, whether they are no rays, and whether they want a count.
  reg [1:0] tag_of, error_of, counts_of;
`ifdef COUNTS
  wire counts = ray_once & ray_any;
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (!flying[0] || counting[0] == counts_of[0]);
    assert (!flying[1] || counting[1] == counts_of[1]);
  end
`else
  wire counts = 1'b0;
  always @(posedge clk) if (was_reset & ~rst) assert ((counts_of & flying) == 2'd0);
`endif
  always @(posedge clk) begin
    if (rst) {flying, answered_rays} <= 4'd0;
    else begin
      if (ray_valid & ray_ready) begin
        flying[begun_at] <= 1'b1;
        tag_of[begun_at] <= ray_tag;
        error_of[begun_at] <= ray_error;
        counts_of[begun_at] <= counts;
      end
      if (answers) answered_rays[answered] <= 1'b1;
      if (freed) begin
        flying[freed_ray] <= 1'b0;
        answered_rays[freed_ray] <= 1'b0;
      end
    end
  end
  // A number in flight does not begin again, and a ray is answered once.
  always @* begin
    if (ray_valid & ray_ready) assume (!flying[begun_at]);
    if (answers) assume (flying[answered] && !answered_rays[answered]);
  end

  wire [0:0] first_ray = waiting[0][NUMBER_BITS+7], second_ray = waiting[1][NUMBER_BITS+7];
  wire first_is_used = used == 2'd2 | (used == 2'd1 & oldest == 1'b0);
  wire second_is_used = used == 2'd2 | (used == 2'd1 & oldest == 1'b1);
  wire [1:0] in_first = first_is_used ? 2'd1 << first_ray : 2'd0;
  wire [1:0] in_second = second_is_used ? 2'd1 << second_ray : 2'd0;
  wire [1:0] leaving = there_1 ? 2'd1 << ray_1 : 2'd0;
  wire [1:0] leaves_now = freed_2 ? 2'd1 << freed_ray_2 : 2'd0;
  // A ray whose answer has come is in one place: in the queue, at the port, or its number comes back.
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (used <= 2'd2);
    assert (!there || (used != 2'd0 && waiting_word == waiting[oldest]));
    assert ((in_first ^ in_second ^ leaving ^ leaves_now) == answered_rays);
    assert ((in_first & (in_second | leaving | leaves_now)) == 2'd0);
    assert ((in_second & (leaving | leaves_now)) == 2'd0);
    assert ((leaving & leaves_now) == 2'd0);
    assert ((answered_rays & ~flying) == 2'd0);
    assert (!flying[0] || tags[0] == {error_of[0], tag_of[0]});
    assert (!flying[1] || tags[1] == {error_of[1], tag_of[1]});
    // An answer has its ray's tag, and has failed if this was no ray.
    assert (!hit_valid || hit_tag == tag_of[ray_1]);
    assert (!hit_valid || hit_failed == (error_of[ray_1] ? 3'd1 : hit_failed_1));
    // All ones is no hit, of however many bits a number has; but it may be a count.
    assert (!hit_valid || hit_number >> NUMBER_BITS == (&hit_number[NUMBER_BITS-1:0] & ~counts_of[ray_1] ? 32'hffffffff >> NUMBER_BITS : 32'd0));
    cover (hit_valid && used == 2'd1);
    cover (answered_rays == 2'd3);
  end

  // What is given does not change until it is taken.
  reg held;
  reg [39:0] last_given;
  always @(posedge clk) begin
    held <= ~rst & hit_valid & ~hit_ready;
    last_given <= {hit_tag, hit_t, hit_number, hit_failed};
    if (was_reset & ~rst & held)
      assert (hit_valid && {hit_tag, hit_t, hit_number, hit_failed} == last_given);
  end
