// A Verilog testbench of the AXI4-Stream wrapper and the beats that it sends. It packs the beats itself,
// fills their padding at random, and watches the protocol: tvalid waits for nothing, what is offered stays
// until it is taken, no input reaches an output in the same cycle, and a reset empties everything.
//   +mode  0 no stalls  1 random gaps and stalls  2 mostly stalled  3 tready only after tvalid
//          4 sixteen cycles stalled, sixteen not  5 stalled for long, then never again
#pragma once

#include <cstdint>
#include <filesystem>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl {

/// The numbers in bytes, hexadecimal, highest byte first; the first number is in the low bytes. Bits above a
/// number come from `padding`.
template <class Padding>
std::string stream_bytes(const std::vector<Port>& ports, const std::vector<std::int64_t>& numbers,
                         Padding padding) {
  std::string bytes;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const int width = ports[i].width;
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - width);
    std::uint64_t field = (static_cast<std::uint64_t>(numbers[i]) & mask) | (padding() & ~mask);
    std::string part;
    for (int byte = 0; 8 * byte < width; ++byte, field >>= 8)
      part.insert(0, fmt::format("{:02x}", field & 0xff));
    bytes.insert(0, part);
  }
  return bytes;
}

/// A beat a line: the expected m_axis_tdata, then s_axis_tdata.
inline std::string stream_beats(const Design& design, Format format, int count, std::uint64_t seed) {
  const std::vector<Port> ports = design.ports(format);
  const std::vector<Port> results = result_ports(design.results(format));
  std::mt19937_64 random(seed);
  std::string text;
  for (const Vector& vector : with_results(operand_vectors(ports, count, seed), design.evaluate(format))) {
    text += stream_bytes(results, vector.results, [] { return std::uint64_t{0}; });
    text += stream_bytes(ports, vector.operands, [&] { return random(); }) + "\n";
  }
  return text;
}

/// The seed of the beats, and how many are sent. Icarus takes a second for a thousand of a float design. The
/// tests damage the wrappers and the FIFO in every way that they know, and each damage is found within this
/// many beats.
inline constexpr std::uint64_t beat_seed = 53;
inline constexpr int beat_count = 250;
/// The verdict that nothing is wrong.
inline const std::string all_passed = fmt::format("PASS {} beats", beat_count);

