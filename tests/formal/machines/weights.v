  // An answer leaves `replies` when it is taken, and in the next cycle its ray is said.
  wire taken = reply_valid & reply_ready;
  wire leaves = hit_valid & hit_ready;
  reg took, here;
  reg [39:0] answer_words;
  (* anyseq *) reg owner;
  reg took_ray;
  always @(posedge clk) begin
    if (rst) {took, here} <= 2'd0;
    else begin
      took <= taken;
      here <= taken | (here & ~leaves);
    end
    if (taken) begin
      answer_words <= {reply_tag, reply_failed, reply_number, reply_t};
      took_ray <= owner;
    end
  end
  always @* assume (reply_freed == took && (!reply_freed || reply_freed_ray == took_ray));

  // Any ray: the numbers of its last hit, and of its best one.
  (* anyconst *) reg one;
  wire tests_one = tested & hit & tester == one;
  wire done_one = done & asked == one;
  reg [74:0] last_one, best_one;
  reg has_last, has_best, asked_before, tests_before;
  always @(posedge clk) begin
    if (rst) {has_last, has_best} <= 2'd0;
    else begin
      has_last <= tests_one | has_last;
      has_best <= (done_one & closer) | has_best;
    end
    if (tests_one) last_one <= {det_high, det_low, u_high, u_low, v_high, v_low};
    if (done_one & closer) best_one <= last_one;
    asked_before <= asked == one;
    tests_before <= tests_one;
  end
  // The divider is at a ray for several cycles, after its test; and the ray of an answer has no test any more.
  always @* if (done_one) assume (asked_before && !tests_before && has_last);
  always @* if (here && took_ray == one) assume (!done_one && has_best);

  reg there_before, leaves_before;
  always @(posedge clk) {there_before, leaves_before} <= {here & took & ~rst, leaves & ~rst};

  always @(posedge clk) if (was_reset & ~rst) begin
    // One answer at a time: it is taken only when the one before has left, and it stays until it is taken.
    assert (reply_ready == ~here);
    assert (has == here && hit_valid == (here & ~took));
    assert (!here || {hit_tag, hit_failed, hit_number, hit_t} == answer_words);
    assert (!hit_valid || ray == took_ray);
    // Its ray's number is free when it has left.
    assert (freed == leaves_before);
    assert (!freed || freed_ray == took_ray || here);
    assert (!has_last || {last_det[one], last_u[one], last_v[one]} == last_one);
    assert (!has_best || {best_det[one], best_u[one], best_v[one]} == best_one);
    assert (!(asked_before && has_last && !tests_before) || {last_det_word, last_u_word, last_v_word} == last_one);
    // An answer has the numbers of its ray's best hit.
    if (hit_valid && took_ray == one)
      assert ({hit_det_high, hit_det_low, hit_u_high, hit_u_low, hit_v_high, hit_v_low} == best_one);
    cover (hit_valid && took_ray == one && best_one != last_one);
  end
