#include "rtl_gen/board/top.hpp"

#include <algorithm>
#include <bit>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"
#include "rtl_gen/emit/vectors.hpp"

namespace hitpipe::rtl {

std::string serial_line(const std::string& prefix) {
  return fmt::format(
      R"(
// Receives bytes. A byte without its stop bit is dropped.
module {0}_rx #(
  parameter [15:0] CLOCKS_PER_BIT = 16'd12
) (
  input  wire clk,
  input  wire rst,
  input  wire line,
  output reg  valid,  // for one cycle
  output reg  [7:0] data
);
  localparam [15:0] WHOLE = CLOCKS_PER_BIT - 16'd1;
  localparam [15:0] HALF = (CLOCKS_PER_BIT >> 1) - 16'd1;

  reg [1:0] seen;  // the line changes at any time: two registers bring it to the clock
  wire level = seen[1];
  reg idle_seen;   // the line was high since the last byte
  reg receiving;
  reg [3:0] place;
  reg [15:0] ticks;
  always @(posedge clk) begin
    seen <= {{seen[0], line}};
    valid <= 1'b0;
    if (rst) begin
      idle_seen <= 1'b0;
      receiving <= 1'b0;
    end else if (~receiving) begin
      if (level) idle_seen <= 1'b1;
      else if (idle_seen) begin
        idle_seen <= 1'b0;
        receiving <= 1'b1;
        place <= 4'd0;
        ticks <= HALF;
      end
    end else if (ticks != 16'd0) ticks <= ticks - 16'd1;
    else begin
      ticks <= WHOLE;
      place <= place + 4'd1;
      if (place == 4'd0) begin
        if (level) receiving <= 1'b0;  // no start bit, a glitch
      end else if (place == 4'd9) begin
        receiving <= 1'b0;
        valid <= level;
      end else data <= {{level, data[7:1]}};
    end
  end
endmodule

// Sends bytes. One is taken at an edge with valid and ready high.
module {0}_tx #(
  parameter [15:0] CLOCKS_PER_BIT = 16'd12
) (
  input  wire clk,
  input  wire rst,
  input  wire valid,
  output wire ready,
  input  wire [7:0] data,
  output wire line
);
  localparam [15:0] WHOLE = CLOCKS_PER_BIT - 16'd1;

  reg [8:0] bits;  // on the line is the lowest
  reg [3:0] left;  // bits that have not ended, with start and stop
  reg [15:0] ticks;
  assign ready = left == 4'd0;
  assign line = bits[0];
  always @(posedge clk) begin
    if (rst) begin
      bits <= 9'h1ff;
      left <= 4'd0;
    end else if (ready) begin
      if (valid) begin
        bits <= {{data, 1'b0}};
        left <= 4'd10;
        ticks <= WHOLE;
      end
    end else if (ticks != 16'd0) ticks <= ticks - 16'd1;
    else begin
      bits <= {{1'b1, bits[8:1]}};
      left <= left - 4'd1;
      ticks <= WHOLE;
    end
  end
endmodule
)",
      prefix);
}

std::uint64_t fingerprint(const Design& design, const Format& format) {
  const std::vector<Port> ports = design.ports(format);
  constexpr int vectors = 1000;
  constexpr std::uint64_t seed = 1;
  std::string text;
  for (const auto& each : {ports, result_ports(design.results(format))}) {
    for (const Port& port : each)
      text += fmt::format("{} {} {}\n", port.name, port.width, port.is_signed ? "signed" : "unsigned");
  }
  for (const Vector& vector : with_results(operand_vectors(ports, vectors, seed), design.evaluate(format))) {
    for (const std::int64_t result : vector.results) text += fmt::format("{} ", result);
  }
  return host::fnv1a(std::as_bytes(std::span(text)));
}

std::string board_identity(const Design& design, const Format& format) {
  return fmt::format("hitpipe {} {} {} {:016x}", board_protocol, design.name, to_string(format),
                     fingerprint(design, format));
}

namespace {

/// The bits of each port in a word. The first port has the low bits.
std::vector<std::string> fields(const std::vector<Port>& ports, const char* word) {
  std::vector<std::string> all;
  int low = 0;
  for (const Port& port : ports) {
    all.push_back(fmt::format("{}[{}:{}]", word, low + port.width - 1, low));
    low += port.width;
  }
  return all;
}

std::string letters_of(const std::string& text, int address_bits) {
  std::string cases;
  for (std::size_t i = 0; i < text.size(); ++i)
    cases += fmt::format("      {}'d{}: letter = 8'h{:02x};{}\n", address_bits, i,
                         static_cast<unsigned char>(text[i]), i == 0 ? fmt::format("  // {}", text) : "");
  return cases;
}

/// Bits for the numbers 0..most.
int bits_for(int most) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(most)));
}

constexpr const char* receiving = R"(
  // A frame: bytes between two flags, escaped, with a check sequence at the end (RFC 1662).
  wire byte_valid;
  wire [7:0] byte_in;
  reg escaped;
  reg [15:0] check_in;
  reg [{1}:0] count;  // bytes of the frame; it stops at one too many
  reg is_test;
  reg is_who;
  reg [7:0] tag;
  reg [{2}:0] operands;
  {0}_rx #(.CLOCKS_PER_BIT(CLOCKS_PER_BIT)) receiver (
    .clk(clk), .rst(rst), .line(rx), .valid(byte_valid), .data(byte_in)
  );
  wire flag = byte_in == 8'h7e;
  wire [7:0] plain = escaped ? byte_in ^ 8'h20 : byte_in;
  wire sound = byte_valid & flag & ~escaped & (check_in == 16'hf0b8);
  wire test = sound & is_test & (count == {3});
  wire who = sound & is_who & (count == {4});
{10}  wire asked = who & free;
  always @(posedge clk) begin
    if (rst) begin
      escaped <= 1'b0;
      check_in <= 16'hffff;
      count <= {5};
    end else if (byte_valid) begin
      if (flag) begin
        escaped <= 1'b0;
        check_in <= 16'hffff;
        count <= {5};
      end else if (byte_in == 8'h7d) escaped <= 1'b1;
      else begin
        escaped <= 1'b0;
        check_in <= check_of(check_in, plain);
        if (count != {6}) count <= count + {7};
        if (count == {5}) begin
          is_test <= plain == "T";
          is_who <= plain == "I";
        end else if (count == {7}) tag <= plain;
        else if (count < {8}) operands <= {9};
      end
    end
  end
)";

constexpr const char* taking = R"(  wire free = ~waiting & ~sending;
  wire taken = test & free & in_ready;
)";

/// The next frame changes tag and operands two bytes later at the earliest, after more cycles than any
/// interval has.
constexpr const char* taking_later = R"(  reg offered;  // until the unit is ready
  wire free = ~waiting & ~sending & ~offered;
  wire taken = offered & in_ready;
  always @(posedge clk) begin
    if (rst) offered <= 1'b0;
    else if (test & free) offered <= 1'b1;
    else if (in_ready) offered <= 1'b0;
  end
)";

constexpr const char* answering = R"(
  // The answer: a flag, the kind, the tag, the body, the check sequence, a flag.
  reg about_who;
  reg [7:0] answer_tag;
  reg [{0}:0] answer;
  reg [{1}:0] place;
  reg [15:0] check_out;
  reg after_escape;
  wire ready;
  wire [{1}:0] body_end = about_who ? {2} : {3};
  wire at_flag = place == {4} | place == body_end + {5};
  reg [7:0] chosen;
  always @(*) begin
    if (at_flag) chosen = 8'h7e;
    else if (place == {6}) chosen = about_who ? "I" : "T";
    else if (place == {7}) chosen = answer_tag;
    else if (place == body_end) chosen = ~check_out[7:0];
    else if (place == body_end + {6}) chosen = ~check_out[15:8];
    else chosen = about_who ? letter(place - {8}) : answer[7:0];
  end
  wire must_escape = ~at_flag & ~after_escape & (chosen == 8'h7e | chosen == 8'h7d);
  wire [7:0] byte_out = must_escape ? 8'h7d : after_escape ? chosen ^ 8'h20 : chosen;
  {9}_tx #(.CLOCKS_PER_BIT(CLOCKS_PER_BIT)) transmitter (
    .clk(clk), .rst(rst), .valid(sending), .ready(ready), .data(byte_out), .line(tx)
  );
  always @(posedge clk) begin
    if (rst) begin
      waiting <= 1'b0;
      sending <= 1'b0;
    end else if (taken) begin
      waiting <= 1'b1;
      about_who <= 1'b0;
    end else if (waiting) begin
      if (out_valid) begin
        waiting <= 1'b0;
        sending <= 1'b1;
        answer_tag <= out_tag;
        answer <= {10};
      end
    end else if (asked) begin
      sending <= 1'b1;
      about_who <= 1'b1;
      answer_tag <= tag;
    end else if (sending & ready) begin
      after_escape <= must_escape;
      if (~must_escape) begin
        place <= place + {6};
        if (~at_flag & place < body_end) check_out <= check_of(check_out, chosen);
        if (~at_flag & place >= {8} & place < body_end) answer <= {11};
        if (place == body_end + {5}) sending <= 1'b0;
      end
    end
    if (~sending) begin
      place <= {4};
      check_out <= 16'hffff;
      after_escape <= 1'b0;
    end
  end
)";

