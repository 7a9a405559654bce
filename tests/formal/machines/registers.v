  // A format's text says what more there is: words, bits of the status, whether answers pass by leave of this machine.
  // What was accepted and not done: a write's address and word, its answer, a read's address, what is given.
  reg aw_here, w_here, b_waits, ar_here, r_waits;
  reg [5:0] aw_at, ar_at;
  reg [31:0] w_word, r_word;
  reg [3:0] w_bytes;
  wire does_write = aw_here & w_here & ~b_waits;
  wire does_read = ar_here & (~r_waits | rready);

  // The registers. A write changes the bytes that have a strobe; what is too large becomes the largest.
  reg [2:0] base_is;
  reg [33:0] cycles, rays, answered, hits, records, triangles, idles, refusals;
  reg [3:0] last_is;
  reg [19:0] steps_are;
  reg [1:0] most_are;
  reg [6:0] wrong;
  wire [31:0] bytes = {{8{w_bytes[3]}}, {8{w_bytes[2]}}, {8{w_bytes[1]}}, {8{w_bytes[0]}}};
  function [31:0] changed(input [31:0] old);
    changed = (old & ~bytes) | (w_word & bytes);
  endfunction
  wire [31:0] new_base = changed({23'd0, base_is, 6'd0}), new_last = changed({28'd0, last_is});
  wire [31:0] new_steps = changed({12'd0, steps_are}), new_most = changed({30'd0, most_are});
  function writes_at(input [5:0] place);
    writes_at = does_write & aw_at == place;
  endfunction

  // What passes, and a soft reset: it begins, what is offered is taken, blocks come home, and the core is reset.
  reg [5:0] in_core;
  reg [1:0] at_memory;
  reg resetting, reset_now;
  wire ray_passes = ray_valid & ray_ready, hit_passes = hit_valid & hit_ready;
  wire asks = request_valid & request_ready;
  wire begins = writes_at(6'd3) & w_bytes[0] & w_word[0];
  // Only what is in the core comes out, and only what was asked for comes. What does not pass is not offered.
  always @* begin
    if (hit_passes) assume (in_core != 6'd0);
    if (ray_passes) assume (in_core != 6'd63 && (lets_rays || !gates));
    if (read_valid) assume (at_memory != 2'd0);
    if (asks) assume (at_memory != 2'd3);
    if (request_valid) assume (lets_requests);
    if (hit_valid) assume (lets_answers || !gates);
    if (request_was) assume (request_valid || !lets_requests);
    if (hit_was) assume (hit_valid || !lets_answers);
    if (resets) assume (!ray_passes || !gates);
  end
  reg request_was, hit_was;
  always @(posedge clk) begin
    request_was <= ~rst & request_valid & ~request_ready;
    hit_was <= ~rst & hit_valid & ~hit_ready;
  end

  always @(posedge clk) begin
    if (rst) begin
      {aw_here, w_here, b_waits, ar_here, r_waits} <= 5'd0;
      {base_is, last_is, most_are, wrong, in_core, at_memory, resetting, reset_now} <= 26'd0;
      steps_are <= 20'hfffff;
      {cycles, rays, answered, hits, records, triangles, idles, refusals} <= 272'd0;
    end else begin
      aw_here <= aw_here ? ~does_write : awvalid;
      w_here <= w_here ? ~does_write : wvalid;
      b_waits <= does_write | (b_waits & ~bready);
      ar_here <= ar_here ? ~does_read : arvalid;
      r_waits <= does_read | (r_waits & ~rready);
      if (writes_at(6'd4)) base_is <= new_base[8:6];
      if (writes_at(6'd6)) last_is <= new_last > 32'd15 ? 4'd15 : new_last[3:0];
      if (writes_at(6'd7)) steps_are <= new_steps > 32'hfffff ? 20'hfffff : new_steps[19:0];
      if (resetting) most_are <= 2'd0;
      else if (writes_at(6'd8)) most_are <= new_most > 32'd3 ? 2'd3 : new_most[1:0];
      wrong <= (wrong & ~(writes_at(6'd2) ? w_word[15:9] & bytes[15:9] : 7'd0)) |
               {writes_at(6'd4) & w_bytes[0] & w_word[5:0] != 6'd0, read_valid & read_error,
                hit_passes & hit_failed == 3'd5, hit_passes & hit_failed == 3'd4, hit_passes & hit_failed == 3'd3,
                hit_passes & hit_failed == 3'd2, hit_passes & hit_failed == 3'd1};
      in_core <= reset_now ? 6'd0 : in_core + ray_passes - hit_passes;
      at_memory <= reset_now ? 2'd0 : at_memory + asks - read_valid;
      resetting <= begins | (resetting & ~reset_now);
      reset_now <= ~reset_now & resetting & ~lets_requests & ~answers_left & at_memory == 2'd0;
      if (writes_at(6'd9)) {cycles, rays, answered, hits, records, triangles, idles, refusals} <= 272'd0;
      else begin
        cycles <= cycles + 34'd1;
        rays <= rays + ray_passes;
        answered <= answered + hit_passes;
        hits <= hits + (hit_passes & hit_failed == 3'd0 & hit_number != 32'hffffffff);
        records <= records + (asks & ~request_id[1]);
        triangles <= triangles + (asks & request_id[1]);
        idles <= idles + (request_valid ? 34'd0 : 34'd1);
        refusals <= refusals + (request_valid & ~request_ready);
      end
    end
    if (!aw_here) aw_at <= awaddr[7:2];
    if (!w_here) {w_word, w_bytes} <= {wdata, wstrb};
    if (!ar_here) ar_at <= araddr[7:2];
    if (does_read) r_word <= word_at(ar_at);
  end

  function [31:0] word_at(input [5:0] place);
    case (place)
      6'd0: word_at = 32'h48697470;
      6'd1: word_at = 32'd3;
      6'd2: word_at = {13'd0, more_wrong, wrong, 7'd0, resetting, in_core == 6'd0 & ~resetting & ~more_busy};
      6'd4: word_at = {23'd0, base_is, 6'd0};
      6'd6: word_at = last_is;
      6'd7: word_at = steps_are;
      6'd8: word_at = most_are;
      6'd10: word_at = about_format;
      6'd11: word_at = about_shape;
      6'd12: word_at = about_ports;
      6'd14: word_at = about_limits;
      6'd16: word_at = cycles[31:0];
      6'd17: word_at = {30'd0, cycles[33:32]};
      6'd18: word_at = rays[31:0];
      6'd19: word_at = {30'd0, rays[33:32]};
      6'd20: word_at = answered[31:0];
      6'd21: word_at = {30'd0, answered[33:32]};
      6'd22: word_at = hits[31:0];
      6'd23: word_at = {30'd0, hits[33:32]};
      6'd24: word_at = records[31:0];
      6'd25: word_at = {30'd0, records[33:32]};
      6'd26: word_at = triangles[31:0];
      6'd27: word_at = {30'd0, triangles[33:32]};
      6'd28: word_at = idles[31:0];
      6'd29: word_at = {30'd0, idles[33:32]};
      6'd30: word_at = refusals[31:0];
      6'd31: word_at = {30'd0, refusals[33:32]};
      default: word_at = more_at(place);
    endcase
  endfunction

  always @(posedge clk) if (was_reset & ~rst) begin
    // Each access is answered once, with what the register holds, and the answer stays until it is taken.
    assert ({awready, wready, bvalid, arready, rvalid} == {~aw_here, ~w_here, b_waits, ~ar_here, r_waits});
    assert (!rvalid || rdata == r_word);
    assert ({bresp, rresp} == 4'd0);
    assert (!aw_here || write_place == aw_at);
    assert (!w_here || {written_word, strobes} == {w_word, w_bytes});
    assert (!ar_here || read_place == ar_at);
    // The registers are what was written.
    assert ({base, last, most_steps, most_rays} == {base_is, last_is, steps_are, most_are});
    assert (sticky_r == wrong);
    assert ({count_cycles, count_rays, count_answers, count_hits} == {cycles, rays, answered, hits});
    assert ({count_records, count_triangles, count_idle, count_refused} == {records, triangles, idles, refusals});
    // A soft reset. What was offered and not taken still passes; nothing new does.
    assert ({flying, reading} == {in_core, at_memory});
    assert ({stops, resets} == {resetting, reset_now});
    assert (lets_rays == (~resetting & most_are != 2'd0));
    assert (resetting || (lets_requests && lets_answers));
    assert (!resetting || lets_requests == request_was);
    assert (!resetting || !gates || lets_answers == hit_was);
    assert (!reset_now || (resetting && at_memory == 2'd0 && !lets_requests && (!lets_answers || !gates)));
    cover (reset_now && in_core != 6'd0);
    cover (rvalid && rdata == 32'h00008002);
  end
