  wire gates = 1'b1, answers_left = lets_answers, more_busy = 1'b0;
  wire [2:0] more_wrong = 3'd0;
  // With a cache: lines that it may read, and what it has done.
  reg [5:0] lines_are;
  reg [33:0] found, joined, read;
  reg forgets;
  wire [31:0] new_lines = changed({26'd0, lines_are});
  always @(posedge clk) begin
    if (rst) begin
      lines_are <= 6'd8;
      {found, joined, read, forgets} <= 103'd0;
    end else begin
      if (writes_at(6'd13)) lines_are <= new_lines > 32'd63 ? 6'd63 : new_lines == 32'd0 ? 6'd1 : new_lines[5:0];
      forgets <= writes_at(6'd4) | writes_at(6'd5) | writes_at(6'd6) | (writes_at(6'd3) & w_bytes[0] & w_word[1]);
      found <= writes_at(6'd9) ? 34'd0 : found + cache_hit;
      joined <= writes_at(6'd9) ? 34'd0 : joined + cache_join;
      read <= writes_at(6'd9) ? 34'd0 : read + line_asked;
    end
  end
  function [31:0] more_at(input [5:0] place);
    case (place)
      6'd13: more_at = lines_are;
      6'd32: more_at = found[31:0];
      6'd33: more_at = {30'd0, found[33:32]};
      6'd34: more_at = joined[31:0];
      6'd35: more_at = {30'd0, joined[33:32]};
      6'd36: more_at = read[31:0];
      6'd37: more_at = {30'd0, read[33:32]};
      default: more_at = 32'd0;
    endcase
  endfunction
  // A new image empties the cache, and so does software.
  always @(posedge clk) if (was_reset & ~rst) begin
    assert ({most_lines, empties_cache} == {lines_are, forgets});
    assert ({count_cache_hits, count_joins, count_lines} == {found, joined, read});
  end
