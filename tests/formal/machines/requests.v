  // The requests that were granted and have not left, the oldest in the low bits.
  reg [1:0] waiting;
  reg [11:0] kept;
  wire enters = asks & granted;
  wire leaves = request_valid & request_ready;
  wire [5:0] request = {triangle, asker, {base, 1'b0} + asked_block};
  wire [1:0] rest = waiting - {1'b0, leaves};
  wire [11:0] shifted = leaves ? kept >> 6 : kept;
  always @(posedge clk) begin
    if (rst) waiting <= 2'd0;
    else waiting <= rest + {1'b0, enters};
    kept <= !enters ? shifted : rest == 2'd0 ? {6'd0, request} : {request, shifted[5:0]};
  end

  always @(posedge clk) if (was_reset & ~rst) begin
    assert (waiting == {1'b0, there_1} + {1'b0, there_2});
    assert (there_1 || !there_2);
    assert (request_valid == (waiting != 2'd0));
    assert (!there_1 || {request_id, request_address} == {kept[5:0], 5'd0});
    assert (!there_2 || {id_2, block_2} == kept[11:6]);
    // One leaves in every cycle if memory takes them.
    assert (granted || waiting == 2'd2);
    cover (waiting == 2'd2 && leaves);
  end

  // What is given does not change until it is taken.
  reg held;
  reg [10:0] last_given;
  always @(posedge clk) begin
    held <= ~rst & request_valid & ~request_ready;
    last_given <= {request_id, request_address};
    if (was_reset & ~rst & held) assert (request_valid && {request_id, request_address} == last_given);
  end
