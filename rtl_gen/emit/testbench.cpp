#include "rtl_gen/emit/testbench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

/// The bits of a word, or its only bit.
std::string part_of(const char* word, int high, int low) {
  return high == low ? fmt::format("{}[{}]", word, low) : fmt::format("{}[{}:{}]", word, high, low);
}

/// The bits of each port in a word that holds them all, the last port lowest.
std::vector<std::string> fields(const char* word, const std::vector<Port>& ports, int width) {
  std::vector<std::string> all;
  for (const Port& port : ports) {
    all.push_back(part_of(word, width - 1, width - port.width));
    width -= port.width;
  }
  return all;
}

/// What the testbench's text has for each result.
struct ResultText {
  ResultText(const std::vector<Port>& ports, const char* word) {
    const std::vector<std::string> expected = fields(word, ports, total_width(ports));
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
  FlowText(const ModuleInterface& unit, int latency)
      : ready(unit.flow_control() == FlowControl::stall), waits(unit.has_ready(tests_channel)) {
    if (ready) return;
    // Long enough to show what comes that was never sent.
    constants = fmt::format(
        "  // Edges from the one that takes the operands to the one that latches the results.\n"
        "  localparam integer LATENCY = {};\n  localparam integer IDLE = 2 * LATENCY + 8;\n",
        latency);
    more = fmt::format("\n  reg [LATENCY:0] due;  // by boundary: there is a test\n{}  integer idle;",
                       waits ? "  reg taken;\n" : "");
  }
  [[nodiscard]] const char* only_with_ready(const char* text) const { return ready ? text : ""; }

  /// From the choice of gaps to the last comparison. `compare` are lines that compare results and tag.
  [[nodiscard]] std::string drive(const std::string& compare) const {
    if (ready)
      return fmt::format(R"(      out_ready = random[17:16] != 2'd0;
      #1;
      if (out_valid && out_ready) begin
{}        received = received + 1;
      end
      if (in_valid && in_ready) begin
        @(posedge clk);
        #1 sent = sent + 1;
      end
      @(negedge clk);
      cycles = cycles + 1;
    end
)",
                         compare);
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

  bool ready;  ///< on both sides
  bool waits;  ///< tests wait for in_ready
  std::string constants, more;
};

}  // namespace

