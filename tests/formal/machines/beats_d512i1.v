  // One beat a block, which is one half of it.
  localparam WIDTH = 3;
  localparam [1:0] LAST = 2'd0;
  wire [2:0] request = {request_upper, request_id};

  wire half = kept[2];
  reg [255:0] own;
  reg error;
  always @(posedge clk) begin
    own <= half ? {beat_7, beat_6, beat_5, beat_4} : {beat_3, beat_2, beat_1, beat_0};
    error <= beat_error;
    if (was_reset & ~rst) assert (!read_valid || read_error == error);
    if (was_reset & ~rst) assert (!read_valid || {read_word_3, read_word_2, read_word_1, read_word_0} == own);
  end

