  // A ray has four beats, an answer two.
  localparam LOG = 2;
  wire [255:0] beats_now = {4{fetched_0}};
  wire last_half = second;
  wire [127:0] puts_now = {2{put_0}};
  wire [127:0] puts = second ? {{128{1'b1}} << 64} : {{128{1'b1}} >> 64};
