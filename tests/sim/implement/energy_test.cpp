// Toggles of nets from value changes, and that OpenSTA's power follows from them.
#include "sim/implement/energy.hpp"

#include <gtest/gtest.h>

#include "host/temporary.hpp"
#include "sim/implement/target.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::sim::energy_test {
namespace {

/// Ten units of time: the clock rises at 1, 3, 5, 7 and 9.
constexpr const char* waves = R"($timescale 1ns $end
$scope module tb $end
$scope module dut $end
$var wire 1 ! clk $end
$var wire 3 " word [2:0] $end
$var wire 1 # _1_ $end
$var wire 1 # \other.name  $end
$var wire 1 $ single [4] $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
$dumpvars
0!
bx "
x#
0$
$end
#1
1!
b101 "
1#
#2
0!
#3
1!
b10 "
#4
0!
#5
1!
0#
#6
0!
#7
1!
b110 "
1$
#8
0!
#9
1!
#10
)";

TEST(Activity, CountsTogglesOfEachBitACycle) {
  const Activity activity = read_activity(waves, "clk");
  EXPECT_EQ(activity.cycles, 5);
  const auto is = [&](const char* name, double toggles, double high) {
    EXPECT_DOUBLE_EQ(activity.nets.at(name).toggles, toggles) << name;
    EXPECT_DOUBLE_EQ(activity.nets.at(name).high, high) << name;
  };
  is("clk", 9.0 / 5, 0.5);
  is("word[2]", 3.0 / 5, 0.5);
  is("word[1]", 1.0 / 5, 0.7);
  is("word[0]", 2.0 / 5, 0.2);
  is("_1_", 2.0 / 5, 0.4);
  is("other.name", 2.0 / 5, 0.4);
  is("single[4]", 1.0 / 5, 0.3);
  EXPECT_EQ(activity.nets.size(), 7U);
}

TEST(Activity, WavesWithoutAClockRejected) {
  EXPECT_EQ(message_of([] { static_cast<void>(read_activity(waves, "clock")); }),
            "the waves have no clock clock");
  EXPECT_EQ(message_of([] { static_cast<void>(read_activity("", "clk")); }), "the waves have no clock clk");
}

/// Inverters between registers. Nothing but the clock moves, or all nets do in each cycle.
TEST(Energy, FollowsFromToggles) {
  const Target target = target_called("osu018");
  const ChipTools tools = find_chip_tools(target);
  const host::ScratchFolder folder;
  const Workbench bench(folder.path() / "kept");
  const Synthesis netlist{.top = "u", .cells = {}, .counts = {}, .area_um2 = {}};
  bench.put({netlist.verilog(), R"(module u(clk, a, q);
  input clk, a;
  output q;
  wire m, n, o;
  DFFPOSX1 first (.CLK(clk), .D(a), .Q(m));
  INVX1 second (.A(m), .Y(n));
  INVX1 third (.A(n), .Y(o));
  DFFPOSX1 fourth (.CLK(clk), .D(o), .Q(q));
endmodule
)"});
  const auto energy = [&](double toggles, std::int64_t tests) {
    Activity activity{.nets = {}, .cycles = 100};
    for (const char* const net : {"a", "m", "n", "o", "q"}) activity.nets[net] = {toggles, 0.5};
    return energy_of(target, netlist, activity, tests, "clk", *tools.sta, bench);
  };
  const Energy still = energy(0, 100);
  const Energy moving = energy(1, 100);
  EXPECT_GT(still.pj_per_test, 0) << "the clock";
  EXPECT_GT(moving.pj_per_test, 1.2 * still.pj_per_test);
  EXPECT_GT(still.sequential_pct, moving.sequential_pct);
  EXPECT_NEAR(energy(0.5, 100).pj_per_test, (still.pj_per_test + moving.pj_per_test) / 2,
              0.01 * moving.pj_per_test);
  EXPECT_NEAR(energy(1, 25).pj_per_test, 4 * moving.pj_per_test, 1e-6);
  EXPECT_EQ(energy(1, 25).cycles_per_test, 4);
  const Activity none{.nets = {}, .cycles = 1};
  EXPECT_EQ(
      message_of([&] { static_cast<void>(energy_of(target, netlist, none, 1, "clk", *tools.sta, bench)); }),
      "the simulation did not dump the net a");
}

}  // namespace
}  // namespace hitpipe::sim::energy_test
