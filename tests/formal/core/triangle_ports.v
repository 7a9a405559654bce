  input wire major_y, major_z, back_m,
  input wire [7:0] origin_m, origin_a, origin_b,
  input wire [9:0] slope_a, slope_b,
  input wire [7:0] x0, y0, z0, x1, y1, z1, x2, y2, z2,
  output wire hit,
  output wire signed [12:0] det_high,
  output wire [11:0] det_low,
  output wire signed [11:0] num_high,
  output wire [11:0] num_low
