  // Text inside the core: what it takes a ray at most, with one record a ray, a leaf of one triangle, two rays that are
  // offered at once, a memory that answers in the next cycle and an answer port that is ready.
  reg began = 1'b0;
  always @(posedge clk) began <= 1'b1;
  always @* assume (rst == !began);
  (* anyconst *) reg [2:0] any_base;
  (* anyconst *) reg [3:0] any_last;
  always @* assume ({base, last, most_steps, most_rays} == {any_base, any_last, 20'd1, 2'd2});
  always @* assume (hit_ready & request_ready);
  reg asked = 1'b0;
  reg [1:0] asked_id;
  always @(posedge clk) begin
    asked <= request_valid & ~rst;
    asked_id <= request_id;
  end
  always @* assume (read_valid == asked && (!asked || read_id == asked_id));
  always @* assume (read_word_3[15:8] == 8'd0 && (read_word_3[7:0] <= 8'd1 || &read_word_3[7:0]));

  // Any ray, the first or the second: cycles since it was taken.
  (* anyconst *) reg one;
  reg [1:0] taken = 2'd0;
  reg here = 1'b0;
  reg [1:0] tag;
  reg [6:0] age;
  wire takes = ray_valid & ray_ready;
  // Two rays with two tags, then none.
  always @* if (takes) assume (ray_tag == taken);
  always @* assume (ray_valid == (taken != 2'd2));
  always @(posedge clk) begin
    taken <= taken + takes;
    here <= ~rst & ((takes & ray_tag[0] == one) | (here & ~(hit_valid & hit_tag[0] == one)));
    age <= here ? age + 7'd1 : 7'd0;
  end
  always @* if (began) assert (!here || age < `MOST);
