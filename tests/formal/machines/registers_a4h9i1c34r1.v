  // With rings nothing between the core and them waits for this machine. A reset waits until they are quiet.
  wire gates = 1'b0, answers_left = ~ring_quiet, more_busy = ring_busy;
  reg [2:0] more_wrong;
  reg [1:0] rays_are, answers_are;
  reg [15:0] places_are, offered_are;
  reg [16:0] interrupt_is;
  reg interrupts_are;
  wire [31:0] new_rays = changed({23'd0, rays_are, 7'd0}), new_answers = changed({23'd0, answers_are, 7'd0});
  wire [31:0] new_places = changed({16'd0, places_are}), new_offered = changed({16'd0, offered_are});
  wire [31:0] new_interrupt = changed({15'd0, interrupt_is});
  wire [15:0] behind = ring_answers - interrupt_is[15:0];
  always @(posedge clk) begin
    if (rst) {more_wrong, rays_are, answers_are, places_are, offered_are, interrupt_is, interrupts_are} <= 57'd0;
    else begin
      if (writes_at(6'd38)) rays_are <= new_rays[8:7];
      if (writes_at(6'd40)) answers_are <= new_answers[8:7];
      if (writes_at(6'd42)) places_are <= new_places > 32'hffff ? 16'hffff : new_places[15:0];
      if (reset_now) offered_are <= 16'd0;
      else if (writes_at(6'd43)) offered_are <= new_offered > 32'hffff ? 16'hffff : new_offered[15:0];
      if (writes_at(6'd44)) interrupt_is <= new_interrupt > 32'h1ffff ? 17'h1ffff : new_interrupt[16:0];
      interrupts_are <= interrupt_is[16] & ~behind[15];
      more_wrong <= ring_flaws | (more_wrong & ~(writes_at(6'd2) & w_bytes[2] ? w_word[18:16] : 3'd0));
    end
  end
  function [31:0] more_at(input [5:0] place);
    case (place)
      6'd38: more_at = {23'd0, rays_are, 7'd0};
      6'd40: more_at = {23'd0, answers_are, 7'd0};
      6'd42: more_at = places_are;
      6'd43: more_at = offered_are;
      6'd44: more_at = interrupt_is;
      6'd45: more_at = ring_answers;
      default: more_at = 32'd0;
    endcase
  endfunction
  always @(posedge clk) if (was_reset & ~rst) begin
    assert ({rays_at, answers_at, ring_last, rays_offered} == {rays_are, answers_are, places_are, offered_are});
    assert (irq == interrupts_are && interrupt_r == interrupt_is);
    assert (ring_flaws_r == more_wrong);
    assert (lets_rings == ~resetting);
  end
