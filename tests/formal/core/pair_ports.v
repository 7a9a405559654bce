  input wire major_y, major_z, back_m, back_a, back_b,
  input wire [7:0] origin_m, origin_a, origin_b,
  input wire [3:0] floor_a, ceil_a, floor_b, ceil_b,
  input wire [2:0] exp_a, exp_b,
  input wire [7:0] parent_near, parent_far, xmin, xmax, ymin, ymax, zmin, zmax,
  input wire own_xmin, own_xmax, own_ymin, own_ymax, own_zmin, own_zmax,
  output wire hit_0, hit_1,
  output wire signed [7:0] near_0, far_0, near_1, far_1,
  output wire second_first
