  // A ray has two beats, an answer one.
  localparam LOG = 1;
  wire [255:0] beats_now = {2{fetched_1, fetched_0}};
  wire last_half = 1'b1;
  wire [127:0] puts_now = {put_1, put_0};
  wire [127:0] puts = {128{1'b1}};