std::string testbench(const ModuleInterface& unit, int count, int latency) {
  const std::vector<Port> ports = unit.operands();
  const int result_width = total_width(unit.results());
  const int width = total_width(ports) + result_width;
  const std::vector<std::string> operands = fields("operands", ports, width);
  const ResultText result(unit.results(), "expected");
  const FlowText flow(unit, latency);
  const std::string in_time = fmt::format("cycles < {} * COUNT + 1000", 16 * unit.interval);
  std::size_t next = 0;
  const auto wire = [&](const Pin& pin) {
    if (pin.channel == tests_channel && pin.role == Pin::Role::tag) return std::string("sent[15:0]");
    return pin.channel == tests_channel && pin.role == Pin::Role::data ? operands[next++] : pin.name;
  };
  const std::string compare = fmt::format(
      R"(        if ({} || out_tag !== received[15:0]) begin
          $display("FAIL vector %0d (%h): {}tag %0d", received, vectors[received],
                   {}out_tag);
          $fatal(1);
        end
)",
      fmt::join(result.differences, " || "), result.formats, result.values);
  return fmt::format(
      R"(// Replays {module}_vectors.hex against {module}.v with random gaps{stalls}. Compares every result and
// every tag. Prints PASS, or FAIL with the reason; $fatal then makes the exit code of the simulator non-zero.
//   make icarus, make verilator or make waves; without make,
//   in Icarus Verilog: iverilog -g2012 -o tb {module}_tb.sv ../{module}.v && vvp -n tb
//   in Verilator: verilator --binary -Wall {module}_tb.sv ../{module}.v && obj_dir/V{module}_tb
// +waves=FILE writes the waves of all signals (Verilator needs --trace too).
module {module}_tb;
  localparam integer COUNT = {count};
  // A vector is a line of hexadecimal digits: the operands in port order, then the results.
  localparam integer BITS = {width};
  localparam integer RESULT_BITS = {result_width};
  localparam integer DIGITS = (BITS + 3) / 4;
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

  {module} #(.TAG_BITS(16)) dut (
    {test_pins},
    {result_pins},
{data_pins}
  );

  // Unlike $readmemh, this sees every damage of the file, and sees the same in every simulator.
  task read_vectors;
    integer file, length, line, found;
    reg in_comment;
    reg [8*(DIGITS+1)-1:0] text;
    reg [8*DIGITS-1:0] digits;
    reg [BITS-1:0] vector;
    begin
      file = $fopen("{module}_vectors.hex", "r");
      if (file == 0) begin
        $display("FAIL {module}_vectors.hex: cannot be opened");
        $fatal(1);
      end
      line = 1; found = 0; in_comment = 1'b0;
      length = $fgets(text, file);
      while (length != 0) begin
        if (text[8*(length-1) +: 8] == "/") in_comment = 1'b1;
        if (!in_comment && length > 1) begin
          // A good line is the one that %h writes for its number.
          if ($sscanf(text, "%h", vector) != 1) vector = {{BITS{{1'b0}}}};
          $sformat(digits, "%h", vector);
          if (text != {{digits, 8'h0a}} || ^vector === 1'bx) begin
            $display("FAIL {module}_vectors.hex, line %0d: not %0d lower-case hexadecimal digits of %0d bits",
                     line, DIGITS, BITS);
            $fatal(1);
          end
          if (found < COUNT) vectors[found] = vector;
          found = found + 1;
        end
        if (text[7:0] == 8'h0a) begin
          in_comment = 1'b0;
          line = line + 1;
        end
        length = $fgets(text, file);
      end
      $fclose(file);
      if (found != COUNT) begin
        $display("FAIL {module}_vectors.hex: %0d vectors, expected %0d", found, COUNT);
        $fatal(1);
      end
    end
  endtask

  initial begin
    clk = 1'b0;
    forever #5 clk = ~clk;
  end

  // Values change at the falling edge; {seen} are seen as they stand before the rising edge.
  initial begin
    if ($value$plusargs("waves=%s", waves)) begin
      $dumpfile(waves);
      $dumpvars(0, {module}_tb);
    end
    rst = 1'b1; in_valid = 1'b0;{no_out_ready}
    sent = 0; received = 0; cycles = 0; random = 32'd1;{nothing_due}
    read_vectors;
    repeat (4) @(negedge clk);
    rst = 1'b0;
    while ({running}) begin
      // Gaps{stalls} are the same in every simulator.
      random = random ^ (random << 13);
      random = random ^ (random >> 17);
      random = random ^ (random << 5);
      in_valid = sent != COUNT && random[9:8] != 2'd0;
{drive}    if (received != COUNT) begin
      $display("FAIL %0d of %0d vectors came back", received, COUNT);
      $fatal(1);
    end
    $display("PASS %0d vectors", received);
    $finish;
  end
endmodule
)",
      fmt::arg("module", unit.module), fmt::arg("count", count), fmt::arg("width", width),
      fmt::arg("result_width", result_width), fmt::arg("result_bits", result.bits),
      fmt::arg("result_wires", result.wires),
      fmt::arg("test_pins", unit.control_connections({"", tests_channel}, wire)),
      fmt::arg("result_pins", unit.control_connections({results_channel}, wire)),
      fmt::arg("data_pins", unit.data_connections(wire)),
      fmt::arg("stalls", flow.only_with_ready(" and stalls")), fmt::arg("constants", flow.constants),
      fmt::arg("more", flow.more), fmt::arg("out_ready", flow.only_with_ready(", out_ready")),
      fmt::arg("in_ready", flow.waits ? "in_ready, " : ""),
      fmt::arg("seen", flow.ready ? "handshakes" : "results"),
      fmt::arg("no_out_ready", flow.only_with_ready(" out_ready = 1'b0;")),
      fmt::arg("nothing_due", flow.ready ? "" : " due = 0; idle = 0;"),
      fmt::arg("running", flow.ready   ? "received != COUNT && " + in_time
                          : flow.waits ? "idle != IDLE && " + in_time
                                       : "idle != IDLE"),
      fmt::arg("drive", flow.drive(compare)));
}

std::string testbench_makefile() {
  return R"(# Simulates the units that have a testbench in this folder. Each target fails when a vector does.
#   make icarus       the testbench in Icarus Verilog (11 or later)
#   make verilator    the testbench in Verilator (5.006 or later)
#   make harness      the C++ program that drives the unit as Verilator compiles it
#   make waves        the testbench in Icarus Verilog; writes UNIT.vcd
#   make clean        removes all that these have written
# With WAVES=vcd or WAVES=fst each of them writes waves in that format. UNITS=NAME takes one unit of several.
UNITS := $(patsubst %_tb.sv,%,$(wildcard *_tb.sv))
IVERILOG := iverilog
VVP := vvp
VERILATOR := verilator
# A unit that was fitted to a scene checks its operands; other units do not read this.
DEFINES := -DHITPIPE_CHECK

ifneq ($(filter-out vcd fst,$(WAVES)),)
$(error WAVES=$(WAVES): allowed are vcd and fst)
endif
TRACE_vcd := --trace
TRACE_fst := --trace-fst
TRACE := $(TRACE_$(WAVES))

.PHONY: icarus verilator harness waves clean
icarus: $(UNITS:%=icarus-%)
verilator: $(UNITS:%=verilator-%)
harness: $(UNITS:%=harness-%)
waves:
	$(MAKE) icarus WAVES=$(or $(WAVES),vcd)

# Verilator and make see for themselves what must be compiled again. Verilator cannot build in a folder with a blank in its
# name; then the build is in a temporary folder.
ROOM := $(if $(word 2,$(CURDIR)),$(or $(TMPDIR),/tmp)/hitpipe-$(shell id -u)-$(shell pwd | cksum | tr ' ' -),build)
BUILD = $(ROOM)/$(1)_$*$(WAVES:%=_%)
RUN_WAVES = $(if $(WAVES),+waves=$*.$(WAVES))
COMPILE = $(VERILATOR) -Wall $(TRACE) $(DEFINES) -j 0 -MAKEFLAGS -s -Mdir

.PHONY: $(UNITS:%=icarus-%) $(UNITS:%=verilator-%) $(UNITS:%=harness-%)
$(UNITS:%=icarus-%): icarus-%:
	@mkdir -p $(ROOM)
	$(IVERILOG) -g2012 -Wall $(DEFINES) -s $*_tb -o $(call BUILD,icarus) $*_tb.sv ../$*.v
	$(VVP) -n $(call BUILD,icarus) $(if $(WAVES),-$(WAVES)) $(RUN_WAVES)

$(UNITS:%=verilator-%): verilator-%:
	@mkdir -p $(ROOM)
	$(COMPILE) $(call BUILD,tb) --binary --top-module $*_tb $*_tb.sv ../$*.v
	$(call BUILD,tb)/V$*_tb $(RUN_WAVES)

$(UNITS:%=harness-%): harness-%:
	@mkdir -p $(call BUILD,harness)
	@cp $*_harness.cpp $(call BUILD,harness)
	$(COMPILE) $(call BUILD,harness) --cc --exe --build --top-module $* ../$*.v $*_harness.cpp
	$(call BUILD,harness)/V$*

clean:
	rm -rf $(ROOM) $(UNITS:%=%.vcd) $(UNITS:%=%.fst)
)";
}

}  // namespace hitpipe::rtl
