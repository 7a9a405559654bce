  // Rays whose hit has come and is not compared yet. Such a ray is tested no more.
  reg [1:0] dividing;
  wire enters_now = tested & hit;
  always @(posedge clk) begin
    if (rst) dividing <= 2'd0;
    else begin
      if (enters_now) dividing[tester] <= 1'b1;
      if (done) dividing[asked] <= 1'b0;
    end
  end
  always @* if (enters_now) assume (!dividing[tester]);

  // The divided one stays in the queue until it is compared.
  wire first_is_used = used == 2'd2 | (used == 2'd1 & oldest == 1'b0);
  wire second_is_used = used == 2'd2 | (used == 2'd1 & oldest == 1'b1);
  wire [1:0] in_first = first_is_used ? 2'd1 << rays[0] : 2'd0;
  wire [1:0] in_second = second_is_used ? 2'd1 << rays[1] : 2'd0;
  wire [1:0] answered = answers ? 2'd1 << at : 2'd0;

  // What the divider is shown of the ray that it asked for.
  reg last_asked, asked_before;
  reg [31:0] shown_number, shown_best_number;
  reg [6:0] shown_best;
  always @(posedge clk) begin
    last_asked <= asked;
    asked_before <= last_asked;
    shown_number <= asked_number;
    shown_best_number <= best_number;
    shown_best <= best;
  end

  always @(posedge clk) if (was_reset & ~rst) begin
    // A hit is compared once: its ray is in one place.
    assert (used <= 2'd2);
    assert (!there || (used != 2'd0 && rays_word == rays[oldest]));
    assert ((in_first ^ in_second ^ answered) == dividing);
    assert ((in_first & (in_second | answered)) == 2'd0 && (in_second & answered) == 2'd0);
    assert ((left != 0) + compares + answers <= 2'd1);
    if (left != 0 || compares) assert (used != 2'd0 && at == rays[oldest]);
    // It asks for one ray in three cycles, and compares what it was shown in the second of them.
    if (compares) assert (last_asked == at);
    if (done) begin
      assert (last_asked == asked && asked_before == asked);
      assert (closer == ({t, shown_number} < {shown_best, shown_best_number}));
    end
    cover (done && closer && used == 2'd1);
  end