/// Of the module <module>_axis.
inline std::string stream_bench(const Design& design, Format format, int count, int interval) {
  return fmt::format(R"(module axis_bench;
  localparam COUNT = {2};
  localparam BITS = {1};
  localparam RESULTS = {3};
  reg [BITS+RESULTS-1:0] beats [0:COUNT-1];
  reg aclk, aresetn, s_valid, m_ready, taken, given, held;
  reg [15:0] sent, received;
  reg [RESULTS+15:0] before;
  integer seed, errors, cycles, mode;
  wire s_ready, m_valid;
  wire [RESULTS-1:0] m_data;
  wire [15:0] m_tid;
  wire [BITS+RESULTS-1:0] beat = beats[sent];
  wire [BITS+RESULTS-1:0] expected = beats[received];

  {0}_axis #(.TAG_BITS(16)) dut (
    .aclk(aclk), .aresetn(aresetn),
    .s_axis_tvalid(s_valid), .s_axis_tready(s_ready), .s_axis_tdata(beat[BITS-1:0]), .s_axis_tid(sent * 16'ha5c3),
    .m_axis_tvalid(m_valid), .m_axis_tready(m_ready), .m_axis_tdata(m_data), .m_axis_tid(m_tid));

  always #5 aclk = ~aclk;

  task fail(input [8*24-1:0] what);
    begin
      if (errors == 0) $display("FAIL %0s at beat %0d: tdata %h, tid %h, expected %h", what, received, m_data,
                                m_tid, expected);
      errors = errors + 1;
    end
  endtask

  // Outputs while tvalid and tready of the other side change within a cycle.
  task probe;
    reg sv, mr, r, v;
    begin
      sv = s_valid; mr = m_ready; r = s_ready; v = m_valid;
      s_valid = ~sv; m_ready = ~mr; #1;
      if (s_ready !== r || m_valid !== v) fail("combinational path");
      s_valid = sv; m_ready = mr; #1;
    end
  endtask

  initial begin
    $readmemh("beats.hex", beats);
    if (!$value$plusargs("mode=%d", mode)) mode = 1;
    aclk = 1'b0; aresetn = 1'b0; s_valid = 1'b0; m_ready = 1'b0; taken = 1'b0; held = 1'b0;
    sent = 16'd0; received = 16'd0; seed = 7; errors = 0; cycles = 0;
    repeat (4) @(negedge aclk);
    if (m_valid !== 1'b0) fail("tvalid in reset");
    aresetn = 1'b1;
    while (received != COUNT && errors == 0 && cycles < 40 * COUNT + 1000) begin
      if (!s_valid || taken) s_valid = sent != COUNT && (mode == 0 || mode == 2 || mode > 3 || ($random(seed) & 3) != 0);
      case (mode)
        0: m_ready = 1'b1;
        1: m_ready = ($random(seed) & 3) != 0;
        2: m_ready = ($random(seed) & 15) == 0;
        4: m_ready = cycles[4];
        5: m_ready = cycles > 300;
        default: m_ready = m_valid && ($random(seed) & 1) != 0;
      endcase
      #1 probe;
      if (held && (!m_valid || {{m_data, m_tid}} !== before)) fail("not held");
      taken = s_valid && s_ready;
      given = m_valid && m_ready;
      held = m_valid && !m_ready;
      before = {{m_data, m_tid}};
      if (given && (m_data !== expected[BITS+RESULTS-1:BITS] || m_tid !== (received * 16'ha5c3))) fail("wrong result");
      @(posedge aclk);
      #1;
      if (taken) sent = sent + 16'd1;
      if (given) received = received + 16'd1;
      @(negedge aclk);
      cycles = cycles + 1;
    end
    if (errors == 0 && received != COUNT) fail("beats missing");
    // A full pipeline, stalled; then a reset.
    s_valid = 1'b1; m_ready = 1'b0; sent = 16'd0;
    repeat ({4}) @(negedge aclk);
    if (m_valid !== 1'b1 || s_ready !== 1'b0) fail("not full");
    s_valid = 1'b0; aresetn = 1'b0;
    @(negedge aclk);
    aresetn = 1'b1;
    repeat ({4}) begin
      if (m_valid !== 1'b0) fail("not emptied by reset");
      @(negedge aclk);
    end
    if (errors == 0) $display("PASS %0d beats in %0d cycles", received, cycles);
    $finish;
  end
endmodule
)",
                     design.module_at(format), stream_bits(design.ports(format)), count,
                     stream_bits(result_ports(design.results(format))), 60 * interval);
}

/// The bench around the wrapper in a folder, compiled once for all modes.
class StreamBench {
 public:
  StreamBench(const std::filesystem::path& folder, const Design& design, Format format, int interval = 1)
      : folder_(folder) {
    write_text(folder / "beats.hex", stream_beats(design, format, beat_count, beat_seed));
    write_text(folder / "bench.v", stream_bench(design, format, beat_count, interval));
    expect_silence(
        folder, "iverilog",
        fmt::format(
            "-g2001 -Wall -Wno-timescale -o bench bench.v $(ls {0}_fifo.v 2>/dev/null) {0}_axis.v {0}.v",
            design.module_at(format)));
  }
  /// Its verdict, a line.
  [[nodiscard]] std::string run(int mode) const {
    const std::string printed =
        run_tool(folder_, "iverilog", "vvp", fmt::format("bench +mode={}", mode)).output;
    std::smatch verdict;
    return std::regex_search(printed, verdict, std::regex("(PASS|FAIL).*")) ? verdict.str() : "no verdict";
  }
  [[nodiscard]] int cycles(int mode) const {
    const std::string verdict = run(mode);
    EXPECT_TRUE(verdict.starts_with(all_passed)) << verdict;
    return std::stoi(verdict.substr(verdict.rfind(" in ") + 4));
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace hitpipe::rtl
