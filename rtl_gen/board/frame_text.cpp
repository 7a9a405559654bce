#include "rtl_gen/board/frame_text.hpp"

#include <bit>

#include <fmt/format.h>

namespace hitpipe::rtl {

namespace {

std::string letters_of(const std::string& text, int address_bits) {
  std::string cases;
  for (std::size_t i = 0; i < text.size(); ++i)
    cases += fmt::format("      {}'d{}: letter = 8'h{:02x};{}\n", address_bits, i,
                         static_cast<unsigned char>(text[i]), i == 0 ? fmt::format("  // {}", text) : "");
  return cases;
}

/// A register of whole bytes without its lowest byte, `above` above the rest.
std::string shifted(const char* name, int bytes, const char* above) {
  return bytes == 1 ? std::string(above) : fmt::format("{{{}, {}[{}:8]}}", above, name, 8 * bytes - 1);
}

constexpr int overhead = 4;  // kind, tag, two of the check sequence

constexpr const char* receiving = R"(
  // A frame: bytes between two flags, escaped, with a check sequence at the end (RFC 1662).
  wire byte_valid;
  wire [7:0] byte_in;
  reg escaped;
  reg [15:0] check_in;
  reg [{1}:0] count;  // bytes of the frame; it stops at one too many
{3}  reg [7:0] tag;
  reg [{2}:0] operands;
  {0}_rx #(.CLOCKS_PER_BIT(CLOCKS_PER_BIT)) receiver (
    .clk(clk), .rst(rst), .line(rx), .valid(byte_valid), .data(byte_in)
  );
  wire flag = byte_in == 8'h7e;
  wire [7:0] plain = escaped ? byte_in ^ 8'h20 : byte_in;
  wire sound = byte_valid & flag & ~escaped & (check_in == 16'hf0b8);
{4}{10}  always @(posedge clk) begin
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
        {12}if (count != {6}) count <= count + {7};
        if (count == {5}) begin
{11}        end else if (count == {7}) tag <= plain;
        else if (count < {8}) operands <= {9};
      end
    end
  end
)";

constexpr const char* answering = R"(
  // The answer: a flag, the kind, the tag, the body, the check sequence, a flag.
  reg about_who;
{11}  reg [7:0] answer_tag;
  reg [{0}:0] answer;
  reg [{1}:0] place;
  reg [15:0] check_out;
  reg after_escape;
  wire ready;
  wire [{1}:0] body_end = {2};
  wire at_flag = place == {4} | place == body_end + {5};
  reg [7:0] chosen;
  always @(*) begin
    if (at_flag) chosen = 8'h7e;
    else if (place == {6}) chosen = {3};
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
{10}    end else if (sending & ready) begin
      after_escape <= must_escape;
      if (~must_escape) begin
        place <= place + {6};
        if (~at_flag & place < body_end) check_out <= check_of(check_out, chosen);
        if (~at_flag & place >= {8} & place < body_end) answer <= {12};
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

}  // namespace

int bits_for(int most) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(most)));
}

std::string decimal(int bits, int number) {
  return fmt::format("{}'d{}", bits, number);
}

std::vector<std::string> fields_of_word(const std::vector<Port>& ports, std::string_view word, int low) {
  std::vector<std::string> all;
  for (const Port& port : ports) {
    all.push_back(fmt::format("{}[{}:{}]", word, low + port.width - 1, low));
    low += port.width;
  }
  return all;
}

int place_bits_of(int most_body_bytes) {
  return bits_for(3 + most_body_bytes + 3);
}

std::string top_opening(const std::string& module, int clocks_per_bit, const std::string& identity,
                        int place_bits) {
  return fmt::format(
      R"(module {0} #(
  parameter [15:0] CLOCKS_PER_BIT = 16'd{1}
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
  function [7:0] letter(input [{2}:0] number);
    case (number)
{3}      default: letter = 8'd0;
    endcase
  endfunction

)",
      module, clocks_per_bit, place_bits - 1, letters_of(identity, place_bits));
}

int count_bits_of(const ReceiverText& receiver) {
  return bits_for(receiver.body_bytes + overhead + 1);
}

std::string receiver_text(const ReceiverText& receiver) {
  const int count_bits = count_bits_of(receiver);
  const int whole = receiver.body_bytes + overhead;
  const auto number = [&](int n) { return decimal(count_bits, n); };
  std::string registers, sound, chosen;
  for (const FrameKind& kind : receiver.kinds) {
    registers += fmt::format("  reg is_{};\n", kind.name);
    sound += fmt::format("  wire {0} = sound & is_{0} & (count == {1});\n", kind.name,
                         number(kind.body_bytes + overhead));
    chosen += fmt::format("          is_{} <= plain == \"{}\";\n", kind.name, kind.letter);
  }
  const std::string holding = receiver.held.empty() ? ""
                                                    : fmt::format("if ({}) count <= {};\n        else ",
                                                                  receiver.held, number(whole + 1));
  return fmt::format(receiving, receiver.serial, count_bits - 1, 8 * receiver.body_bytes - 1, registers,
                     sound, number(0), number(whole + 1), number(1),
                     receiver.body_end.empty() ? number(receiver.body_bytes + 2) : receiver.body_end,
                     shifted("operands", receiver.body_bytes, "plain"), receiver.taking, chosen, holding);
}

std::string sender_text(const SenderText& sender) {
  const auto at = [&](int n) { return decimal(sender.place_bits, n); };
  return fmt::format(answering, 8 * sender.answer_bytes - 1, sender.place_bits - 1, sender.body_end,
                     sender.kind, at(0), at(2), at(1), at(2), at(3), sender.serial, sender.beginning,
                     sender.registers, shifted("answer", sender.answer_bytes, "8'd0"));
}

std::string lamps_text(const std::string& not_taken) {
  return fmt::format(R"(  reg answered;
  reg damaged;
  always @(posedge clk) begin
    if (rst) begin
      answered <= 1'b0;
      damaged <= 1'b0;
    end else begin
      if (sending) answered <= 1'b1;
      if ({}) damaged <= 1'b1;
    end
  end
  assign led_green_n = ~answered;
  assign led_red_n = ~damaged;
)",
                     not_taken);
}

}  // namespace hitpipe::rtl
