  // A format's text says `beat_ray`, by whose request a beat comes, and how many rays and ways there are. There are two
  // sets. A line has two blocks, and each comes in a beat.
  localparam LINE = TAG + 1, BLOCK = LINE + 1, PLACE = WAY + 1, PLACES = 2 * WAYS;
  integer r, q, w;
  wire enters_now = asks & granted;
  wire takes_request = request_valid & request_ready;
  wire beat_now = beat_valid & beat_ready;
  wire ends = beat_now & came_of[beat_ray];

  // Memory outside. Rays whose request was taken and whose line has not come whole. Whether its first beat has come,
  // and whether that had an error.
  reg [N-1:0] on_way, came_of, error_of;
  // Any block, and what memory has there. The rays whose request is for its line. The image stays where it is.
  (* anyconst *) reg [BLOCK-1:0] one;
  (* anyconst *) reg [255:0] contents;
  (* anyconst *) reg [LINE-1:0] image;
  reg [N-1:0] asks_one;
  wire [BLOCK-1:0] first_of_one = {image + one[BLOCK-1:1], 1'b0};
  always @(posedge clk) begin
    if (rst) {on_way, came_of, error_of} <= 0;
    else begin
      if (beat_now) came_of[beat_ray] <= ~came_of[beat_ray];
      if (beat_now) error_of[beat_ray] <= (error_of[beat_ray] | beat_error) & ~ends;
      if (ends) on_way[beat_ray] <= 1'b0;
      if (takes_request) on_way[request_id[I-1:0]] <= 1'b1;
    end
    if (takes_request) asks_one[request_id[I-1:0]] <= request_address == {first_of_one, 5'd0};
  end
  wire beat_of_one = beat_now & asks_one[beat_ray];
  always @* begin
    assume (base == image);
    if (beat_valid) assume (on_way[beat_ray]);
    if (beat_valid & ~beat_error & asks_one[beat_ray] & came_of[beat_ray] == one[0])
      assume ({beat_3, beat_2, beat_1, beat_0} == contents);
  end
  // Whether a beat of that line had an error when it came last.
  reg bad;
  always @(posedge clk) if (beat_of_one) bad <= (came_of[beat_ray] & bad) | beat_error;

  // Rays that have asked and not got their block, and what they asked for. Such a ray does not ask again.
  reg [N-1:0] flying;
  reg [BLOCK-1:0] block_of [0:N-1];
  reg [N-1:0] triangle_of;
  wire [N-1:0] in_answer = gives ? 1'b1 << given_id[I-1:0] : 1'b0;
  wire [N-1:0] enters_as = enters_now ? 1'b1 << asker : 1'b0;
  always @(posedge clk) begin
    flying <= rst ? 0 : (flying & ~in_answer) | enters_as;
    if (enters_now) block_of[asker] <= asked_block;
    if (enters_now) triangle_of[asker] <= triangle;
  end
  always @* assume ((enters_as & flying & ~in_answer) == 0);

  // A ray is in the list of a line on its way, with the line's place in the cache, or in the list that gets its blocks.
  // `before` counts the rays of its list that came before it.
  reg [N-1:0] listed, answering;
  reg [PLACE-1:0] of [0:N-1];
  reg [I-1:0] before [0:N-1];
  reg [LINE-1:0] list_line;
  wire [PLACES-1:0] valid_at, coming_at;
  wire [LINE-1:0] line_at [0:PLACES-1];
  wire [I-1:0] newest_at [0:PLACES-1];
`define WAY_AT(W, LINES, COMING, NEWEST) \
  assign {valid_at[W], line_at[W]} = {LINES[0], 1'b0}, {valid_at[WAYS+W], line_at[WAYS+W]} = {LINES[1], 1'b1}; \
  assign {coming_at[W], newest_at[W]} = {COMING[0], NEWEST[0]}; \
  assign {coming_at[WAYS+W], newest_at[WAYS+W]} = {COMING[1], NEWEST[1]};
  `WAY_AT(0, line_0, coming_0, newest_0)
  `WAY_AT(1, line_1, coming_1, newest_1)
`ifdef FOUR_WAYS
  `WAY_AT(2, line_2, coming_2, newest_2)
  `WAY_AT(3, line_3, coming_3, newest_3)
`endif
  // Where the line is that is looked up, or is to be.
  reg [PLACE-1:0] look_place;
  always @* begin
    look_place = 0;
    for (w = 0; w < WAYS; w = w + 1)
      if (known ? valid_in_set[w] & line_at[{look_block[1], w[WAY-1:0]}] == look_block[BLOCK-1:1] : leaving[w])
        look_place = {look_block[1], w[WAY-1:0]};
  end
  wire [WAYS-1:0] valid_in_set = look_block[1] ? valid_at[PLACES-1:WAYS] : valid_at[WAYS-1:0];
  wire [N-1:0] look_bit = 1'b1 << look_ray, list_bit = 1'b1 << list_ray;
  wire [N-1:0] in_door = door_there ? 1'b1 << door_ray : 1'b0, in_look = look_there ? look_bit : 1'b0;
  always @(posedge clk) begin
    if (rst) {listed, answering} <= 0;
    else begin
      if (gives_list) answering[list_ray] <= 1'b0;
      if (joins | misses) listed[look_ray] <= 1'b1;
      for (r = 0; r < N; r = r + 1) if (fills & listed[r] & of[r] == fill_place) begin
        listed[r] <= 1'b0;
        answering[r] <= 1'b1;
      end
    end
    if (joins | misses) of[look_ray] <= look_place;
    if (joins | misses) before[look_ray] <= misses ? 0 : before[newest_at[look_place]] + 1'b1;
    if (fills) list_line <= line_at[fill_place];
  end

  // The rays whose line has not come whole, whether memory has taken the request or not.
  wire [N-1:0] asking = on_way | (asks_line ? 1'b1 << line_id[I-1:0] : 1'b0);
  function [I:0] count(input [N-1:0] rays);
    integer k;
    begin
      count = 0;
      for (k = 0; k < N; k = k + 1) count = count + rays[k];
    end
  endfunction
  function same_list(input [I-1:0] x, input [I-1:0] y);
    same_list = (answering[x] & answering[y]) | (listed[x] & listed[y] & of[x] == of[y]);
  endfunction

  always @(posedge clk) if (was_reset & ~rst) begin
    for (r = 0; r < N; r = r + 1) begin
      // A ray that waits is in one place.
      assert (flying[r] == in_door[r] + in_look[r] + listed[r] + answering[r] + in_answer[r]);
      assert (in_door[r] + in_look[r] + listed[r] + answering[r] + in_answer[r] <= 3'd1);
      // A list is a chain, from its newest ray to the one that asked for the line, through all of its rays.
      if (listed[r] | answering[r]) begin
        assert (links[r][2:0] == {before[r] == 0, block_of[r][0], triangle_of[r]});
        assert (before[r] == 0 || (same_list(r, links[r][3 +: I]) && before[links[r][3 +: I]] == before[r] - 1'b1));
      end
      for (q = 0; q < r; q = q + 1) assert (!same_list(q, r) || before[q] != before[r]);
      if (listed[r]) begin
        assert (coming_at[of[r]] && block_of[r][BLOCK-1:1] == line_at[of[r]]);
        assert (before[r] <= before[newest_at[of[r]]]);
      end
      if (answering[r]) assert (block_of[r][BLOCK-1:1] == list_line && before[r] <= before[list_ray]);
      // A line is asked for by the first ray of its list.
      assert (!asking[r] || (listed[r] && before[r] == 0 && !(filled && fill_place == of[r])));
      assert (!on_way[r] || asks_one[r] == (block_of[r][BLOCK-1:1] == one[BLOCK-1:1]));
      assert ((!came_of[r] || on_way[r]) && (!error_of[r] || came_of[r]));
    end
    assert (gives_list == (answering != 0) && (!gives_list || answering[list_ray]));
    assert (!door_there || look_there);
    assert (!door_there || {block_of[door_ray], triangle_of[door_ray]} == {door_block, door_triangle});
    assert (!look_there || {block_of[look_ray], triangle_of[look_ray]} == {look_block, look_triangle});
    // Each line on its way has a ray, so no more are asked for than there are rays.
    assert (lines == count(asking) && lines <= N);
    assert (!asks_line || !on_way[line_id[I-1:0]]);
    assert (!filled || coming_at[fill_place]);
  end

  // What the sets hold, from when they have been emptied.
  wire [1:0] is_set = {~empties | empty_set > 1, ~empties | empty_set > 0};
  wire [PLACES-1:0] is_place = {{WAYS{is_set[1]}}, {WAYS{is_set[0]}}};
  reg [PLACES-1:0] asked_at;
  always @* begin
    asked_at = filled ? 1'b1 << fill_place : 1'b0;
    for (r = 0; r < N; r = r + 1) if (asking[r]) asked_at = asked_at | 1'b1 << of[r];
  end
  reg was_emptied;
  always @(posedge clk) was_emptied <= empties & ~rst;
  always @(posedge clk) if (was_reset & ~rst) begin
    // A line is marked as on its way exactly if it is asked for and has not come whole, or its list is not taken yet.
    assert ((coming_at & is_place) == asked_at && (asked_at & ~(valid_at & is_place)) == 0);
    for (q = 0; q < PLACES; q = q + 1) if (asked_at[q]) assert (listed[newest_at[q]] && of[newest_at[q]] == q);
    // No set has a line twice, and the next line finds one that is old.
    for (q = 0; q < 2; q = q + 1) if (is_set[q]) begin
      for (w = 1; w < WAYS; w = w + 1) for (r = 0; r < w; r = r + 1)
        assert (!(valid_at[WAYS*q+w] & valid_at[WAYS*q+r]) || line_at[WAYS*q+w] != line_at[WAYS*q+r]);
      assert ((ages[q][WAYS +: WAYS] & ages[q][0 +: WAYS]) != 0);
    end
    // One that leaves was old.
    assert (!ages_change || was_known || (left != 0 && (left & ~(was_high & was_low)) == 0));
    // While the cache empties nothing is on its way. Then it has no line.
    assert (!empties || (flying == 0 && !opens && !filled && lines == 0));
    assert (empties || empty_set == 0);
    assert (!empties || (valid_at & is_place) == 0);
    assert (!was_emptied || empties || valid_at == 0);
  end

  // The line's words where it is in the cache, and where a list of it gets them.
  reg [PLACE-1:0] place_of_one;
  reg one_is_there;
  always @* begin
    {one_is_there, place_of_one} = 0;
    for (w = 0; w < PLACES; w = w + 1) if (is_place[w] & valid_at[w] & line_at[w] == one[BLOCK-1:1])
      {one_is_there, place_of_one} = {1'b1, w[PLACE-1:0]};
  end
  wire [PLACE:0] word_there = {place_of_one, one[0]}, word_given = {list_place, one[0]};
  wire is_there = {words_3[word_there], words_2[word_there], words_1[word_there], words_0[word_there]} == contents;
  wire is_given = {words_3[word_given], words_2[word_given], words_1[word_given], words_0[word_given]} == contents;
  reg was_bad;
  always @(posedge clk) was_bad <= bad;
  always @(posedge clk) if (was_reset & ~rst) begin
    if (one_is_there & ~coming_at[place_of_one]) assert (is_there && !bad);
    for (r = 0; r < N; r = r + 1) if (on_way[r] & came_of[r] & asks_one[r])
      assert (bad == error_of[r] && (one[0] || bad || is_there));
    if (filled & one_is_there & fill_place == place_of_one) assert (fill_error == bad && (bad || is_there));
    if (gives_list & list_line == one[BLOCK-1:1]) assert (list_error == bad && (bad || is_given));
    // No word that is given is read while it is written.
    assert (!(beat_now & (gives_list | hits)) || read_place != {of[beat_ray], came_of[beat_ray]});
    // An answer is that of its ray: memory's words, or an error if a beat of the line had one.
    assert (!gives || given_id == {triangle_of[given_id[I-1:0]], given_id[I-1:0]});
    if (gives & block_of[given_id[I-1:0]] == one) begin
      assert (given_error == was_bad);
      assert (given_error || {read_word_3, read_word_2, read_word_1, read_word_0} == contents);
    end
  end

  // A line is asked for by its address, and only if it is neither there nor on its way. It is asked for only while
  // fewer than `most_lines` are on their way.
  reg had_request;
  reg [BLOCK+4:0] last_address;
  reg [I:0] last_id, lines_before;
  reg [5:0] most_before;
  always @(posedge clk) begin
    had_request <= ~rst & request_valid & ~request_ready;
    {last_address, last_id} <= {request_address, request_id};
    {lines_before, most_before} <= {rst ? {(I+1){1'b0}} : lines, most_lines};
  end
  wire [I-1:0] request_ray = request_id[I-1:0];
  always @* assume (most_lines != 6'd0);
  always @(posedge clk) if (was_reset & ~rst) begin
    if (request_valid) begin
      assert (request_address == {image + block_of[request_ray][BLOCK-1:1], 6'd0});
      assert (request_id == {triangle_of[request_ray], request_ray});
      assert (request_address != {first_of_one, 5'd0} || (on_way & asks_one) == 0);
    end
    assert (!(misses & look_block[BLOCK-1:1] == one[BLOCK-1:1]) || !one_is_there);
    assert (lines <= lines_before || lines <= most_before);
    // What is offered stays until it is taken.
    assert (!had_request || (request_valid && {request_address, request_id} == {last_address, last_id}));
    // What is looked up waits only for a list, a line that has come, a request that is not taken, or for memory.
    assert (!waits || gives_list || fills || holds_line || lines != 0);
  end
