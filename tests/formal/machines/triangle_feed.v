  wire gone = begins & unit_takes;
  wire gone_ray = test_ray;
  `include "triangle_queue.v"

  reg [1:0] idle;
  reg refused;
  reg [119:0] given_before;
  wire [119:0] given = {test_ray, origins_word, slopes_word, corners_0_word, corners_1_word, corners_2_word};
  always @(posedge clk) begin
    idle <= ~rst & waiting != 2'd0 & ~begins ? idle + 2'd1 : 2'd0;
    refused <= ~rst & begins & ~unit_takes;
    given_before <= given;
  end
  always @(posedge clk) if (was_reset & ~rst) begin
    // A test is of the oldest triangle, with its ray's words, and stays until it is taken.
    if (begins) begin
      assert (waiting != 2'd0);
      assert ({test_ray, z2, y2, x2, z1, y1, x1, z0, y0, x0} == kept[72:0]);
      if (test_ray == our)
        assert ({major_y, major_z, back_m, origin_m, origin_a, origin_b, slope_a, slope_b} == our_words);
    end
    assert (!refused || (begins && given == given_before));
    // With a triangle there, a test is there in two cycles.
    assert (idle <= 2'd2);
    cover (waiting == 2'd2 && gone);
    cover (begins && came && test_ray != came_ray);
  end
