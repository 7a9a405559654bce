#include "rtl_gen/board/top.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "host/text.hpp"
#include "rtl_gen/board/frame_text.hpp"
#include "rtl_gen/board/serial_line.hpp"
#include "rtl_gen/emit/vectors.hpp"

namespace hitpipe::rtl {

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

/// An answer begins. {0}: the results, and zeros above.
constexpr const char* beginning = R"(    if (rst) begin
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
        answer <= {0};
      end
    end else if (asked) begin
      sending <= 1'b1;
      about_who <= 1'b1;
      answer_tag <= tag;
)";

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
  const int place_bits = place_bits_of(std::max(text_bytes, result_bytes));
  const auto at = [&](int n) { return decimal(place_bits, n); };

  const ReceiverText receiver{
      .serial = serial,
      .kinds = {{"test", 'T', operand_bytes}, {"who", 'I', 0}},
      .body_bytes = operand_bytes,
      .taking = std::string(board.interval == 1 ? taking : taking_later) + "  wire asked = who & free;\n"};
  const std::string padding =
      8 * result_bytes > result_bits ? fmt::format("{}'d0, ", 8 * result_bytes - result_bits) : "";
  const SenderText sender{
      .serial = serial,
      .place_bits = place_bits,
      .answer_bytes = result_bytes,
      .body_end = fmt::format("about_who ? {} : {}", at(3 + text_bytes), at(3 + result_bytes)),
      .kind = R"(about_who ? "I" : "T")",
      .beginning = fmt::format(beginning, fmt::format("{{{}results}}", padding))};

  std::vector<std::string> data = fields_of_word(operands, "operands");
  for (std::string& each : fields_of_word(results, "results")) data.push_back(std::move(each));
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
)",
             unit.module) +
         top_opening(board_module(unit.module), clocks_per_bit, board.identity, place_bits) +
         fmt::format(R"(  reg waiting;  // for the unit
  reg sending;  // an answer
  wire in_ready;
  wire out_valid;
  wire [7:0] out_tag;
  wire [{}:0] results;
)",
                     result_bits - 1) +
         receiver_text(receiver) + sender_text(sender) + "\n" + instance + "\n" +
         lamps_text(fmt::format("byte_valid & flag & (count != {}) & ~{} & ~asked",
                                decimal(count_bits_of(receiver), 0),
                                board.interval == 1 ? "taken" : "(test & free)")) +
         unused + "endmodule\n" + serial_line(serial);
}

}  // namespace hitpipe::rtl