/// A register of whole bytes without its lowest byte, `above` above the rest.
std::string shifted(const char* name, int bytes, const char* above) {
  return bytes == 1 ? std::string(above) : fmt::format("{{{}, {}[{}:8]}}", above, name, 8 * bytes - 1);
}

}  // namespace

BoardUnit board_unit(const Design& design, const Format& format, const std::string& module,
                     const Pipeline& pipeline) {
  return {unit_interface(module, input_ports(pipeline.graph), result_ports(design.results(format)),
                         FlowControl::stall),
          board_identity(design, format), pipeline.interval()};
}

int packed_bytes(const std::vector<Port>& ports) {
  return (total_width(ports) + 7) / 8;
}

std::string board_module(const std::string& unit) {
  return unit + "_board";
}

std::string board_top(const BoardUnit& board, int clocks_per_bit) {
  const ModuleInterface& unit = board.unit;
  const std::vector<Port> operands = unit.operands();
  const std::vector<Port> results = unit.results();
  const int operand_bytes = packed_bytes(operands);
  const int result_bytes = packed_bytes(results);
  const int operand_bits = total_width(operands);
  const int result_bits = total_width(results);
  const int text_bytes = static_cast<int>(board.identity.size());
  const std::string serial = board_module(unit.module) + "_serial";

  const int whole_test = operand_bytes + 4;  // kind, tag, two of the check sequence
  const int count_bits = bits_for(whole_test + 1);
  const auto number = [&](int n) { return fmt::format("{}'d{}", count_bits, n); };
  const std::string receive =
      fmt::format(receiving, serial, count_bits - 1, 8 * operand_bytes - 1, number(whole_test), number(4),
                  number(0), number(whole_test + 1), number(1), number(operand_bytes + 2),
                  shifted("operands", operand_bytes, "plain"), board.interval == 1 ? taking : taking_later);

  // Flag, kind and tag, the longer of both bodies, check sequence and flag.
  const int place_bits = bits_for(3 + std::max(text_bytes, result_bytes) + 3);
  const auto at = [&](int n) { return fmt::format("{}'d{}", place_bits, n); };
  const std::string padding =
      8 * result_bytes > result_bits ? fmt::format("{}'d0, ", 8 * result_bytes - result_bits) : "";
  const std::string send =
      fmt::format(answering, 8 * result_bytes - 1, place_bits - 1, at(3 + text_bytes), at(3 + result_bytes),
                  at(0), at(2), at(1), at(2), at(3), serial, fmt::format("{{{}results}}", padding),
                  shifted("answer", result_bytes, "8'd0"));

  std::vector<std::string> data = fields(operands, "operands");
  for (std::string& each : fields(results, "results")) data.push_back(std::move(each));
  std::size_t next = 0;
  const std::string instance = unit.instance("unit_i", "8", [&](const Pin& pin) -> std::string {
    if (pin.role == Pin::Role::data) return data[next++];
    return pin.name == "in_valid"    ? "taken"
           : pin.name == "in_tag"    ? "tag"
           : pin.name == "out_ready" ? "1'b1"
                                     : pin.name;
  });
  const std::string unused = 8 * operand_bytes > operand_bits
                                 ? fmt::format("  wire unused = &{{1'b0, operands[{}:{}]}};  // padding\n",
                                               8 * operand_bytes - 1, operand_bits)
                                 : "";
  return fmt::format(
             R"(// {0} as the whole of a chip, on a serial line: operands come in frames, results go back. docs/chips.md
// of hitpipe describes the bytes. The red lamp is lit after a frame that was damaged or not taken, the green
// one after the first answer; the button resets.
// Generated by hitpipe; do not edit.
module {1} #(
  parameter [15:0] CLOCKS_PER_BIT = 16'd{2}
) (
  input  wire clk,
  input  wire rx,
  output wire tx,
  input  wire button_n,
  output wire led_red_n,
  output wire led_green_n
);
  // Reset after power-on and while the button is pressed.
  reg [1:0] button = 2'd0;
  reg [3:0] awake = 4'd0;
  wire rst = awake != 4'd15;
  always @(posedge clk) begin
    button <= {{button[0], ~button_n}};
    if (button[1]) awake <= 4'd0;
    else if (rst) awake <= awake + 4'd1;
  end

  // The check sequence of RFC 1662, a byte further.
  function [15:0] check_of(input [15:0] from, input [7:0] data);
    integer i;
    begin
      check_of = from ^ {{8'd0, data}};
      for (i = 0; i < 8; i = i + 1)
        check_of = check_of[0] ? (check_of >> 1) ^ 16'h8408 : check_of >> 1;
    end
  endfunction

  // What the unit is, in letters.
  function [7:0] letter(input [{3}:0] number);
    case (number)
{4}      default: letter = 8'd0;
    endcase
  endfunction

  reg waiting;  // for the unit
  reg sending;  // an answer
  wire in_ready;
  wire out_valid;
  wire [7:0] out_tag;
  wire [{5}:0] results;
)",
             unit.module, board_module(unit.module), clocks_per_bit, place_bits - 1,
             letters_of(board.identity, place_bits), result_bits - 1) +
         receive + send +
         fmt::format(R"(
{0}
  reg answered;
  reg damaged;
  always @(posedge clk) begin
    if (rst) begin
      answered <= 1'b0;
      damaged <= 1'b0;
    end else begin
      if (sending) answered <= 1'b1;
      if (byte_valid & flag & (count != {1}) & ~{3} & ~asked) damaged <= 1'b1;
    end
  end
  assign led_green_n = ~answered;
  assign led_red_n = ~damaged;
{2}endmodule
)",
                     instance, number(0), unused, board.interval == 1 ? "taken" : "(test & free)") +
         serial_line(serial);
}

}  // namespace hitpipe::rtl
