  // One identifier, `one`: its requests, its blocks, and the cycles between them, counted again. And all blocks.
  (* anyconst *) wire [1:0] one;
  wire asks_one = request_valid & request_ready & request_id == one;
  wire comes_one = read_valid & read_id == one;
  reg flying, came_one;
  reg [2:0] age, came_age, most_of_one, all;
  always @(posedge clk) begin
    age <= asks_one ? 3'd1 : age + 3'd1;
    flying <= asks_one | (flying & ~comes_one);
    came_one <= comes_one;
    came_age <= age;
    if (came_one & most_of_one < came_age) most_of_one <= came_age;
    all <= all + {2'd0, read_valid};
    if (rst) {flying, came_one, most_of_one, all} <= 8'd0;
  end
  always @* if (comes_one) assume (flying);
  always @* if (asks_one) assume (!flying);

  always @* if (was_reset) begin
    assert (!flying || now - asked_at[one] + 3'd1 == age);
    assert (!came_one || (came && latency == came_age));
    assert (longest >= most_of_one);
    assert (reads + {2'd0, came} == all);
  end
  always @* cover (came_one && came_age == 3'd5);
