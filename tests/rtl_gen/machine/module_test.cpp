// The Verilog of a machine: its text, what the tools say of it, its memories on chips, and its longest path.
#include "rtl_gen/machine/module.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hls/machines/divider.hpp"
#include "tests/rtl_gen/machine/small_queue.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::machine_module_test {
namespace {

using testing::HasSubstr;

TEST(MachineModule, HasThisText) {
  const std::string text = to_verilog(small_queue().graph(small_queue_bits), {.module = "small_queue"});
  EXPECT_EQ(text.substr(text.find("module ")), R"(module small_queue (
  input  wire clk,
  input  wire rst,
  input  wire push,
  input  wire pop,
  input  wire [2:0] ray,
  output wire some,
  output wire [2:0] first
);

  // State.
  reg [3:0] used;  // 0 after a reset
  reg [2:0] oldest;  // 1 after a reset

  // Memories.
  reg [2:0] rays [0:7];
  wire [2:0] rays_word;

  // What a cycle computes.
  wire [2:0] place = oldest + used[2:0];  // machine/small_queue.hpp:40
  wire [3:0] next_used_value_add = used + {3'd0, push};
  wire taken_eq = used == 4'h0;  // for machine/small_queue.hpp:42
  wire taken = ~taken_eq & pop;  // machine/small_queue.hpp:42
  wire [3:0] next_used_value = next_used_value_add - {3'd0, taken};
  wire [2:0] next_oldest_value = oldest + {2'd0, taken};

  // Outputs.
  assign some = ~taken_eq;
  assign first = rays_word;

  // The next state.
  always @(posedge clk) begin
    if (rst) begin
      used <= 4'h0;
      oldest <= 3'h1;
    end else begin
      used <= next_used_value;
      oldest <= next_oldest_value;
    end
  end

  always @(posedge clk) begin
    if (push) rays[place] <= ray;
  end
  assign rays_word = rays[oldest];
endmodule
)");
}

TEST(MachineModule, ToolsFindNothingToSay) {
  const ScratchFolder folder;
  std::vector<std::vector<std::string>> units;
  const auto write = [&](const Machine& machine, const Format& format) {
    const std::string module = machine.module_at(format);
    write_text(folder.path() / (module + ".v"), to_verilog(machine.graph(format), {.module = module}));
    units.push_back({module});
  };
  for (const Machine& machine : machines()) write(machine, machine.default_format);
  write(small_queue(), small_queue_bits);
  write(*machine_called("divider"), hls::CoreBits{{24, 3, 8, 8, 0}, 8});
  expect_silent_tools(folder.path(), units);
}

/// The queue of the divider for 256 rays.
TEST(MachineModule, BlockMemoriesBecomeBlockRam) {
  const ScratchFolder folder;
  const Machine& machine = *machine_called("divider");
  const hls::CoreBits bits{{16, 1, 16, 0, 0}, 8};
  write_text(folder.path() / "divider.v", to_verilog(machine.graph(bits), {.module = "divider"}));
  const auto cells = [&](const std::string& synthesis) {
    const ToolResult made = run_tool(folder.path(), "yosys", "yosys",
                                     "-p 'read_verilog divider.v; " + synthesis + " -top divider; stat'");
    EXPECT_EQ(made.status, 0) << made.output;
    return made.output;
  };
  EXPECT_THAT(cells("synth_ice40"), HasSubstr("SB_RAM40_4K"));
  EXPECT_THAT(cells("synth_ecp5"), HasSubstr("DP16KD"));
  EXPECT_THAT(cells("synth_xilinx -family xc7"), HasSubstr("RAMB"));
}

TEST(LongestPath, LeadsFromRegisterToRegister) {
  const Library& library = Library::thesis();
  const MachineGraph machine = small_queue().graph(small_queue_bits);
  const MachinePath path = longest_path(machine, library);
  EXPECT_EQ(path.names.front(), "used");
  EXPECT_EQ(path.names.back(), "next_used");
  // Two adders of 4 bits behind a comparison with 0.
  const int adders = 2 * library.timing(Component::int_subtract, 4).delay_ps;
  EXPECT_GE(path.clock_ps, adders + library.latch_delay_ps());
}

TEST(LongestPath, OfTheDividerIsShorterThanAPipelinesClock) {
  const MachineGraph divider = machine_called("divider")->graph(hls::CoreBits{});
  EXPECT_LE(longest_path(divider, Library::thesis()).clock_ps, 3176);
  EXPECT_LE(longest_path(divider, library_called("osu018")).clock_ps, 3790);
}

}  // namespace
}  // namespace hitpipe::rtl::machine_module_test
