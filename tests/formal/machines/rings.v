  // A format's text says how many beats a ray has, what a beat has at each of its places, and which bits of an answer
  // are put.
  // The settings stay.
  (* anyconst *) reg [1:0] rays_base, answers_base;
  (* anyconst *) reg [15:0] mask;
  always @* assume ({rays_at, answers_at, ring_last} == {rays_base, answers_base, mask});

  // No more rays are accepted than a ring has places. rings_h10g1t4d128_alone.v proves that, whatever the host offers. None
  // is asked for that was not accepted.
  wire [15:0] ahead = accepted - asked_for;
  always @* assume (ahead <= 16'h8000);

  // Rays that have come whole, and that were given, of all; beats that memory owes, and those of the ray that is coming.
  reg [15:0] arrived, given;
  reg [6:0] owed;
  reg [1:0] own_beat;
  wire [2:0] fetched_rays = fetch_four ? 3'd4 : 3'd1;
  wire whole = fetched_valid & own_beat == (1 << LOG) - 1;
  always @(posedge clk) begin
    arrived <= rst ? 16'd0 : arrived + whole;
    given <= rst ? 16'd0 : given + (ray_valid & ray_taken);
    own_beat <= rst | whole ? 2'd0 : own_beat + fetched_valid;
    owed <= rst ? 7'd0 : owed + (fetch_valid & fetch_ready ? {4'd0, fetched_rays} << LOG : 7'd0) - fetched_valid;
  end
  always @* if (fetched_valid) assume (owed != 7'd0);

  // Any ray, what memory has of it, and whether a beat of it had an error when it was read.
  (* anyconst *) reg [15:0] one;
  (* anyconst *) reg [255:0] contents;
  wire [255:0] piece = ({256{1'b1}} >> (256 - (256 >> LOG))) << ({8'd0, own_beat} << (8 - LOG));
  wire beat_of_one = fetched_valid & arrived == one;
  always @* if (beat_of_one) assume (((beats_now ^ contents) & piece) == 256'd0);
  reg bad;
  always @(posedge clk) if (beat_of_one) bad <= (bad & own_beat != 2'd0) | fetched_error;
  wire [8:0] next_fetch = {rays_base, 7'd0} + {(asked_for - fetched_rays) & mask, 5'd0};
  wire [15:0] before_one = one - given;
  wire one_is_here = before_one < come;
  wire [255:0] kept_of_one = {rays_3[one[3:0]], rays_2[one[3:0]], rays_1[one[3:0]], rays_0[one[3:0]]};
  wire [255:0] come_of_one = ~({256{1'b1}} << ({8'd0, own_beat} << (8 - LOG)));

  always @(posedge clk) if (was_reset & ~rst) begin
    assert (held <= 5'd16 && come <= held);
    assert (beat == own_beat && owed <= 7'd64);
    assert (given + come == arrived && first_ray == given[3:0] && given + held == asked_for);
    // What was asked for has come, is on its way, or is shown.
    assert (owed + (fetches ? {4'd0, fetched_rays} << LOG : 7'd0) + own_beat == ({2'd0, held} - come) << LOG);
    assert (!fetch_valid || (fetch_four ? asked_for[1:0] == 2'd0 : 1'b1));
    assert (!fetch_valid || fetch_address == next_fetch);
    // The ray is given as memory has it, and is none if a beat had an error.
    assert (!one_is_here || (kept_of_one == contents && spoilt[one[3:0]] == bad));
    assert (arrived != one || own_beat == 2'd0 || ((kept_of_one ^ contents) & come_of_one) == 256'd0);
    assert (arrived != one || own_beat == 2'd0 || spoils == bad);
    assert (own_beat != 2'd0 || !spoils);
    if (ray_valid && given == one) begin
      assert ({ray_dz, ray_dy, ray_dx, ray_oz, ray_oy, ray_ox} == contents[191:0]);
      assert ({ray_any, ray_tag} == {contents[248], contents[224]});
      assert (ray_len == (contents[223:192] | {32{bad}}));
    end
    cover (ray_valid && given == one && one == 16'd2 && fetch_four);
  end

  // Answers that were taken, of all; any of them, and what it was.
  reg [15:0] entered;
  (* anyconst *) reg [15:0] two;
  reg [39:0] kept;
  wire enters = hit_valid & hit_ready;
  always @(posedge clk) begin
    entered <= rst ? 16'd0 : entered + enters;
    if (enters && entered == two) kept <= {hit_failed, hit_tag, hit_t, hit_number};
  end
  wire [15:0] before_two = two - sent;
  wire [127:0] answer = {60'd0, kept[35:32], 5'd0, kept[39:37], 23'd0, kept[36], kept[31:0]};
  // Memory says that it has answers when all of them were put, and their address was taken.
  always @* if (stored_valid) assume (storing & left == 3'd0 & ~stores);
  wire [2:0] stored_answers = stores_four ? 3'd4 : 3'd1;
  wire [15:0] first_stored = sent - (stored_answers - left);
  // An answer that could not be written: none is written behind it, and none is said to be.
  reg failed;
  reg [15:0] last_there;
  reg stood;
  always @(posedge clk) stood <= ~rst & ~fetches & (failed | overfull);
  wire fetches_begins = stood & fetches;
  always @(posedge clk) begin
    failed <= ~rst & (failed | (stored_valid & stored_error));
    if (!failed) last_there <= rst ? 16'd0 : in_memory;
    if (was_reset & ~rst) begin
      assert (ring_flaws[2:1] == {overfull, failed});
      assert (!failed || (in_memory == last_there && !storing && !fetches_begins));
      assert (!overfull || !fetches_begins);
    end
  end
  wire [8:0] next_store = {answers_base, 7'd0} + {first_stored & mask, 4'd0};
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (waiting <= 5'd16 && entered == sent + waiting);
    assert (left <= waiting && left <= stored_answers);
    assert (storing || (left == 3'd0 && !stores));
    assert (before_two >= waiting || answers[two[3:0]] == kept);
    // It is written once, as it was, to its place.
    assert (!put_valid || sent != two || ((puts_now ^ answer) & puts) == 128'd0);
    assert (put_last == (left == 3'd1 && last_half));
    assert (!storing || !stores_four || first_stored[1:0] == 2'd0);
    assert (!store_valid || store_address == next_store);
    // What is said to be in memory is.
    assert (failed || in_memory == (storing ? first_stored : sent));
    assert (ring_quiet == (owed == 7'd0 && own_beat == 2'd0 && !fetches && !storing));
    cover (in_memory == 16'd4);
  end

  // What is offered does not change until it is taken.
  reg asks, writes, beats;
  reg [9:0] read_offered, write_offered;
  reg [128:0] beat_offered;
  always @(posedge clk) begin
    asks <= ~rst & fetch_valid & ~fetch_ready;
    writes <= ~rst & store_valid & ~store_ready;
    beats <= ~rst & put_valid & ~put_ready;
    read_offered <= {fetch_address, fetch_four};
    write_offered <= {store_address, store_four};
    beat_offered <= {puts_now, put_last};
    if (was_reset & ~rst) begin
      if (asks) assert (fetch_valid && {fetch_address, fetch_four} == read_offered);
      if (writes) assert (store_valid && {store_address, store_four} == write_offered);
      if (beats) assert (put_valid && {puts_now, put_last} == beat_offered);
    end
  end
