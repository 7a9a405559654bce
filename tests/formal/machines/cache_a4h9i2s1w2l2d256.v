  // Four rays. Beats come in the order of the requests: the identifiers of those that were taken, the first one below.
  localparam I = 2, N = 4, WAYS = 2, WAY = 1, TAG = 2;
  reg [N*I-1:0] kept;
  reg [I:0] taken;
  wire [I:0] rest = taken - {{I{1'b0}}, ends};
  wire [N*I-1:0] shifted = ends ? kept >> I : kept;
  wire [I-1:0] beat_ray = kept[I-1:0];
  always @(posedge clk) begin
    taken <= rst ? {(I+1){1'b0}} : rest + {{I{1'b0}}, takes_request};
    for (r = 0; r < N; r = r + 1) kept[r*I +: I] <= takes_request & rest == r ? request_id[I-1:0] : shifted[r*I +: I];
  end
  // They are those of the rays whose line is on its way, and `asked` has their places in the cache.
  wire [I-1:0] queue_end = oldest + taken[I-1:0];
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (taken + {{I{1'b0}}, asks_line} == lines);
    for (r = 0; r < N; r = r + 1) if (r < taken) begin
      assert (on_way[kept[r*I +: I]] && asked[(oldest + r) % N] == of[kept[r*I +: I]]);
      assert (r == 0 || !came_of[kept[r*I +: I]]);
      for (q = 0; q < r; q = q + 1) assert (kept[r*I +: I] != kept[q*I +: I]);
    end
    assert (!asks_line || asked[queue_end] == of[line_id[I-1:0]]);
    assert (beat_count == (taken != 0 & came_of[beat_ray]));
    assert (had_error == (taken != 0 & error_of[beat_ray]));
  end

  // Any ray, and the cycles since it asked in which memory takes a request that is there, and gives a beat if a line is
  // on its way. In each of them less is left to do before the ray is answered.
  (* anyconst *) reg [I-1:0] our;
  localparam MOST = 7'd40, A_LINE = 7'd3 + N;
  wire memory_goes = (~request_valid | request_ready) & (on_way == 0 | beat_valid);
  reg [6:0] waited;
  always @(posedge clk) waited <= enters_as[our] ? 7'd0 : waited + memory_goes;
  wire [6:0] of_lists = (filled ? 7'd1 + N : 7'd0) + (gives_list ? 7'd1 + before[list_ray] : 7'd0);
  reg [6:0] of_all, of_ours, of_some;
  always @* begin
    of_some = of_lists - beat_count;
    of_ours = of_lists;
    for (r = 0; r < N; r = r + 1) if (r < lines) begin
      of_some = of_some + A_LINE + (r == taken);
      if (of[r == taken ? line_id[I-1:0] : kept[r*I +: I]] == of[our]) of_ours = of_some;
    end
    of_all = of_some;
  end
  wire [6:0] to_do = in_door[our] ? of_all + 7'd10 + 2 * N : in_look[our] ? of_all + 7'd5 + N : listed[our] ? of_ours
                    : answering[our] ? 7'd1 + before[list_ray] - before[our] : 7'd0;
  always @(posedge clk) if (was_reset & ~rst & flying[our]) assert (to_do <= MOST && waited <= MOST - to_do);

  // A block may be read in a beat's cycle. After that a list of three rays is told of an error.
  reg met;
  always @(posedge clk) met <= was_reset & ~rst & (met | (hits & beat_now));
  always @* cover (was_reset & ~rst & gives_list & list_error & before[list_ray] == 2 & met);
