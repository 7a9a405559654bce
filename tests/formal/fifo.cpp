#include "tests/formal/fifo.hpp"

#include <bit>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/emit/result_fifo.hpp"

namespace hitpipe::formal {

namespace {

constexpr int tag_bits = 16;

void insert_behind(std::string& text, const std::string& place, const std::string& more) {
  text.insert(text.find(place) + place.size(), more);
}

}  // namespace

std::string fifo_proof(const std::string& unit, const std::vector<rtl::Port>& operands, int latency,
                       int interval) {
  const int test_bits = tag_bits + 1;
  std::string inputs;
  std::vector<std::string> names;
  for (const rtl::Port& port : operands) {
    inputs += fmt::format("  input wire {}{},\n", rtl::vector_range(port.width), port.name);
    names.push_back(port.name);
  }
  const std::string word = fmt::format("{{{}}}", fmt::join(names, ", "));
  const int places = rtl::fifo_places(latency, interval);
  const bool waits = interval > 1;
  const std::string stand_in = fmt::format(
      R"(module {unit} #(
  parameter TAG_BITS = 16
) (
{inputs}  input wire clk, rst, in_valid,
{ready_port}  input wire [TAG_BITS-1:0] in_tag,
  output wire out_valid,
  output wire [TAG_BITS-1:0] out_tag,
  output wire seen,
{phase_port}  output reg [{last}:0] is_test,
  output reg [{all_high}:0] tests
);
{ready}  wire asked = {word} >> in_tag;
  always @(posedge clk) begin
    if (rst) is_test <= 0;
    else is_test <= {{is_test, in_valid}};
    tests <= {{tests, in_tag, asked}};
  end
  assign out_valid = is_test[{last}];
  assign {{out_tag, seen}} = tests >> {last} * (TAG_BITS + 1);
endmodule
)",
      fmt::arg("unit", unit), fmt::arg("last", latency), fmt::arg("all_high", test_bits * (latency + 1) - 1),
      fmt::arg("inputs", inputs), fmt::arg("word", word),
      fmt::arg("ready_port", waits ? "  output wire in_ready,\n" : ""),
      fmt::arg("phase_port", waits ? "  output reg [7:0] phase,\n" : ""),
      fmt::arg("ready", waits ? fmt::format("  assign in_ready = phase == 0;\n  always @(posedge clk)\n"
                                            "    phase <= rst | (phase == {}) ? 8'd0 : phase + 8'd1;\n",
                                            interval - 1)
                              : ""));

  std::string held;
  for (int bit = 0; bit < test_bits; ++bit)
    held += fmt::format("        assert (\\line[{0}].held [place] == test[{0}]);\n", bit);
  const std::string properties = fmt::format(
      R"(
  wire asked = {word} >> in_tag;
  wire [{test_high}:0] offered = {{in_tag, asked}};
  // was_ready: out_ready was high at an edge since the one at which the unit was ready last.
  // One test, whichever it is: how many edges ago it was taken, and how many tests are before it.
  (* anyseq *) reg choose;
  reg started = 0, follows = 0, was_ready = 0, was_held = 0, always_ready = 0;
  reg [{test_high}:0] test, was_shown;
  reg [7:0] age, ahead;
  always @(posedge clk) begin
    was_ready <= ({was_ready}) & ~rst;
    was_held <= out_valid & ~out_ready & ~rst;
    was_shown <= shown;
    always_ready <= out_ready & (rst | always_ready);
    if (rst) begin
      started <= 1;
      follows <= 0;
    end else if (follows) begin
      if (age <= {last}) age <= age + 1;
      if (given) ahead <= ahead - 1;
      if (given & (ahead == 0)) follows <= 0;
    end else if (choose & taken) begin
      follows <= 1;
      test <= offered;
      age <= 0;
      ahead <= used - given;
    end
  end
  wire [7:0] waiting = {{{{8{{oldest[{place_bits}]}}}}, oldest}} + 8'd1;
  wire [7:0] place = oldest - ahead;
  // How many tests are at each boundary and before it. A solver is slow to count them anew in every step.
  reg [8*{last}+7:0] up_to;
  wire [7:0] flying = up_to[8*{last} +: 8];
  integer k;
  always @(posedge clk) begin
    up_to[7:0] <= taken & ~rst;
    for (k = 1; k <= {last}; k = k + 1) up_to[8*k +: 8] <= rst ? 8'd0 : up_to[8*k-8 +: 8] + taken;
  end
  always @* begin
    if (started) begin
      assert (up_to[7:0] == is_test[0]);
      for (k = 1; k <= {last}; k = k + 1) assert (up_to[8*k +: 8] == up_to[8*k-8 +: 8] + is_test[k]);
      assert (used <= {places});
      assert (waiting <= {places});
      assert (used == flying + waiting);
      if (arrives & ~given) assert (waiting < {places});
{in_phase}      if (was_ready) assert (used < {places});
      if (was_ready{and_unit_ready}) assert (in_ready);
      if (was_held) assert (out_valid && shown == was_shown);
      if (always_ready) assert (~waits);
      if (out_valid) assert (used != 0);
      if (follows) begin
        assert (age <= {last} + 1);
        assert (ahead < used);
        for (k = 0; k <= {last}; k = k + 1) if (age == k) begin
          assert (is_test[k]);
          assert (test == tests[{test_bits}*k +: {test_bits}]);
          assert (ahead == flying - up_to[8*k +: 8] + waiting);
        end
        if (age > {last}) begin
          assert (ahead < waiting);
{held}        end
        if (ahead == 0 && age >= {last}) assert (out_valid);
        if (ahead == 0 && out_valid) assert (shown == test);
      end
      cover (follows & given & (ahead == 0) & (age > {last}) & shown[0]);
      cover (~in_ready & (waiting == {places}));
    end
  end
)",
      fmt::arg("last", latency), fmt::arg("test_high", test_bits - 1), fmt::arg("word", word),
      fmt::arg("place_bits", std::bit_width(static_cast<unsigned>(places - 1))), fmt::arg("places", places),
      fmt::arg("test_bits", test_bits), fmt::arg("held", held),
      fmt::arg("and_unit_ready", waits ? " & unit_ready" : ""),
      fmt::arg("was_ready", waits ? "out_ready | (was_ready & ~unit_ready)" : "out_ready"),
      fmt::arg("in_phase",
               waits ? fmt::format("      assert (phase < {0});\n      for (k = 0; k <= {1}; k = k + 1)\n"
                                   "        if (is_test[k]) assert (phase == (k + 1) % {0});\n",
                                   interval, latency)
                     : ""));
  std::string wrapper = rtl::result_fifo(
      rtl::unit_interface(unit, operands, {{"seen", 1, false}}, rtl::FlowControl::none, interval), latency);
  insert_behind(wrapper, fmt::format("  wire {} unit_tag;\n", rtl::tag_range),
                fmt::format("{}  wire [{}:0] is_test;\n  wire [{}:0] tests;\n",
                            waits ? "  wire [7:0] phase;\n" : "", latency, test_bits * (latency + 1) - 1));
  insert_behind(wrapper, "unit_i (\n",
                fmt::format("    {}.is_test(is_test), .tests(tests),\n", waits ? ".phase(phase), " : ""));
  wrapper.insert(wrapper.rfind("endmodule"), properties);
  return stand_in + wrapper;
}

}  // namespace hitpipe::formal
