  // A new ray that was taken, until the walker takes it.
  reg waits, waits_ray;
  reg [3:0] waits_length;
  wire taken = new_ray & takes;
  wire handed = starts & walker_takes;
  always @(posedge clk) begin
    if (rst) waits <= 1'b0;
    else waits <= taken | (waits & ~handed);
    if (taken) {waits_ray, waits_length} <= {begun, length};
  end
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (starts == waits);
    assert (!starts || {start_ray, start_cut} == {waits_ray, 1'b0, waits_length[3:1]});
    // One waits at most, and a new one is refused only then or after a comparison.
    assert (takes == ~(waits | divided));
  end

  // Any ray, and where it is: nowhere, here before its walk, on its walk, with a triangle, compared, answered.
  (* anyconst *) reg one;
  (* anyseq *) reg misses;
  localparam [2:0] NOWHERE = 3'd0, NEW = 3'd1, WALKS = 3'd2, TESTS = 3'd3, COMPARED = 3'd4, ANSWERED = 3'd5;
  reg [2:0] at;
  wire begins_one = taken & begun == one;
  wire reads_one = reads & read_ray == one;
  wire done_one = done & asked == one;
  wire leaf_one = leaf_done & leaf_ray == one;
  wire ends_one = ended & walk_ray == one;
  always @(posedge clk) begin
    if (rst) at <= NOWHERE;
    else if (begins_one) at <= NEW;
    else if (at == NEW & handed) at <= WALKS;
    else if (reads_one) at <= TESTS;
    else if (done_one) at <= COMPARED;
    else if (ends_one) at <= ANSWERED;
    else if (at == COMPARED | (at == TESTS & misses)) at <= WALKS;
    else if (at == ANSWERED) at <= NOWHERE;
  end

  // What was given to it: its length, (T, number) of each hit, and what it asks. The best of it; of a ray that counts
  // the sum of sides and the number of hits.
`ifdef QUESTIONS
  localparam SUM_BITS = NUMBER_BITS + 1;
`else
  localparam SUM_BITS = 4;
`endif
  reg any_hit;
  reg [NUMBER_BITS-1:0] tested;
  reg [NUMBER_BITS+SUM_BITS-1:0] least, least_before;
  reg [NUMBER_BITS+3:0] longest;
  wire [NUMBER_BITS+3:0] hit = {t, tested};
`ifdef QUESTIONS
  reg our_counts, our_turned;
  reg [NUMBER_BITS+3:0] our_from;
  wire begins_counting = counts;
  wire before_from = hit < {our_from[NUMBER_BITS+3:NUMBER_BITS], our_from[NUMBER_BITS-1:0] | {NUMBER_BITS{our_counts}}};
  wire [SUM_BITS-1:0] side = hit_back == our_turned ? {SUM_BITS{1'b1}} : 1;
  reg [SUM_BITS-1:0] side_before;
  always @(posedge clk) side_before <= side;
  always @(posedge clk) if (begins_one) {our_counts, our_turned, our_from} <= {counts, turned, from_t, from_number};
`else
  wire our_counts = 1'b0, begins_counting = 1'b0, before_from = 1'b0;
  wire [SUM_BITS-1:0] side = {SUM_BITS{1'b0}};
`endif
  wire improves_one = our_counts ? before_from : hit < least[NUMBER_BITS+3:0] & ~before_from;
  always @(posedge clk) begin
    if (begins_one) any_hit <= any;
    if (begins_one) least <= begins_counting ? {NUMBER_BITS{1'b0}} : {length, {NUMBER_BITS{1'b1}}};
    else if (done_one & improves_one) least <= our_counts ? {least[NUMBER_BITS+SUM_BITS-1:NUMBER_BITS] + side, least[NUMBER_BITS-1:0] + 1'd1} : hit;
    if (begins_one) longest <= {length, {NUMBER_BITS{1'b1}}};
    if (reads_one) tested <= number;
    least_before <= least;
  end

  // The divider asks for a ray while it divides, and compares one cycle before it says so.
  reg asked_1, asked_2, tests_1, tests_2;
  reg [2*NUMBER_BITS+3:0] seen;
`ifdef QUESTIONS
  wire [NUMBER_BITS+3:0] from_shown = {asked_from_t, asked_from_number};
  reg counts_seen;
  reg [NUMBER_BITS+3:0] from_seen;
  always @(posedge clk) {counts_seen, from_seen} <= {asked_counts, from_shown};
`else
  wire counts_seen = 1'b0;
  wire [NUMBER_BITS+3:0] from_seen = {NUMBER_BITS+4{1'b0}};
`endif
  wire seen_before = {t, seen[2*NUMBER_BITS+3:NUMBER_BITS+4]} < {from_seen[NUMBER_BITS+3:NUMBER_BITS], from_seen[NUMBER_BITS-1:0] | {NUMBER_BITS{counts_seen}}};
  wire seen_closer = counts_seen ? seen_before : {t, seen[2*NUMBER_BITS+3:NUMBER_BITS+4]} < seen[NUMBER_BITS+3:0] & ~seen_before;
  always @(posedge clk) begin
    {asked_2, asked_1} <= {asked_1, asked == one};
    {tests_2, tests_1} <= {tests_1, at == TESTS};
    seen <= {asked_number, best, best_number};
  end
  wire seen_one = asked_1 & asked_2 & tests_1 & tests_2 & at == TESTS;

  // The ray is in one place at a time, and `closer` is true to what the divider has seen.
  always @* begin
    if (new_ray & begun == one) assume (at == NOWHERE);
    if (reads_one | leaf_one | ends_one) assume (at == WALKS);
    assume (reads_one + leaf_one + ends_one <= 2'd1);
    if (done_one) assume (seen_one && closer == seen_closer);
  end

  // What was said in the last cycle is passed on.
  reg done_before, leaf_before, ended_before;
  reg [4:0] of_before;
  reg [5:0] said_before;
  reg closer_one, leaf_of_one;
  always @(posedge clk) begin
    {done_before, leaf_before, ended_before} <= {done & ~rst, leaf_done & ~rst, ended & ~rst};
    of_before <= {asked, leaf_ray, walk_ray};
    said_before <= {leaf_stops, leaf_lost, failed};
    closer_one <= done_one & improves_one;
    leaf_of_one <= leaf_one & ~rst;
  end

  wire here = at != NOWHERE;
  always @(posedge clk) if (was_reset & ~rst) begin
    assert ({divided, returns, answers} == {done_before, leaf_before, ended_before});
    assert ({divided_ray, return_ray, answered} == of_before[2:0]);
    assert ({return_stops, return_lost, answer_failed} == said_before);
    // Where the ray is, and what is kept of it.
    assert ((at == NEW) == (waits & waits_ray == one));
    assert ((at == COMPARED) == (divided & divided_ray == one));
    assert ((at == ANSWERED) == (answers & answered == one));
    assert (at <= ANSWERED);
    assert (!here || kinds[one] == any_hit);
    assert (!here || divided_bests[one] == answer_bests[one]);
    assert (!here || leaf_bests[one] == (our_counts ? longest : divided_bests[one]));
    assert (!here || at == COMPARED || divided_bests[one] == least);
    assert (at != TESTS || numbers[one] == tested);
    assert (!seen_one || seen == {tested, least[NUMBER_BITS+3:0]});
    assert (!(asked_1 & tests_1 & at == TESTS) || {asked_number, best, best_number} == {tested, least[NUMBER_BITS+3:0]});
    if (at == COMPARED) begin
      assert (closer_1 == closer_one);
      assert (our_counts | ~closer_1 ? divided_bests[one] == (closer_1 ? least_before : least)
                                     : {t_1, numbers_word} == least);
      assert (divided_stops == (closer_one & any_hit));
    end
    // The best never grows, and the answer and the length after a leaf are the best.
    assert (!here || at == NEW || our_counts || least <= least_before);
    assert (at != ANSWERED || {answer_t, answer_number} == least);
    assert (!leaf_of_one || return_cut == {1'b0, our_counts ? longest[NUMBER_BITS+3:NUMBER_BITS+1] : least[NUMBER_BITS+3:NUMBER_BITS+1]});
`ifdef QUESTIONS
    // What it asks stays, and is shown beside its best hit.
    assert (!here || {questions[one], froms[one]} == {our_counts, our_turned, our_from});
    assert (!(asked_1 & at == TESTS) || {asked_counts, from_shown} == {our_counts, our_from});
    assert (!seen_one || {counts_seen, from_seen} == {our_counts, our_from});
    if (at == COMPARED) begin
      assert ({questions_word, divided_bests_word} == {questions[one], divided_bests[one]});
      assert (!closer_1 || !our_counts || least == {least_before[NUMBER_BITS+SUM_BITS-1:NUMBER_BITS] + side_before,
                                                    least_before[NUMBER_BITS-1:0] + 1'd1});
    end
    cover (at == ANSWERED && our_counts && least[NUMBER_BITS-1:0] == 2 && least[NUMBER_BITS+SUM_BITS-1:NUMBER_BITS] == 0);
`endif
    cover (at == ANSWERED && ~&least[NUMBER_BITS-1:0]);
    cover (at == COMPARED && !closer_one && ~&least[NUMBER_BITS-1:0]);
  end
