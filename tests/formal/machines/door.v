  // Numbers in flight: from the edge at which a ray begins to the edge at which its number comes back.
  reg [1:0] flying;
  always @(posedge clk) begin
    if (rst) flying <= 2'd0;
    else begin
      if (ray_valid & ray_ready) flying[begun_at] <= 1'b1;
      if (freed) flying[freed_ray] <= 1'b0;
    end
  end

  // Only numbers in flight come back. The number of rays is any, and does not change.
  (* anyconst *) reg [1:0] rays;
  always @* begin
    assume (most_rays == rays);
    if (freed) assume (flying[freed_ray]);
  end

  // Whether a number is in the queue of free ones, at a place of it.
  wire first_is_used = free_used == 2'd2 | (free_used == 2'd1 & free_oldest == 1'b0);
  wire second_is_used = free_used == 2'd2 | (free_used == 2'd1 & free_oldest == 1'b1);
  wire [1:0] in_first = first_is_used ? 2'd1 << free_rays[0] : 2'd0;
  wire [1:0] in_second = second_is_used ? 2'd1 << free_rays[1] : 2'd0;
  wire [1:0] is_next = has ? 2'd1 << next : 2'd0;
  wire [1:0] not_given = 2'd3 << given;
  // Every number is in one place.
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (given <= rays && given <= 2'd2);
    assert (free_used <= 2'd2);
    assert (!free_there || (free_used != 2'd0 && free_rays_word == free_rays[free_oldest]));
    assert ((flying ^ in_first ^ in_second ^ is_next ^ not_given) == 2'd3);
    assert ((flying & (in_first | in_second | is_next | not_given)) == 2'd0);
    assert ((is_next & (in_first | in_second | not_given)) == 2'd0);
    assert ((in_first & (in_second | not_given)) == 2'd0);
    assert ((in_second & not_given) == 2'd0);
    cover (flying == 2'd3);
    cover (free_used == 2'd2);
  end
