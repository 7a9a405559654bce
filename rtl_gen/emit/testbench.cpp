#include "rtl_gen/emit/testbench.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/emit/embedded_files.hpp"
#include "rtl_gen/emit/testbench_pins.hpp"

namespace hitpipe::rtl {

namespace {

/// What the testbench's text has for each result.
struct ResultText {
  ResultText(const std::vector<Port>& ports, const char* word) {
    const std::vector<std::string> expected = bits_of_ports(word, ports, total_width(ports));
    for (std::size_t i = 0; i < ports.size(); ++i) {
      const std::string& name = ports[i].name;
      if (ports[i].width == 1) {
        bits += ", " + name;
      } else {
        wires += fmt::format("  wire [{}:0] {};\n", ports[i].width - 1, name);
      }
      differences.push_back(fmt::format("{} !== {}", name, expected[i]));
      formats += fmt::format("{} %b, expected %b, ", name);
      values += fmt::format("{}, {}, ", name, expected[i]);
    }
  }

  std::string bits;   ///< declared beside other wires of one bit
  std::string wires;  ///< declarations of wider results
  std::vector<std::string> differences;
  std::string formats, values;  ///< to print what differs
};

/// What differs between a unit that takes part in a handshake and one whose latency is fixed.
struct FlowText {
  FlowText(bool has_ready, bool tests_wait, bool is_stream, int latency, int interval)
      : ready(has_ready), waits(tests_wait), stream(is_stream) {
    if (ready) {
      // A place of a FIFO fills in an interval. This is some four times as long.
      constants = fmt::format(
          "  // The results stand still for STILL_CYCLES cycles of 8 * STILL_CYCLES, so that all that can "
          "hold one is full.\n"
          "  localparam integer STILL_CYCLES = {};\n",
          4 * (latency + 2 * interval) + 16);
      more = stream ? "\n  reg full, taken;" : "\n  reg full;";
      return;
    }
    // Long enough to show what comes that was never sent.
    constants = fmt::format(
        "  // Edges from the one that takes the operands to the one that latches the results.\n"
        "  localparam integer LATENCY = {};\n  localparam integer SILENT_CYCLES = 2 * LATENCY + 8;\n",
        latency);
    more = fmt::format("\n  reg [LATENCY:0] due;  // by boundary: there is a test\n{}  integer idle;",
                       waits ? "  reg taken;\n" : "");
  }
  [[nodiscard]] const char* only_with_ready(const char* text) const { return ready ? text : ""; }

  /// From the choice of gaps to the last comparison. `compare` are lines that compare results and tag, and
  /// `takes` lines that look at in_ready.
  [[nodiscard]] std::string drive(const std::string& compare, const std::string& takes) const {
    if (ready)
      return fmt::format(R"(      out_ready = !full && random[17:16] != 2'd0;
      #1;
{}      if (out_valid && out_ready) begin
{}        received = received + 1;
      end
{}      @(negedge clk);
      cycles = cycles + 1;
    end
)",
                         takes, compare,
                         stream ? R"(      taken = in_valid && in_ready;
      @(posedge clk);
      #1 if (taken) sent = sent + 1;
)"
                                : R"(      if (in_valid && in_ready) begin
        @(posedge clk);
        #1 sent = sent + 1;
      end
)");
    return fmt::format(R"(      #1;
      if (due[LATENCY] && out_valid !== 1'b1) begin
        $display("FAIL vector %0d (%h): no result %0d cycles after its operands", received, vectors[received],
                 LATENCY);
        $fatal(1);
      end
      if (!due[LATENCY] && out_valid !== 1'b0) begin
        $display("FAIL cycle %0d: out_valid %b, and no test was sent %0d cycles before", cycles, out_valid,
                 LATENCY);
        $fatal(1);
      end
      if (due[LATENCY]) begin
{}        received = received + 1;
      end
{}      @(posedge clk);
      due = {{due[LATENCY-1:0], {}}};
      #1 if ({}) sent = sent + 1;
      @(negedge clk);
      cycles = cycles + 1;
      if (received == COUNT) idle = idle + 1;
    end
)",
                       compare, waits ? "      taken = in_valid && in_ready;\n" : "",
                       waits ? "taken" : "in_valid", waits ? "taken" : "in_valid");
  }

  bool ready;   ///< on both sides
  bool waits;   ///< tests wait for in_ready
  bool stream;  ///< what is offered stays until it is taken
  std::string constants, more;
};

/// Lines that compare results and tag.
std::string comparison(const ResultText& result) {
  return fmt::format(
      R"(        if ({} || out_tag !== received[15:0]) begin
          $display("FAIL vector %0d (%h): {}tag %0d", received, vectors[received],
                   {}out_tag);
          $fatal(1);
        end
)",
      fmt::join(result.differences, " || "), result.formats, result.values);
}

/// The files that are the same for all units, one after the other.
std::string shared_text(const std::string& module) {
  constexpr std::string_view place = "MODULE";
  std::string text;
  for (const EmbeddedFile& file : testbench_files()) text += file.text;
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + module.size()))
    text.replace(at, place.size(), module);
  return text;
}

/// A testbench in the order of its text.
struct Bench {
  Bench(const ModuleInterface& of, int vectors, int latency, const Wrappers& wrappers)
      : unit(of),
        count(vectors),
        around(wrappers),
        width(total_width(of.operands()) + total_width(of.results())),
        ready(of.flow_control() == FlowControl::stall || wrappers.fifo || wrappers.axi_stream),
        result(of.results(), "expected"),
        flow(ready, ready || of.interval > 1, wrappers.axi_stream, latency, of.interval),
        top(tested(of, wrappers, wires_of(of.operands(), width))) {}

  [[nodiscard]] std::string head() const;
  [[nodiscard]] std::string begins() const;
  [[nodiscard]] std::string loop() const;

