  // Rays outside: those that have not begun, those that wait for a record, for its boxes, for a leaf.
  reg [1:0] nowhere, wants, knows, at_leaf;
  always @(posedge clk) begin
    if (rst) {nowhere, wants, knows, at_leaf} <= 8'hc0;
    else begin
      if (starts & walker_takes) nowhere[start_ray] <= 1'b0;
      if (begins) wants[test_ray] <= 1'b0;
      if (begins) knows[test_ray] <= 1'b1;
      if (tested) knows[tester] <= 1'b0;
      if (returns) wants[return_ray] <= 1'b0;
      if (returns) at_leaf[return_ray] <= 1'b0;
      if (goes & &triangles) wants[walk_ray] <= 1'b1;
      if (goes & ~&triangles) at_leaf[walk_ray] <= 1'b1;
      if (ended) nowhere[walk_ray] <= 1'b1;
    end
  end
  // What comes in is of a ray that waits for it. A record that is not in the image stops its ray, as a leaf can. The
  // bound stays while a ray is on its walk.
  reg [19:0] most_before;
  always @(posedge clk) most_before <= most_steps;
  always @* begin
    if (starts & walker_takes) assume (nowhere[start_ray]);
    if (begins) assume (wants[test_ray]);
    if (tested) assume (knows[tester] || (begins && test_ray == tester));
    if (returns) assume (at_leaf[return_ray] || (wants[return_ray] && return_stops && !(begins && test_ray == return_ray)));
    if (returns & return_lost != 2'd0) assume (return_stops);
    // A record or a leaf loses its ray or not, by what is outside or by what could not be read.
    assume (flaw != 2'd1 && return_lost != 2'd1);
    if (nowhere != 2'd3) assume (most_steps == most_before);
  end

  // The ray at each place of the queues, and in the stages.
  function [1:0] first_of(input [1:0] used, input oldest, input ray);
    first_of = used == 2'd2 | (used == 2'd1 & oldest == 1'b0) ? 2'd1 << ray : 2'd0;
  endfunction
  function [1:0] second_of(input [1:0] used, input oldest, input ray);
    second_of = used == 2'd2 | (used == 2'd1 & oldest == 1'b1) ? 2'd1 << ray : 2'd0;
  endfunction
  wire [7:0] leaf_words_0 = leaf_rays[0], leaf_words_1 = leaf_rays[1];
  wire [5:0] other_words_0 = other_rays[0], other_words_1 = other_rays[1];
  wire [1:0] pairs_0 = first_of(pairs_used, pairs_oldest, pair_rays[0]);
  wire [1:0] pairs_1 = second_of(pairs_used, pairs_oldest, pair_rays[1]);
  wire [1:0] leaves_0 = first_of(leaves_used, leaves_oldest, leaf_words_0[7]);
  wire [1:0] leaves_1 = second_of(leaves_used, leaves_oldest, leaf_words_1[7]);
  wire [1:0] others_0 = first_of(others_used, others_oldest, other_words_0[5]);
  wire [1:0] others_1 = second_of(others_used, others_oldest, other_words_1[5]);
  wire [1:0] in_1 = pair_1 | leaf_1 | fresh_1 | again_1 ? 2'd1 << ray_1 : 2'd0;
  wire [1:0] in_2 = there_2 ? 2'd1 << ray_2 : 2'd0;
  wire [1:0] in_3 = goes_3 | ended_3 | again_3 ? 2'd1 << ray_3 : 2'd0;

  // Every ray is in one place. A queue has as many words as rays, so it has none twice and cannot overflow.
  genvar r;
  generate
    for (r = 0; r < 2; r = r + 1) begin : ray_places
      wire [12:0] places = {pairs_0[r], pairs_1[r], leaves_0[r], leaves_1[r], others_0[r], others_1[r], in_1[r],
                            in_2[r], in_3[r], nowhere[r], wants[r], knows[r], at_leaf[r]};
      always @(posedge clk) if (was_reset & ~rst) assert (places != 13'd0 && (places & (places - 13'd1)) == 13'd0);
    end
  endgenerate
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (pairs_used <= 2'd2 && leaves_used <= 2'd2 && others_used <= 2'd2);
    assert (!pairs_there || (pairs_used != 2'd0 && pair_rays_word == pair_rays[pairs_oldest]));
    assert (!leaves_there || (leaves_used != 2'd0 && leaf_rays_word == leaf_rays[leaves_oldest]));
    assert (!others_there || (others_used != 2'd0 && other_rays_word == other_rays[others_oldest]));
    assert (pair_1 + leaf_1 + fresh_1 + again_1 <= 3'd1);
    assert (goes_3 + ended_3 + again_3 <= 2'd1);
  end

  // Any ray, and a walk of it alone. Its words change when something comes in for it, and when it goes on. So what the
  // walker says of it depends neither on when that is nor on other rays.
  (* anyconst *) reg our;
  localparam [2:0] NONE = 3'd0, FRESH = 3'd1, PAIR = 3'd2, LEAF = 3'd3, AGAIN = 3'd4;
  reg [2:0] came;
  reg came_stops;
  reg [1:0] came_lost, record_flaw;
  reg [3:0] came_cut;
  reg [LEAF_BITS+3:0] child_of_0, child_of_1;
  reg nearer_1, met_0, met_1;
  reg [7:0] range_0, range_1;
  // A bit for each level, 1: no child of it waits. Where the ray is, and at which level it went on last.
  reg [3:0] trail;
  reg [2:0] at, went_on;
  reg at_record;
  reg [STEP_BITS-1:0] tests;
  reg [3:0] shortest;
  // The children that wait, the last two of them, and of which level they are.
  reg [1:0] kept;
  reg [LEAF_BITS+11:0] last_entry, entry_before;
  reg [2:0] last_level, level_before;
  // The levels of which a child was put off and has not been followed, by what was met.
  reg [3:0] put_off;

  // What the ray does next.
  wire [3:0] level_bit = 4'd1 << at;
  wire meets_first = met_0 & child_of_0[LEAF_BITS-1:0] != 0, meets_second = met_1 & child_of_1[LEAF_BITS-1:0] != 0;
  wire meets_both = meets_first & meets_second;
  wire second_turn = (trail & level_bit) != 4'd0;
  wire down = came == PAIR & (meets_both | (meets_first != meets_second & at != went_on));
  wire puts_off = came == PAIR & meets_both & ~second_turn;
  wire to_1 = meets_both ? nearer_1 != second_turn : meets_second;
  wire [LEAF_BITS+11:0] followed = to_1 ? {child_of_1, range_1} : {child_of_0, range_0};
  wire [LEAF_BITS+11:0] other_one = to_1 ? {child_of_0, range_0} : {child_of_1, range_1};
  wire up = came != FRESH & ~down;
  // The deepest level, from this one up, of which a child waits.
  wire [3:0] settled = came == PAIR & ~meets_both ? trail | level_bit : trail;
  wire [3:0] waiting = ~settled & ~(level_bit - 4'd1);
  wire [3:0] deepest = waiting & -waiting;
  wire [2:0] deepest_at = deepest[3] ? 3'd3 : deepest[2] ? 3'd2 : deepest[1] ? 3'd1 : 3'd0;
  wire [1:0] lost_now = came == LEAF ? came_lost : came == PAIR ? record_flaw : 2'd0;
  wire stops_now = (came == LEAF & came_stops) | lost_now != 2'd0 | (up & waiting == 4'd0);
  wire from_kept = up & kept != 2'd0, from_top = came == FRESH | (up & kept == 2'd0);
  wire [3:0] cut_then = came == LEAF | came == FRESH ? came_cut : shortest;
  wire too_far = from_kept & last_entry[7:4] > cut_then;
  wire [LEAF_BITS+11:0] target = from_top ? {4'd0, {LEAF_BITS{1'b1}}, 4'd0, cut_then} : down ? followed : last_entry;
  wire to_record = &target[LEAF_BITS+7:8] & ~too_far;
  wire [2:0] from_level = up ? deepest_at : at;
  wire [STEP_BITS-1:0] tests_then = came == FRESH ? {STEP_BITS{1'b0}} : tests;
  // A larger bound is the largest number of tests.
  wire [STEP_BITS-1:0] most_tests = most_steps >> STEP_BITS != 0 ? {STEP_BITS{1'b1}} : most_steps;
  wire below_all = ~from_top & from_level == 3'd0;
  wire fails_now = to_record & (below_all | tests_then == most_tests);
  wire [3:0] trail_then = came == FRESH ? 4'd0 : up ? (settled & ~(deepest - level_bit)) | deepest : settled;
  wire on = ~stops_now & ~fails_now;

  reg says_ended, says_again, began;
  reg [2:0] says_failed;
  reg [LEAF_BITS+11:0] says;
  reg [STEP_BITS+4:0] measure, measure_before;
  reg [3:0] left_waiting;
  wire goes_on = there_2 & ray_2 == our;
  always @(posedge clk) begin
    if (rst) came <= NONE;
    else begin
      if (starts & walker_takes & start_ray == our) came <= FRESH;
      if (tested & tester == our) came <= PAIR;
      if (returns & return_ray == our) came <= LEAF;
      if (goes_on) came <= on & too_far ? AGAIN : NONE;
    end
    if (starts & walker_takes & start_ray == our) came_cut <= start_cut;
    if (begins & test_ray == our) begin
      child_of_0 <= {block, count_0};
      child_of_1 <= {second_place[3:0], count_1};
      // Behind the last number of a block there is none.
      record_flaw <= flaw | {second_place > 12'd15 & count_1 != 0, 1'b0};
    end
    if (tested & tester == our) begin
      {nearer_1, met_0, met_1} <= {second_first, hit_0, hit_1};
      {range_0, range_1} <= {near_0, far_0, near_1, far_1};
    end
    if (returns & return_ray == our) {came_lost, came_stops, came_cut} <= {return_lost, return_stops, return_cut};
    if (goes_on) begin
      trail <= trail_then;
      at <= from_top ? 3'd3 : from_level - to_record;
      went_on <= came == FRESH ? 3'd4 : up ? deepest_at : went_on;
      at_record <= to_record;
      tests <= tests_then + to_record;
      shortest <= cut_then;
      if (came == FRESH) kept <= 2'd0;
      else if (puts_off) kept <= kept == 2'd0 ? 2'd1 : 2'd2;
      else if (from_kept) kept <= kept - 2'd1;
      if (puts_off) {last_entry, last_level, entry_before, level_before} <= {other_one, at, last_entry, last_level};
      else if (from_kept) {last_entry, last_level} <= {entry_before, level_before};
      // A level's child is followed, or a test says that not both are met. Levels below one that is left are left too.
      if (came == FRESH) put_off <= 4'd0;
      else if (puts_off) put_off <= put_off | level_bit;
      else if (down) put_off <= put_off & ~level_bit;
      else put_off <= left_waiting_now & ~deepest;
      left_waiting <= left_waiting_now;
      {says_ended, says_again} <= {~on, on & too_far};
      says_failed <= lost_now == 2'd2 ? 3'd4 : lost_now == 2'd3 ? 3'd5
                     : stops_now | ~fails_now ? 3'd0 : below_all ? 3'd3 : 3'd2;
      says <= {target[LEAF_BITS+11:4], target[3:0] < cut_then ? target[3:0] : cut_then};
      began <= came == FRESH;
      measure_before <= measure_now;
    end
  end
  wire [11:0] second_place = block + (&count_0 ? 12'd1 : count_0);
  wire [3:0] left_waiting_now = put_off & ~(level_bit - 4'd1) & ~(came == PAIR ? level_bit : 4'd0);
  wire [STEP_BITS+4:0] measure_now = {trail, tests, ~at_record};

  // The places at which the machine has the same words.
  wire queued = pairs_0[our] | pairs_1[our] | leaves_0[our] | leaves_1[our] | others_0[our] | others_1[our];
  wire outside = wants[our] | knows[our] | at_leaf[our];
  wire inside = queued | in_1[our] | in_2[our];
  wire on_walk = outside | (inside & came != FRESH) | (in_3[our] & ~ended_3);
  wire [STEP_BITS+12:0] walk = walks[our];
  wire [LEAF_BITS+11:0] place_0 = stacks[{our, 1'b0}], place_1 = stacks[{our, 1'b1}];
  wire top = walk[STEP_BITS];
  wire [3:0] passed = at_record ? ~({level_bit[2:0], 1'b0} - 4'd1) & {4{at != 3'd3}} : ~(level_bit - 4'd1);
  wire [3:0] zeros = ~trail & passed, zeros_above = zeros & (zeros - 4'd1);
  wire [3:0] lowest = zeros & -zeros, next_lowest = zeros_above & -zeros_above;
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (came <= AGAIN && (came != NONE) == (inside | (in_3[our] & again_3)));
    assert (!(pairs_0[our] | pairs_1[our]) || came == PAIR);
    assert (!leaves_0[our] || (came == LEAF && leaf_words_0[6:0] == {came_lost, came_stops, came_cut}));
    assert (!leaves_1[our] || (came == LEAF && leaf_words_1[6:0] == {came_lost, came_stops, came_cut}));
    assert (!others_0[our] || (came == FRESH && other_words_0[4:0] == {1'b0, came_cut}) ||
            (came == AGAIN && other_words_0[4]));
    assert (!others_1[our] || (came == FRESH && other_words_1[4:0] == {1'b0, came_cut}) ||
            (came == AGAIN && other_words_1[4]));
    assert (!(wants[our] | knows[our] | (inside & came == PAIR)) || at_record);
    assert (!(at_leaf[our] | came == AGAIN) || !at_record);
    if (inside & came == LEAF) assert (!at_record || came_stops);
    if (came == LEAF) assert (came_lost != 2'd1 && (came_lost == 2'd0 || came_stops));
    if (knows[our] | (inside & came == PAIR)) assert (record_flaw != 2'd1);
    // The words in the machine's memories.
    if (on_walk) begin
      assert ({walk[STEP_BITS+12:STEP_BITS+1], walk[STEP_BITS-1:0]} == {trail, at, went_on, kept, tests} && cuts[our] == shortest);
      assert (kept == 2'd0 || (top ? place_0 : place_1) == last_entry);
      if (!(in_2[our] & puts_off)) assert (kept != 2'd2 || (top ? place_1 : place_0) == entry_before);
    end
    if (knows[our] | (inside & came == PAIR)) assert (children[our] == {record_flaw, child_of_1, child_of_0});
    if (inside & came == PAIR) begin
      assert (boxes_0[our] == {nearer_1, met_0, range_0} && boxes_1[our] == {met_1, range_1});
    end
    if (in_1[our]) begin
      assert ({fresh_1, pair_1, leaf_1, again_1} == {came == FRESH, came == PAIR, came == LEAF, came == AGAIN});
      assert (walks_word == walk && cuts_word == cuts[our] && children_word == children[our]);
      assert (boxes_0_word == boxes_0[our] && boxes_1_word == boxes_1[our]);
      if (leaf_1) assert ({stops_1, lost_1} == {came_stops, came_lost});
      if (leaf_1 | fresh_1) assert (cut_1 == came_cut);
    end
    if (in_2[our]) begin
      assert ({begins_2, descends_2, pops_2, ends_2} == {came == FRESH, down, up, stops_now});
      assert (lost_2 == lost_now && cut_2 == cut_then && steps_2 == tests_then);
      assert (!down || entry_2 == followed);
      assert (resumed_2 == (came == FRESH ? 3'd4 : went_on));
      if (came == FRESH) assert (trail_2 == 4'd0 && used_2 == 2'd0);
      else begin
        assert (level_2 == at && some_2 == (kept != 2'd0) && top_2 == top + puts_off);
        assert (used_2 == (kept == 2'd2 ? 2'd2 : kept + puts_off));
      end
      if (!stops_now) assert (trail_2 == trail_then);
      if (up & !stops_now) assert (popped_2 == deepest);
      if (puts_off) assert ((top ? place_1 : place_0) == other_one);
      if (from_kept) assert (stacks_word == last_entry);
    end
    // What the machine says.
    if (in_3[our]) begin
      assert ({ended_3, again_3} == {says_ended, says_again});
      assert (!ended_3 || failed == says_failed);
      assert (!goes_3 || {wanted, triangles, enters_at, leaves_at} == says);
      assert (!goes_3 || at_record == (&triangles));
    end

    // Each step of a walk is further, so walks end.
    if (in_3[our] & ~ended_3 & ~began) assert (measure_now > measure_before);
    if (on_walk) begin
      assert (at <= 3'd3 && went_on <= 3'd4 && kept <= 2'd2 && tests <= most_tests);
      // The children that are kept are of the deepest levels of which one waits. So one that is taken up is of the
      // deepest. Of a level that was passed the trail says whether a child waits.
      assert (kept == 2'd0 || (lowest != 4'd0 && lowest == 4'd1 << last_level));
      assert (kept != 2'd2 || (next_lowest != 4'd0 && next_lowest == 4'd1 << level_before));
      assert ((put_off & passed) == zeros);
    end
    if (in_2[our] & from_kept & ~stops_now) assert (deepest_at == last_level);
    // A walk that has not failed and was not stopped ends when no child waits.
    if (in_3[our] & ended_3 & failed == 3'd0) assert (came_stops_before || left_waiting == 4'd0);
  end
  reg came_stops_before;
  always @(posedge clk) if (goes_on) came_stops_before <= came == LEAF & came_stops;

  // A ray may take up a child that waited.
  always @* cover (was_reset & ~rst & in_2[our] & from_kept & ~too_far & on);

  // With two rays a ray is taken up in three cycles at most. A queue's ray is there one cycle after it came.
  reg [1:0] waited;
  reg [2:0] entered;
  reg our_entered;
  always @(posedge clk) begin
    waited <= ~rst & queued ? waited + 2'd1 : 2'd0;
    entered <= {enters & ~rst, returns & ~rst, tested & ~rst};
    our_entered <= (enters & walker_mux == our) | (returns & return_ray == our) | (tested & tester == our);
    if (was_reset & ~rst) begin
      assert (pairs_there == (pairs_used > entered[0]));
      assert (leaves_there == (leaves_used > entered[1]));
      assert (others_there == (others_used > entered[2]));
      assert (!queued || (waited == 2'd0) == our_entered);
      assert (waited != 2'd2 || !queued || in_1[~our]);
      assert (waited != 2'd3 || !queued);
    end
  end
