  wire gone = begins & unit_takes;
  wire gone_ray = test_ray;
  `include "triangle_queue.v"

`ifdef QUESTIONS
  // What the ray's next test is, with none, either or both moves. Rays begin in every other cycle at most, and so do
  // tests. A ray that is tested again has no triangle here, and its next one comes when this is known.
  reg our_once;
  reg [1:0] our_is;
  reg began_before, retested_before;
  wire began_one = ray_valid & ray_ready;
  always @(posedge clk) begin
    began_before <= ~rst & began_one;
    retested_before <= ~rst & retests;
    if (began_one & begun_at == our) {our_once, our_is} <= {ray_once, 2'd0};
    else if (retests & retest_ray == our) our_is <= retest_is;
  end
  wire retested_waits = retests & flying[retest_ray] & ~here[retest_ray] & ~rays_end[retest_ray];
  always @* begin
    if (began_one) assume (!began_before);
    if (retests) assume (!retested_before && retested_waits && !(comes && read_id[0] == retest_ray));
    if (retests_1) assume (!rays_end[retest_ray_1] && !(comes && read_id[0] == retest_ray_1));
  end
  wire our_retest = retests_1 & retest_ray_1 == our;
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (!retests_1 || (flying[retest_ray_1] && !here[retest_ray_1]));
    assert (!retests_1 || retested_before || began_before);
    assert (!flying[our] || onces[our] == our_once);
    assert (!flying[our] || (our_retest ? retest_is_1 : tests[our]) == our_is);
    assert (!ready || rays_word != our || {onces_word, tests_word} == {our_once, our_is});
    if (begins && test_ray == our) begin
      assert ({test_once, test_is} == {our_once, our_is});
      assert (test_down == (our_is[1] ? our_words[20] : our_words[28]));
    end
    cover (begins && test_ray == our && test_is == 2'd2 && test_down);
  end
  // The lowest bit of the origin along slot a or b is the other one.
  wire [46:0] our_test = our_words ^ (our_is == 2'd1 ? 47'd1 << 28 : our_is == 2'd2 ? 47'd1 << 20 : 47'd0);
`else
  wire [46:0] our_test = our_words;
`endif

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
        assert ({major_y, major_z, back_m, origin_m, origin_a, origin_b, slope_a, slope_b} == our_test);
    end
    assert (!refused || (begins && given == given_before));
    // With a triangle there, a test is there in two cycles.
    assert (idle <= 2'd2);
    cover (waiting == 2'd2 && gone);
    cover (begins && came && test_ray != came_ray);
  end
