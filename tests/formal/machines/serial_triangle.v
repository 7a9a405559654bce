  wire gone = leaves;
  wire gone_ray = asked;
  `include "triangle_queue.v"

  // The program: an instruction is fetched in each cycle from the first on, and passes two more stages. One of them ends
  // it, at the latest the last instruction.
  localparam [6:0] LAST = 7'd85;
  wire [6:0] at_1 = counter - 7'd1, at_2 = counter - 7'd2, at_3 = counter - 7'd3;
  wire stands = ~fetches;
  // T is divided, a bit in a cycle, and then compared once.
  wire divides_now = left != 3'd0;
  wire [2:0] steps = divides_now + compares + answers;
  reg compared;
  reg [6:0] in_program;
  reg [70:0] seen;
  reg [38:0] seen_best;
  always @(posedge clk) begin
    in_program <= ~rst & fetches ? in_program + 7'd1 : 7'd0;
    seen <= {quotient, asked_number};
    seen_best <= {best, best_number};
  end
  // While a test is on its way its triangle is the oldest, and it has not ended.
  always @(posedge clk) if (was_reset & ~rst) begin
    assert (instructions[LAST][27]);
    assert (!works || (waiting != 2'd0 && ready));
    assert (works == (fetches | tested_1 | divides_now | compares | answers));
    assert (fetches + (tested_1 & ~hit_1) + steps <= 3'd1);
    assert (!(tested_1 && hit_1) || left == 3'd7);
    assert (!fetches || counter == in_program);
    assert (!fetches || counter <= LAST + 7'd3);
    assert (works || (counter == 7'd0 && !fetched && !reads_words && !multiplied));
    assert (!fetches || {fetched, reads_words, multiplied} == {counter >= 7'd1, counter >= 7'd2, counter >= 7'd3});
    assert (fetches || {fetched, reads_words, multiplied} == 3'd0);
    assert (!fetched || instructions_word == instructions[at_1]);
    assert (!reads_words || code_2 == instructions[at_2]);
    assert (!multiplied || code_3 == instructions[at_3]);
    // A test ends once, by a miss or a hit, and a hit is compared once, with what its ray has then.
    assert (!tested || works);
    assert (!done || asked == (oldest ? place_1[72] : place_0[72]));
    assert (!answers || closer == (seen[38:0] < seen_best));
  end
  // A program may run while another triangle waits.
  always @* cover (was_reset & ~rst & multiplied & counter == 7'd10 & waiting == 2'd2);
