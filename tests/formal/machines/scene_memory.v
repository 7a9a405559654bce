  // A request stays until it is taken, as those of `requests` do.
  reg waits;
  reg [10:0] waits_for;
  always @(posedge clk) begin
    waits <= ~rst & request_valid & ~request_ready;
    waits_for <= {request_address, request_id};
  end
  always @* if (waits) assume (request_valid && {request_address, request_id} == waits_for);

  // Any block, and the words that were written to it.
  (* anyconst *) reg [3:0] one;
  reg [63:0] own [0:3];
  reg [3:0] has;
  wire stores = word_valid & word_ready;
  always @(posedge clk) begin
    if (rst) has <= 4'd0;
    else if (stores & word_place[5:2] == one) has[word_place[1:0]] <= 1'b1;
    if (stores & word_place[5:2] == one) own[word_place[1:0]] <= word;
  end

  // The request that was taken in the last cycle.
  wire taken = request_valid & request_ready;
  reg taken_before, of_one;
  reg [1:0] id_before;
  always @(posedge clk) begin
    taken_before <= ~rst & taken;
    id_before <= request_id;
    of_one <= request_address[8:5] == one;
  end

  reg [2:0] waited;
  reg stored_before;
  always @(posedge clk) begin
    waited <= ~rst & request_valid & ~request_ready & ~stores ? waited + 3'd1 : 3'd0;
    stored_before <= ~rst & stores;
  end
  wire reads_one = request_valid & request_address[8:5] == one;
  integer w;
  always @(posedge clk) if (was_reset & ~rst) begin
    for (w = 0; w < 4; w = w + 1) assert (!has[w] || blocks[{one, w[1:0]}] == own[w]);
    // The words that have been read of it, the last one in the memory's register.
    assert (count == 2'd0 || waits);
    if (reads_one && count == 2'd1) assert (!has[0] || blocks_word == own[0]);
    if (reads_one && count == 2'd2) assert ((!has[0] || read_word_2_1 == own[0]) && (!has[1] || blocks_word == own[1]));
    if (reads_one && count == 2'd3)
      assert ((!has[0] || read_word_1_1 == own[0]) && (!has[1] || read_word_2_1 == own[1]) &&
              (!has[2] || blocks_word == own[2]));
    // A block comes once, in the cycle after its request was taken, with its identifier and the words last written.
    assert (read_valid == taken_before && !read_error);
    assert (!read_valid || read_id == id_before);
    if (read_valid && of_one) begin
      assert ((!has[0] || read_word_0 == own[0]) && (!has[1] || read_word_1 == own[1]));
      assert ((!has[2] || read_word_2 == own[2]) && (!has[3] || read_word_3 == own[3]));
    end
    // No word is written while a block is read, and one that waits is written before the next block.
    assert (!stores || count == 2'd0);
    assert (waited == {1'b0, count});
    cover (read_valid && of_one && has == 4'd15 && stores && word_place[5:2] == one);
  end
