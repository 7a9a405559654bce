  // Four beats a block, the lowest words first.
  localparam WIDTH = 2;
  localparam [1:0] LAST = 2'd3;
  wire [1:0] request = request_id;

  // Each word of the oldest block that has come; after the last one it is the block's.
  reg [63:0] own [0:3];
  reg errors;
  wire [63:0] words [0:3];
  assign words[0] = read_word_0_1, words[1] = read_word_1_1, words[2] = read_word_2_1, words[3] = read_word_3_1;
  always @(posedge clk) if (beat_valid & beat_ready) begin
    own[came] <= beat_0;
    errors <= beat_error | (came != 2'd0 & errors);
  end
  // The words that have come are the upper ones.
  integer w;
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (count == came);
    assert (!read_valid || came == 2'd0);
    assert (!read_valid || {read_word_3, read_word_2, read_word_1, read_word_0} == {own[3], own[2], own[1], own[0]});
    // A block with an error in a beat is one.
    assert (came == 2'd0 || read_error == errors);
    assert (!read_valid || read_error == errors);
    for (w = 0; w < 3; w = w + 1)
      assert (w >= came || words[w + 4 - came] == own[w]);
  end

