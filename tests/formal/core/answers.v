  // Text inside the core. Memory gives any words, any time after it was asked; a reset may come in any cycle.
  reg began = 1'b0;
  always @(posedge clk) began <= 1'b1;
  always @* if (!began) assume (rst);
  (* anyconst *) reg [2:0] any_base;
  (* anyconst *) reg [3:0] any_last;
  (* anyconst *) reg [19:0] any_steps;
  (* anyconst *) reg [1:0] any_rays;
  always @* assume ({base, last, most_steps, most_rays} == {any_base, any_last, any_steps, any_rays});

  // Requests whose block has not come, by identifier. A reset comes when none is, or their blocks are dropped: the
  // registers and the epoch see to that.
  reg [3:0] asked = 4'd0;
  wire asks_now = request_valid & request_ready;
  wire [1:0] of_ray = {asked[3] | asked[1], asked[2] | asked[0]};
  always @(posedge clk) begin
    if (rst) asked <= 4'd0;
    else asked <= (asked & ~(read_valid ? 4'd1 << read_id : 4'd0)) | (asks_now ? 4'd1 << request_id : 4'd0);
  end
  always @* if (read_valid) assume (asked[read_id]);

  // Any tag: how many of its rays are in the core.
  (* anyconst *) reg [1:0] one;
  reg [2:0] in_core = 3'd0;
  wire takes_one = ray_valid & ray_ready & ray_tag == one;
  wire answers_one = hit_valid & hit_ready & hit_tag == one;
  always @(posedge clk) in_core <= rst ? 3'd0 : in_core + takes_one - answers_one;

`ifdef HELD
  // To go further: no reset but the first, and rays, requests, blocks and answers wait in so many cycles, whichever.
  reg [3:0] held = 4'd0;
  wire holds = ~hit_ready | ~request_ready | (asked != 4'd0 & ~read_valid) | ~ray_valid;
  always @(posedge clk) held <= rst ? 4'd0 : held + holds;
  always @* assume (rst == !began && held <= `HELD);
`endif

  reg hit_waits = 1'b0, request_waits = 1'b0;
  reg [43:0] hit_was;
  reg [10:0] request_was;
  always @(posedge clk) begin
    hit_waits <= hit_valid & ~hit_ready & ~rst;
    request_waits <= request_valid & ~request_ready & ~rst;
    hit_was <= {hit_tag, hit_failed, hit_number, hit_t};
    request_was <= {request_address, request_id};
  end

  wire [8:0] from_base = request_address - {base, 6'd0};
  always @* if (began & ~rst) begin
`ifdef ANSWERS
    // An answer is of a ray in the core, so none comes twice, and none of before a reset.
    assert (!hit_valid || hit_tag != one || in_core != 3'd0);
    assert (in_core <= 3'd2);
`endif
`ifdef STAYS
    assert (!hit_waits || (hit_valid && {hit_tag, hit_failed, hit_number, hit_t} == hit_was));
    assert (!request_waits || (request_valid && {request_address, request_id} == request_was));
`endif
`ifdef INSIDE
    assert (!request_valid || (from_base[4:0] == 5'd0 && from_base[8:5] <= last));
`endif
`ifdef ONCE
    assert (!request_valid || !of_ray[request_id[0]]);
`endif
  end

  // A cover, as an assertion that must fail: two rays, in the core at once, have both met a triangle.
  reg [1:0] all_in = 2'd0, met = 2'd0;
  reg both = 1'b0;
  wire taken = ray_valid & ray_ready, answered = hit_valid & hit_ready;
  always @(posedge clk) begin
    all_in <= rst ? 2'd0 : all_in + taken - answered;
    both <= ~rst & (both | (all_in == 2'd2));
    met <= rst ? 2'd0 : met + (answered & hit_failed == 3'd0 & ~&hit_number);
  end
`ifdef REACHED
  always @* assume (hit_ready && request_ready && read_valid == (asked != 4'd0) && rst == !began);
  always @* if (began & ~rst) assert (!(both && met == 2'd2));
`endif
