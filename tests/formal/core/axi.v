  // Text inside the wrapper of a core that may say anything, but offers what it offers until it is taken, asks for a
  // block once, and answers only rays that it took since its reset. Memory answers what it was asked.
  reg began = 1'b0;
  always @(posedge aclk) began <= 1'b1;
  always @* if (!began) assume (!aresetn);

  // The core's side: rays in it, requests on their way.
  reg [2:0] in_core = 3'd0;
  wire takes = core_ray_valid & core_ray_ready, answers = core_hit_valid & core_hit_ready;
  always @(posedge aclk) in_core <= core_rst ? 3'd0 : in_core + takes - answers;
  always @* begin
    if (core_hit_valid) assume (in_core != 3'd0);
    if (core_ray_ready) assume (in_core < 3'd2);
  end
  wire [80:0] hit = {m_axis_hit_tdata, m_axis_hit_tid}, request = {m_axi_araddr, core_request_id};
  reg hit_held = 1'b0, request_held = 1'b0;
  reg [80:0] hit_was, request_was;
  always @(posedge aclk) begin
    hit_held <= core_hit_valid & ~core_hit_ready & ~core_rst;
    request_held <= core_request_valid & ~core_request_ready & ~core_rst;
    {hit_was, request_was} <= {hit, request};
  end
  always @* begin
    if (hit_held) assume (core_hit_valid && hit == hit_was);
    if (request_held) assume (core_request_valid && request == request_was);
    assume (m_axi_araddr[4:0] == 5'd0);
  end

  // Memory's side: blocks that were asked for, with their beats left.
  reg [2:0] due = 3'd0;
  reg [1:0] came = 2'd0;
  wire asks = m_axi_arvalid & m_axi_arready, beat = m_axi_rvalid & m_axi_rready;
`ifdef IDS
  wire block = beat & m_axi_rid[3:2] == epoch_present;
`else
  wire block = beat & came == m_axi_arlen[1:0];
`endif
  wire reads = `READ_VALID;
  reg [2:0] in_memory = 3'd0, unseen = 3'd0;
  always @(posedge aclk) begin
    in_memory <= aresetn ? in_memory + asks - block : 3'd0;
    unseen <= aresetn ? unseen + asks - reads : 3'd0;
    came <= ~aresetn | block ? 2'd0 : came + beat;
  end
  always @* if (core_request_valid) assume (unseen < 3'd2);
`ifdef IDS
  // Blocks of before a hard reset may come with any other identifier. That none has the present one is in EPOCH.
  always @* if (m_axi_rvalid & m_axi_rid[3:2] == epoch_present) assume (in_memory != 3'd0);
  // Any request, and the hard resets since. Its block has come before the fourth.
  (* anyseq *) reg picks, is_it;
  reg picked = 1'b0, was_low = 1'b0;
  reg [1:0] resets_since;
  reg [3:0] id_of_it;
  wire comes = m_axi_rvalid & is_it;
  always @(posedge aclk) begin
    was_low <= ~aresetn;
    if (asks & aresetn & ~picked & picks) begin
      picked <= 1'b1;
      id_of_it <= m_axi_arid;
      resets_since <= 2'd0;
    end else begin
      if (comes) picked <= 1'b0;
      if (~aresetn & ~was_low) resets_since <= resets_since + 2'd1;
    end
  end
  always @* begin
    if (is_it) assume (m_axi_rvalid && picked && m_axi_rid == id_of_it);
    if (picked & ~aresetn & ~was_low) assume (resets_since != 2'd3);
  end
`else
  always @* if (m_axi_rvalid) assume (in_memory != 3'd0);
`endif

  // What was offered a cycle ago and not taken.
  reg ar_held = 1'b0, t_held = 1'b0, r_held = 1'b0, b_held = 1'b0;
  reg [80:0] ar_was, t_was;
  reg [31:0] r_was;
  always @(posedge aclk) begin
    ar_held <= m_axi_arvalid & ~m_axi_arready & aresetn;
    t_held <= m_axis_hit_tvalid & ~m_axis_hit_tready & aresetn;
    r_held <= s_axi_rvalid & ~s_axi_rready & aresetn;
    b_held <= s_axi_bvalid & ~s_axi_bready & aresetn;
    {ar_was, t_was, r_was} <= {request, hit, s_axi_rdata};
  end
  // Accesses to registers that were taken and not answered.
  reg [1:0] aws = 2'd0, ws = 2'd0, ars = 2'd0;
  wire b_now = s_axi_bvalid & s_axi_bready;
  always @(posedge aclk) begin
    aws <= aresetn ? aws + (s_axi_awvalid & s_axi_awready) - b_now : 2'd0;
    ws <= aresetn ? ws + (s_axi_wvalid & s_axi_wready) - b_now : 2'd0;
    ars <= aresetn ? ars + (s_axi_arvalid & s_axi_arready) - (s_axi_rvalid & s_axi_rready) : 2'd0;
  end
  // Rays outside: those that no answer has come for, and no reset has emptied.
  always @* if (began & aresetn) begin
`ifdef STAYS
    assert (!ar_held || (m_axi_arvalid && request == ar_was));
    assert (!t_held || (m_axis_hit_tvalid && hit == t_was));
    assert (!r_held || (s_axi_rvalid && s_axi_rdata == r_was));
    assert (!b_held || s_axi_bvalid);
`endif
`ifdef BURST
    // A burst begins at a multiple of its size, which divides 4096.
    assert (m_axi_arburst == 2'd1 && (({24'd0, m_axi_arlen} + 32'd1) << m_axi_arsize) == 32'd32);
    assert (m_axi_araddr[4:0] == 5'd0);
`endif
`ifdef LITE
    // A write is answered when address and word have come, in any order, once. So is a read.
    assert (!s_axi_bvalid || (aws != 2'd0 && ws != 2'd0));
    assert (aws <= 2'd2 && ws <= 2'd2 && ars <= 2'd2);
    assert (!s_axi_rvalid || ars != 2'd0);
`endif
`ifdef EMPTIES
    // A soft reset lets no ray in. When it resets the core, no block is on its way and nothing is offered.
    assert (!registers_resets || (in_memory == 3'd0 && unseen == 3'd0 && !m_axi_arvalid && !m_axis_hit_tvalid));
    assert (!registers_resets || !(s_axis_ray_tvalid & s_axis_ray_tready));
    assert (!m_axis_hit_tvalid || in_core != 3'd0);
    assert (!(s_axis_ray_tvalid & s_axis_ray_tready) || core_ray_ready);
`endif
`ifdef EPOCH
    // The core gets a block exactly if it has asked for it since the last hard reset.
    if (comes) assert (reads == (resets_since == 2'd0));
`endif
`ifdef OLD
    assert (!(comes && resets_since == 2'd3));
`endif
`ifdef REACHED
    assert (!(registers_resets && in_core == 3'd2));
`endif
  end
