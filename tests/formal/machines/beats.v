  // The requests that have not had their last beat, the oldest in the low bits, and the beats of that one which have
  // come. A format's text says WIDTH, LAST and `request`, and what words a block has.
  reg [1:0] waiting, came;
  reg [2*WIDTH-1:0] kept;
  wire enters_now = request_valid & request_ready;
  wire beat_now = beat_valid & beat_ready;
  wire ends = beat_now & came == LAST;
  wire [1:0] rest = waiting - {1'b0, ends};
  wire [2*WIDTH-1:0] shifted = ends ? kept >> WIDTH : kept;
  always @(posedge clk) begin
    if (rst) {waiting, came} <= 4'd0;
    else begin
      waiting <= rest + {1'b0, enters_now};
      if (beat_now) came <= ends ? 2'd0 : came + 2'd1;
    end
    kept <= !enters_now ? shifted : rest == 2'd0 ? {{WIDTH{1'b0}}, request} : {request, shifted[WIDTH-1:0]};
  end

  // Rays with a request on its way, until the core has seen its block. Such a ray does not ask.
  reg [1:0] flying;
  always @(posedge clk) begin
    if (rst) flying <= 2'd0;
    else begin
      if (read_valid) flying[read_id[0]] <= 1'b0;
      if (enters_now) flying[request_id[0]] <= 1'b1;
    end
  end
  always @* if (enters_now) assume (!flying[request_id[0]]);

  // The block that is to be there after a last beat.
  reg block, asked_before;
  reg [1:0] block_id;
  always @(posedge clk) begin
    block <= ~rst & ends;
    block_id <= kept[1:0];
    asked_before <= enters_now;
  end

  wire [1:0] in_first = waiting != 2'd0 ? 2'd1 << kept[0] : 2'd0;
  wire [1:0] in_second = waiting == 2'd2 ? 2'd1 << kept[WIDTH] : 2'd0;
  wire [1:0] in_block = block ? 2'd1 << block_id[0] : 2'd0;
  always @(posedge clk) if (was_reset & ~rst) begin
    // A request is in one place, so two words are enough.
    assert (waiting <= 2'd2 && used == waiting);
    assert (!enters_now || waiting != 2'd2);
    assert ((in_first ^ in_second ^ in_block) == flying);
    assert ((in_first & in_second) == 2'd0 && ((in_first | in_second) & in_block) == 2'd0);
    assert (waiting == 2'd0 || askers[oldest] == kept[WIDTH-1:0]);
    assert (waiting != 2'd2 || askers[~oldest] == kept[2*WIDTH-1:WIDTH]);
    assert (!there || askers_word == kept[WIDTH-1:0]);
    // A beat is taken only if someone has asked, and then from the second cycle on.
    assert (!beat_ready || waiting != 2'd0);
    assert (beat_ready || waiting == {1'b0, waiting != 2'd0 & asked_before});
    assert (came <= LAST && (came == 2'd0 || waiting != 2'd0));
    // A block comes after its last beat, for the oldest request.
    assert (read_valid == block);
    assert (!read_valid || read_id == block_id);
    cover (waiting == 2'd2 && ends);
    cover (read_valid && beat_now);
  end
