  // What any host may do.
  // The settings stay.
  localparam [15:0] places = 16'd8;
  always @* assume (ring_last == places - 16'd1);

  // The host offers any number, at any time. No ray is asked for that has no place: of those that were, the answers of at
  // most as many are not in memory. None is asked for that was not offered.
  wire [15:0] without_answer = asked_for - in_memory;
  // Rays that were given and answers that were taken, of all.
  reg [15:0] given, entered;
  always @(posedge clk) begin
    given <= rst ? 16'd0 : given + (ray_valid & ray_taken);
    entered <= rst ? 16'd0 : entered + (hit_valid & hit_ready);
  end
  wire [15:0] in_core = given - entered, not_in_memory = sent - in_memory;
  // The core answers rays that it has. Memory says that it has answers when all of them were put.
  always @* begin
    if (hit_valid) assume (entered != given);
    if (stored_valid) assume (storing & left == 3'd0 & ~stores);
    if (fetched_valid) assume (come < held);
  end
  wire [2:0] stored_answers = stores_four ? 3'd4 : 3'd1;
  reg [15:0] in_memory_was, offered_was, offered_before;
  reg asks_now, was_offered, too_many_were;
  wire no_room = fresh > places || unanswered > places || unanswered == 16'd0;
  always @(posedge clk) begin
    in_memory_was <= rst ? 16'd0 : in_memory;
    offered_was <= rst ? 16'd0 : rays_offered;
    offered_before <= rst ? 16'd0 : offered_was;
    too_many_were <= ~rst & (too_many_were | (fresh != 16'd0 & no_room));
    asks_now <= ~rst & ~fetch_valid;
    was_offered <= accepted - asked_for >= (four_rays ? 16'd4 : 16'd1);
    if (was_reset & ~rst) begin
      assert (held <= 5'd16 && come <= held && given + held == asked_for);
      assert (waiting <= 5'd16 && entered == sent + waiting && left <= waiting && left <= stored_answers);
      assert (storing || (left == 3'd0 && !stores));
      assert (unwritten ? !storing : in_memory == (storing ? sent - (stored_answers - left) : sent));
      assert (announced == offered_was && fresh == offered_was - offered_before);
      assert (unanswered == offered_was - in_memory_was);
      assert (overfull || accepted == offered_before);
      assert (in_core <= places && not_in_memory <= 16'd4);
      assert (!(asks_now & fetch_valid) || was_offered);
      assert (overfull == too_many_were);
      assert (accepted - in_memory_was <= places && without_answer <= accepted - in_memory);
      assert (in_memory - in_memory_was <= 16'd4 && in_memory - in_memory_was <= accepted - in_memory_was);
    end
  end
  always @(posedge clk) if (was_reset & ~rst) cover (fetch_valid && fetch_four);