  const ModuleInterface& unit;
  const int count;
  const Wrappers& around;
  const int width;
  const bool ready;
  const ResultText result;
  const FlowText flow;
  const Tested top;
};

/// Up to the outermost module.
std::string Bench::head() const {
  return fmt::format(
      R"(// Replays {module}_vectors.hex against {top}.v with random gaps{stalls}. Compares every result and
// every tag. Prints PASS, or FAIL with the reason; $fatal then makes the exit code of the simulator non-zero.
//   make icarus, make verilator or make waves; without make,
//   in Icarus Verilog: iverilog -g2012 -o tb {library}{top}_tb.sv ../{top}.v && vvp -n tb
//   in Verilator: verilator --binary -Wall {library}{top}_tb.sv ../{top}.v && obj_dir/V{top}_tb
// +waves=FILE writes the waves of all signals (Verilator needs --trace too).
module {top}_tb;
  localparam integer COUNT = {count};
  // A vector is a line of hexadecimal digits: the operands in port order, then the results.
  localparam integer BITS = {width};
  localparam integer RESULT_BITS = {result_width};
  localparam integer DIGIT_COUNT = (BITS + 3) / 4;
{constants}
  reg [BITS-1:0] vectors [0:COUNT-1];
  reg clk, rst, in_valid{out_ready};{more}
  integer sent, received, cycles;
  reg [31:0] random;
  reg [8*256-1:0] waves;
  wire {in_ready}out_valid{result_bits};
{result_wires}  wire [15:0] out_tag;
  wire [BITS-1:RESULT_BITS] operands = vectors[sent][BITS-1:RESULT_BITS];
  wire [RESULT_BITS-1:0] expected = vectors[received][RESULT_BITS-1:0];

  {top} #(.TAG_BITS(16)) dut (
    {test_pins},
    {result_pins},
{data_pins}
  );

)",
      fmt::arg("module", unit.module), fmt::arg("top", top.module),
      fmt::arg("stalls", flow.only_with_ready(" and stalls")),
      fmt::arg("library", top.module == unit.module ? "" : "-y .. "), fmt::arg("count", count),
      fmt::arg("width", width), fmt::arg("result_width", total_width(unit.results())),
      fmt::arg("constants", flow.constants), fmt::arg("out_ready", flow.only_with_ready(", out_ready")),
      fmt::arg("more", flow.more), fmt::arg("in_ready", flow.waits ? "in_ready, " : ""),
      fmt::arg("result_bits", result.bits), fmt::arg("result_wires", result.wires + top.wires),
      fmt::arg("test_pins", top.test_pins), fmt::arg("result_pins", top.result_pins),
      fmt::arg("data_pins", top.data_pins));
}

/// The first cycles.
std::string Bench::begins() const {
  return fmt::format(
      R"(  // Values change at the falling edge; {seen} are seen as they stand before the rising edge.
  initial begin
    if ($value$plusargs("waves=%s", waves)) begin
      $dumpfile(waves);
      $dumpvars(0, {top}_tb);
    end
    rst = 1'b1; in_valid = 1'b0;{no_out_ready}
    sent = 0; received = 0; cycles = 0; random = 32'd1;{nothing_due}
    read_vectors;
    repeat (4) @(negedge clk);
    rst = 1'b0;
)",
      fmt::arg("seen", flow.ready ? "handshakes" : "results"), fmt::arg("top", top.module),
      fmt::arg("no_out_ready", flow.only_with_ready(" out_ready = 1'b0;")),
      fmt::arg("nothing_due", flow.ready ? "" : " due = 0; idle = 0;"));
}

/// A cycle, and the end.
std::string Bench::loop() const {
  const std::string in_time =
      fmt::format("cycles < {} * COUNT{} + 1000", 16 * unit.interval, ready ? " + 16 * STILL_CYCLES" : "");
  const bool is_plain = !around.fifo && !around.axi_stream;
  const char* const takes = ready && is_plain && unit.interval == 1
                                ? R"(      if (in_ready !== (out_ready || !out_valid)) begin
        $display("FAIL cycle %0d: in_ready %b, out_ready %b, out_valid %b", cycles, in_ready, out_ready, out_valid);
        $fatal(1);
      end
)"
                                : "";
  return fmt::format(
      R"(    while ({running}) begin
      // Gaps{stalls} are the same in every simulator.
      random = random ^ (random << 13);
      random = random ^ (random >> 17);
      random = random ^ (random << 5);
{full}      in_valid = {held}sent != COUNT && {offers};
{drive}    if (received != COUNT) begin
      $display("FAIL %0d of %0d vectors came back", received, COUNT);
      $fatal(1);
    end
    $display("PASS %0d vectors", received);
    $finish;
  end
endmodule
)",
      fmt::arg("running", flow.ready   ? "received != COUNT && " + in_time
                          : flow.waits ? "idle != SILENT_CYCLES && " + in_time
                                       : "idle != SILENT_CYCLES"),
      fmt::arg("stalls", flow.only_with_ready(" and stalls")),
      fmt::arg("full", flow.only_with_ready("      full = cycles / STILL_CYCLES % 8 == 1;\n")),
      fmt::arg("held", around.axi_stream ? "(in_valid && !taken) || " : ""),
      fmt::arg("offers", ready ? "(full || random[9:8] != 2'd0)" : "random[9:8] != 2'd0"),
      fmt::arg("drive", flow.drive(comparison(result), takes)));
}

}  // namespace

std::string testbench(const ModuleInterface& unit, int count, int latency, const Wrappers& around) {
  const Bench bench(unit, count, latency, around);
  return bench.head() + shared_text(unit.module) + "\n" + bench.begins() + bench.loop();
}

}  // namespace hitpipe::rtl
