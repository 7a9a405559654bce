  // What a ray asks is handed on. One that counts has its end as the T of its place. Where slots are of another handedness, or the
  // direction is negative, a det has the other sign.
  reg [38:0] asks;
  wire [35:0] place = {ray_any ? ray_length : ray_from_t, ray_from_number};
  always @(posedge clk) if (ray_valid & ray_ready)
    asks <= {ray_any & ~ray_once, ray_any & ray_once, ray_back_m ^ ray_major_y ^ ray_major_z, ray_once ? place : 36'd0};
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (!new_ray || {any, counts, turned, from_t, from_number} == asks);
    cover (new_ray && counts && from_t == 4'd5);
  end
