  // The wrapper resets it together with the core. A reset counts once, however long it is, and nothing else counts.
  always @* assume (rst == resetting);
  reg [1:0] epoch_was;
  reg low_was, low_before, known = 1'b0, known_before = 1'b0;
  always @(posedge clk) begin
    {epoch_was, low_was, low_before} <= {present, resetting, low_was};
    {known, known_before} <= {was_reset, known};
  end
  always @* if (known) assert (was_resetting == low_was);
  always @* if (known_before) assert (present == epoch_was + {1'b0, low_was & ~low_before});
  always @* cover (known_before && present != epoch_was);
