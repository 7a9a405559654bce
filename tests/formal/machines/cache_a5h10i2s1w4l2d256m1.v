  // Four rays. A beat says by an identifier of which request it is.
  localparam I = 2, N = 4, WAYS = 4, WAY = 2, TAG = 3;
`define FOUR_WAYS
  wire [I-1:0] beat_ray = beat_id[I-1:0];
  always @(posedge clk) if (was_reset & ~rst) begin
    for (r = 0; r < N; r = r + 1) begin
      assert (!asking[r] || asked[r] == of[r]);
      assert ((empties & r >= empty_set) || beats[r] == {came_of[r], error_of[r]});
    end
  end

  // A list of three rays may be told of an error while a ray is looked up.
  always @* cover (was_reset & ~rst & gives_list & list_error & before[list_ray] == 2 & look_there);
