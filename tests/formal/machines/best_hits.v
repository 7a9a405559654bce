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

  // What was given to it: its length, and (T, number) of each hit. The best of it.
  reg any_hit;
  reg [31:0] tested;
  reg [35:0] least, least_before;
  wire [35:0] hit = {t, tested};
  always @(posedge clk) begin
    if (begins_one) {any_hit, least} <= {any, length, 32'hffffffff};
    else if (done_one & hit < least) least <= hit;
    if (reads_one) tested <= number;
    least_before <= least;
  end

  // The divider asks for a ray while it divides, and compares one cycle before it says so.
  reg asked_1, asked_2, tests_1, tests_2;
  reg [67:0] seen;
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
    if (done_one) assume (seen_one && closer == ({t, seen[67:36]} < seen[35:0]));
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
    closer_one <= done_one & hit < least;
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
    assert (!here || (divided_bests[one] == leaf_bests[one] && divided_bests[one] == answer_bests[one]));
    assert (!here || at == COMPARED || divided_bests[one] == least);
    assert (at != TESTS || numbers[one] == tested);
    assert (!seen_one || seen == {tested, least});
    assert (!(asked_1 & tests_1 & at == TESTS) || {asked_number, best, best_number} == {tested, least});
    if (at == COMPARED) begin
      assert (closer_1 == closer_one);
      assert (closer_1 ? {t_1, numbers_word} == least : divided_bests[one] == least);
      assert (divided_stops == (closer_one & any_hit));
    end
    // The best never grows, and the answer and the length after a leaf are the best.
    assert (!here || at == NEW || least <= least_before);
    assert (at != ANSWERED || {answer_t, answer_number} == least);
    assert (!leaf_of_one || return_cut == {1'b0, least[35:33]});
    cover (at == ANSWERED && least[31:0] != 32'hffffffff);
    cover (at == COMPARED && !closer_one && least[31:0] != 32'hffffffff);
  end
