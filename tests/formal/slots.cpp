#include "tests/formal/slots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::formal {

namespace {

constexpr int few_slots = 4;

struct Part {
  explicit Part(const std::vector<rtl::Port>& ports) {
    std::vector<std::string> names;
    for (const rtl::Port& port : ports) {
      names.push_back(port.name);
      bits += port.width;
      inputs += fmt::format("  input wire {}{},\n", rtl::vector_range(port.width), port.name);
    }
    word = fmt::format("{{{}}}", fmt::join(names, ", "));
  }
  int bits = 0;
  std::string inputs;
  std::string word;  ///< all of them, the first in the high bits
};

}  // namespace

std::string slots_proof(const std::string& unit, const std::vector<rtl::Port>& operands) {
  int bits = 0;
  for (const rtl::Port& port : operands) bits += port.width;
  const rtl::RaySlots slots =
      rtl::ray_slots(rtl::unit_interface(unit, operands, {{"seen", bits, false}}, rtl::FlowControl::stall),
                     operands, few_slots);
  const Part line(slots.line);
  const Part end(slots.end);
  const Part test(slots.test);
  const bool ends = end.bits > 0;
  const std::string all = ends ? fmt::format("{}, {}, {}", line.word, end.word, test.word)
                               : fmt::format("{}, {}", line.word, test.word);
  const std::string stand_in =
      fmt::format(R"(module {} #(
  parameter TAG_BITS = 16
) (
{}{}{}  input wire clk, rst, in_valid, out_ready,
  input wire [TAG_BITS-1:0] in_tag,
  output wire in_ready, out_valid,
  output wire [TAG_BITS-1:0] out_tag,
  output wire {}seen
);
  assign in_ready = out_ready;
  assign out_valid = in_valid;
  assign out_tag = in_tag;
  assign seen = {{{}}};
endmodule
)",
                  unit, line.inputs, end.inputs, test.inputs, rtl::vector_range(bits), all);
  const std::string ray = rtl::vector_range(line.bits + end.bits);
  // The ray that was last written to a slot, whichever it is, and the test that was last taken.
  const std::string properties = fmt::format(
      R"(
  (* anyconst *) reg [1:0] some_slot;
  reg known = 0;
  reg {0}ray;
  wire to_it = ray_valid & ray_ready & (ray_slot == some_slot);
  always @(posedge clk) begin
    if (to_it & {1}) begin ray <= {2}; known <= 1; end
{3}  end
  wire taken = in_valid & in_ready;
  wire given = out_valid & out_ready;
  reg started = 0, waits = 0, of_it, expects;
  reg {0}expected_ray;
  reg {4}expected_test;
  reg [TAG_BITS-1:0] expected_tag;
  always @(posedge clk) begin
    if (rst) started <= 1;
    if (rst) waits <= 0;
    else if (taken) waits <= 1;
    else if (given) waits <= 0;
    if (taken) begin
      expects <= known & (in_slot == some_slot);
      expected_ray <= ray;
      expected_test <= {5};
      expected_tag <= in_tag;
    end
  end
  always @* begin
    if (known) assert({6} == ray);
    if (in_valid & in_ready) assert(~(ray_valid & ray_ready & (ray_slot == in_slot)));
    assert(ray_ready);
    if (started) begin
      assert(out_valid == waits);
      if (taken) assert(given | ~waits);
      if (in_valid & (given | ~waits) & ~(ray_valid & (ray_slot == in_slot))) assert(in_ready);
      if (waits) assert(out_tag == expected_tag);
      if (waits) assert(seen[{7}:0] == expected_test);
      if (waits & expects) assert(seen[{8}:{9}] == expected_ray);
      cover(waits & expects & ~out_ready & (seen[{8}:{9}] != ray));
    end
  end
)",
      ray, ends ? "~ray_end_only" : "1'b1", ends ? fmt::format("{{{}, {}}}", line.word, end.word) : line.word,
      ends ? fmt::format("    if (to_it & ray_end_only) ray[{}:0] <= {};\n", end.bits - 1, end.word) : "",
      rtl::vector_range(test.bits), test.word,
      ends ? "{line_memory[some_slot], end_memory[some_slot]}" : "line_memory[some_slot]", test.bits - 1,
      bits - 1, test.bits);
  std::string wrapper = rtl::to_verilog(slots);
  wrapper.insert(wrapper.rfind("endmodule"), properties);
  return stand_in + wrapper;
}

}  // namespace hitpipe::formal
