// `hitpipe implement`: what it prints, what it says when tools are missing, and when a unit does not fit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::implement_command_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ImplementCommand : public testing::Test {
 protected:
  /// int_slabs 6/6.
  [[nodiscard]] Outcome run(const std::vector<std::string>& more, const Variables& variables = {}) const {
    return run_hitpipe(with({"implement", "int_slabs", "--bits", "6/6", "--out", out_.string()}, more),
                       variables);
  }

  /// A chip whose cells are those of Yosys, so that nothing is mapped.
  [[nodiscard]] std::filesystem::path quick_target() const {
    return folder_.write("quick.json", R"({
      "name": "quick", "chip": "Quick", "library": "ice40_hx",
      "synthesis": ["prep -flatten -top {top}", "chtype -set REGISTER t:$*dff*", "chtype -set OTHER t:$*"],
      "resources": {"luts": {"cells": {"OTHER": 1}}, "registers": {"cells": {"REGISTER": 1}}},
      "not_placed": "it is no chip"})");
  }

  sim::TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(ImplementCommand, StopsAtCountsWhereNothingPlacesAndSaysSo) {
  const Outcome outcome = run({"--target", "xc7"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              StartsWith("design          int_slabs\nbits            6/6\ntarget          xc7\n"));
  EXPECT_THAT(outcome.out,
              HasSubstr("\nnot_placed      Debian 12 has no place and route for 7-series chips\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nluts  "));
  EXPECT_THAT(outcome.out, Not(HasSubstr("fmax")));
}

/// A placer that no package brings may be missing, but not if the user names it.
TEST_F(ImplementCommand, PlacerThatDebianDoesNotHaveMayBeMissing) {
  const std::filesystem::path file = folder_.write("far.json", R"({
    "name": "far", "chip": "Far", "library": "ecp5", "synthesis": ["synth_ecp5 -top {top}"],
    "resources": {"luts": {"cells": {"LUT4": 1}}, "logic_cells": {"packed": "CELLS"}},
    "place": {"program": "nextpnr-nowhere", "options": []}, "not_placed": "nobody has nextpnr-nowhere"})");
  const Outcome outcome = run({"--target", file.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nnot_placed      nobody has nextpnr-nowhere\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("logic_cells")));
  const Outcome named = run({"--target", file.string()}, {{"NEXTPNR_NOWHERE", "/nowhere/tool"}});
  EXPECT_EQ(named.exit_code, 2);
  EXPECT_EQ(named.err, "hitpipe: /nowhere/tool: cannot be run; set NEXTPNR_NOWHERE to the program\n");
}

/// A stand-in answers as nextpnr-ecp5 does: its arguments, and what is read of its log and report.
TEST_F(ImplementCommand, PlacesOnEcp5) {
  const std::filesystem::path placer = folder_.write_program("placer", R"(#!/bin/sh
case "$*" in *--version*) echo 'nextpnr-ecp5 stand-in' >&2; exit 0;; esac
echo "arguments: $*"
printf 'Info: Device utilisation:\nInfo: \t        TRELLIS_COMB:   321/24288     1%%\n'
while [ $# -gt 0 ]; do
  if [ "$1" = --seed ]; then seed=$2; fi
  if [ "$1" = --report ]; then report=$2; fi
  shift
done
[ -z "$report" ] || cat > "$report" <<END
{"critical_paths": [{"from": "posedge \$glbnet\$clk", "to": "posedge \$glbnet\$clk", "path": [
  {"delay": 0.5, "type": "clk-to-q", "from": {"cell": "a", "port": "CLK"}, "to": {"cell": "a", "port": "Q"}},
  {"delay": 1.5, "type": "routing", "from": {"cell": "a", "port": "Q"}, "to": {"cell": "b", "port": "D"}}]}],
 "fmax": {"\$glbnet\$clk": {"achieved": 12$seed.5}, "\$glbnet\$shift_clk": {"achieved": 300}}}
END
)");
  const Outcome outcome =
      run({"--target", "ecp5", "--seeds", "3", "--format", "json"}, {{"NEXTPNR_ECP5", placer.string()}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["logic_cells"], 321);
  EXPECT_EQ(object["fmax_mhz"], 122.5);
  EXPECT_EQ(object["fmax_best_mhz"], 123.5);
  EXPECT_EQ(object["critical_from"], "a");
  EXPECT_EQ(object["critical_to"], "b");
  EXPECT_TRUE(object["not_placed"].is_null());
  EXPECT_THAT(object["tools"].get<std::string>(), HasSubstr("nextpnr-ecp5 stand-in"));
  EXPECT_THAT(contents_of(out_ / "ecp5" / "int_slabs_6_6_pack.log"),
              StartsWith("arguments: --25k --package CABGA381 --speed 6 --lpf-allow-unconstrained --json "
                         "int_slabs_6_6_netlist.json --top int_slabs_6_6 --pack-only\n"));
  EXPECT_THAT(contents_of(out_ / "ecp5" / "int_slabs_6_6_harness_place_3.log"),
              StartsWith("arguments: --25k --package CABGA381 --speed 6 --lpf-allow-unconstrained --json "
                         "int_slabs_6_6_harness.json --top int_slabs_6_6_harness --seed 3 --report "));
}

/// With nextpnr-ecp5 itself, which is no package of Debian 12.
TEST_F(ImplementCommand, PlacesOnEcp5WithNextpnr) {
  const Outcome outcome = run({"--target", "ecp5", "--seeds", "1", "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  if (!object["not_placed"].is_null()) GTEST_SKIP() << object["not_placed"].get<std::string>();
  EXPECT_GE(object["logic_cells"], object["luts"]);
  EXPECT_GT(object["fmax_mhz"], 50);
  EXPECT_LT(object["fmax_mhz"], 500);
  EXPECT_NE(object["critical_from"], object["critical_to"]);
}

/// A further chip is a file of one's own, and nothing else.
TEST_F(ImplementCommand, PlacesOnTheChipOfAFile) {
  const Outcome outcome =
      run({"--target", HITPIPE_SOURCE "/examples/own_chip/grid.json", "--seeds", "1", "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["target"], "grid");
  EXPECT_GE(object["logic_cells"], object["luts"]);
  EXPECT_LE(object["logic_cells"], 2048);
  EXPECT_GT(object["fmax_mhz"], 10);
  EXPECT_LT(object["fmax_mhz"], 1000 / 0.9) << "a register and its setup take 0.9 ns";
  EXPECT_THAT(object["critical_from"].get<std::string>(), HasSubstr("unit."));
}

TEST_F(ImplementCommand, PrintsTheSameAsJsonAndKeepsIt) {
  const Outcome outcome = run(
      {"--target", "ice40_hx", "--seeds", "0", "--simulate", "50", "--name", "box_test", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object["module"], "box_test");
  EXPECT_EQ(object["flow_control"], "none");
  EXPECT_EQ(object["netlist"], "PASS 50 vectors");
  EXPECT_TRUE(object["energy_pj_per_box"].is_null()) << "of standard cells alone";
  EXPECT_TRUE(object["fmax_mhz"].is_null());
  EXPECT_GT(object["luts"], 100);
  EXPECT_GE(object["logic_cells"], object["luts"]);
  object.erase("files");
  EXPECT_EQ(nlohmann::json::parse(contents_of(out_ / "ice40_hx" / "box_test_implementation.json")), object);
  EXPECT_THAT(contents_of(out_ / "ice40_hx" / "box_test_netlist.v"), HasSubstr("SB_LUT4"));
  EXPECT_THAT(contents_of(out_ / "ice40_hx" / "box_test.v"), HasSubstr("module box_test"));
}

TEST_F(ImplementCommand, AnIntervalDividesTheBoxesASecond) {
  for (const int interval : {1, 3}) {
    const Outcome outcome =
        run({"--target", "osu018", "--ii", std::to_string(interval), "--simulate", "50", "--format", "json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto object = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(object["netlist"], "PASS 50 vectors");
    EXPECT_EQ(object.contains("ii"), interval == 3);
    // A test takes the energy of its cycles, gaps included.
    EXPECT_GT(object["energy_pj_per_box"], 10);
    EXPECT_LT(object["energy_pj_per_box"], 1000);
    EXPECT_NEAR(
        object["energy_estimate_pj_per_box"].get<double>() / object["energy_pj_per_box"].get<double>(), 1.0,
        0.3);
    EXPECT_GE(object["cycles_per_test"], interval);
    EXPECT_THAT(contents_of(out_ / "osu018" / "int_slabs_6_6_power.log"), Not(HasSubstr("no activity")));
    EXPECT_NEAR(object["million_hits_per_s"].get<double>() * interval, object["fmax_mhz"].get<double>(),
                0.02);
  }
}

/// Fewer stages take fewer registers, though not at each step: a cut may fall where values are wider. The
/// files of each schedule stay.
TEST_F(ImplementCommand, TriesSeveralClocksAndTakesTheBest) {
  const std::string target = quick_target().string();
  const Outcome text = run({"--target", target, "--clock-ps", "auto"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_LE(widest_line(text.out.substr(0, text.out.find("\n\n"))), 80U) << text.out;
  EXPECT_THAT(lines_of(text.out).at(0), testing::ContainsRegex("^clock_ps  latency  luts .* fmax_mhz$"));
  const Outcome outcome = run({"--target", target, "--clock-ps", "auto", "--format", "json"});
  const auto object = nlohmann::json::parse(outcome.out);
  const auto& tried = object.at("tried");
  ASSERT_GT(tried.size(), 2U);
  for (std::size_t i = 1; i < tried.size(); ++i) {
    EXPECT_GT(tried[i].at("clock_ps"), tried[i - 1].at("clock_ps"));
    EXPECT_LT(tried[i].at("latency"), tried[i - 1].at("latency"));
  }
  EXPECT_LT(tried.back().at("registers"), tried.front().at("registers"));
  // Without a placement the fewest cells decide.
  const int cells = object.at("cells");
  for (const auto& row : tried) EXPECT_LE(cells, row.at("cells").get<int>());
  EXPECT_TRUE(std::filesystem::exists(out_ / fmt::format("{}ps", object.at("clock_ps").get<int>()) / "quick" /
                                      "int_slabs_6_6.v"));
  const Outcome on_board = run_hitpipe(
      {"implement", "--board", "icebreaker", "--clock-ps", "auto", "--out", (folder_.path() / "b").string()});
  EXPECT_EQ(on_board.exit_code, 2);
  EXPECT_EQ(
      on_board.err,
      "hitpipe: --clock-ps auto: icebreaker has a clock of its own; leave the option out or give a number\n");
}

TEST_F(ImplementCommand, UnitThatDoesNotFitIsAResult) {
  // The chip has no more than what the test needs.
  const std::filesystem::path file = folder_.write("tiny.json", R"({
    "name": "tiny", "chip": "Tiny", "library": "thesis_250nm", "synthesis": ["synth_ice40 -top {top}"],
    "resources": {"luts": {"cells": {"SB_LUT4": 1}, "available": 10},
                  "rams": {"cells": {"SB_RAM40_4K*": 1}, "available": 0}},
    "not_placed": "it is too small"})");
  const Outcome outcome = run({"--target", file.string(), "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto luts = nlohmann::json::parse(outcome.out)["luts"].get<int>();
  EXPECT_EQ(outcome.err,
            "hitpipe: int_slabs 6/6 does not fit Tiny: " + std::to_string(luts) +
                " of 10 luts; none of the options tried (a longer --clock-ps, --ii up to 6, fewer --bits) "
                "fits\n");
}

/// A chip without a spare multiplier: six products need one each, and with --ii 3 two are enough.
TEST_F(ImplementCommand, UnitThatDoesNotFitIsToldAnOptionThatDoes) {
  const std::filesystem::path file = folder_.write("two.json", R"({
    "name": "two", "chip": "Two", "library": "ice40_up5k",
    "synthesis": ["synth_ice40 -device u -dsp -top {top}"],
    "resources": {"dsps": {"cells": {"SB_MAC16": 1}, "available": 2}},
    "not_placed": "it is too small"})");
  const std::vector<std::string> words{"implement", "int_slabs",   "--bits", "8/8",
                                       "--target",  file.string(), "--out",  out_.string()};
  const Outcome outcome = run_hitpipe(words);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err,
            "hitpipe: int_slabs 8/8 does not fit Two: 6 of 2 dsps; with --ii 3 it takes 2 of 2 dsps\n");
  const Outcome told = run_hitpipe(with(words, {"--ii", "3"}));
  EXPECT_EQ(told.exit_code, 0) << told.err;
}

/// No cells are chosen, so that it is quick.
TEST_F(ImplementCommand, CoreIsMappedAloneAndBehindAxi) {
  const std::filesystem::path file = folder_.write("words.json", R"({
    "name": "words", "chip": "Words", "library": "xc7",
    "synthesis": ["prep -flatten -top {top}", "chtype -set MEMORY t:$mem_v2", "chtype -set OTHER t:$*"],
    "resources": {"luts": {"cells": {"OTHER": 1}, "available": 10}, "rams": {"cells": {"MEMORY": 1}}},
    "not_placed": "it is too small"})");
  const std::vector<std::string> words{"core",     "implement",   "--bits", "8+0/4s8",    "--rays",      "4",
                                       "--stack",  "2",           "--name", "tracer",     "--data-bits", "64",
                                       "--target", file.string(), "--out",  out_.string()};
  const Outcome outcome = run_hitpipe(with(words, {"--format", "json"}));
  EXPECT_EQ(outcome.exit_code, 1);
  auto objects = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(objects.size(), 2);
  std::string faults;
  for (std::size_t i = 0; i < 2; ++i) {
    auto& object = objects[i];
    const std::string module = i == 0 ? "tracer" : "tracer_axi";
    EXPECT_EQ(object["core"], "tracer");
    EXPECT_EQ(object["module"], module);
    EXPECT_EQ(object["rays"], 4);
    EXPECT_EQ(object["library"], "xc7");
    EXPECT_GT(object["rams"], 20);
    EXPECT_GT(object["memory_bits"], object["rams"]);
    EXPECT_EQ(object["cells"], object["luts"].get<int>() + object["rams"].get<int>());
    faults += fmt::format("hitpipe: {} 8+0/4s8 does not fit Words: {} of 10 luts\n", module,
                          object["luts"].get<int>());
    object.erase("files");
    EXPECT_EQ(nlohmann::json::parse(contents_of(out_ / "words" / (module + "_implementation.json"))), object);
    EXPECT_THAT(contents_of(out_ / "words" / (module + ".v")), HasSubstr("module " + module + " ("));
  }
  EXPECT_EQ(outcome.err, faults);
  // The registers of the bus and, of a bus of 64 bits, what waits for its beats.
  EXPECT_GT(objects[1]["luts"], objects[0]["luts"]);
  EXPECT_GT(objects[1]["memory_bits"], objects[0]["memory_bits"]);

  const Outcome text = run_hitpipe(words);
  EXPECT_THAT(text.out, StartsWith("core        tracer\nbits        8+0/4s8\n"));
  EXPECT_THAT(text.out, HasSubstr("\n\n                  tracer  tracer_axi\ncells "));
  EXPECT_THAT(text.out, Not(HasSubstr("fmax")));
}

TEST_F(ImplementCommand, MissingToolNamesItsPackage) {
  const auto missing = [&](const std::string& target, const std::string& variable,
                           const std::vector<std::string>& more = {}) {
    const Outcome outcome = run(with({"--target", target}, more), {{variable, "/nowhere/tool"}});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(out_));
    return outcome.err;
  };
  const auto line = [](const std::string& package, const std::string& variable) {
    return "hitpipe: /nowhere/tool: cannot be run; install the package " + package + " or set " + variable +
           " to the program\n";
  };
  EXPECT_EQ(missing("xc7", "YOSYS"), line("yosys", "YOSYS"));
  EXPECT_EQ(missing("ice40_up5k", "NEXTPNR_ICE40"), line("nextpnr-ice40", "NEXTPNR_ICE40"));
  EXPECT_EQ(missing("osu018", "STA"), line("opensta", "STA"));
  EXPECT_EQ(missing("ice40_hx", "IVERILOG", {"--simulate", "9"}), line("iverilog", "IVERILOG"));
  EXPECT_EQ(missing("ice40_hx", "VERILATOR", {"--simulate", "9", "--simulator", "verilator"}),
            line("verilator", "VERILATOR"));
}

TEST_F(ImplementCommand, MissingCellsNameTheirPackage) {
  const std::filesystem::path file = folder_.write("cells.json", R"({
    "name": "cells", "chip": "Cells", "library": "thesis_250nm", "synthesis": [], "resources": {},
    "liberty": "/nowhere/cells.lib", "package": "some-cells", "not_placed": "no"})");
  const Outcome outcome = run({"--target", file.string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "hitpipe: /nowhere/cells.lib: is not there; install the package some-cells\n");
}

TEST_F(ImplementCommand, FailingToolNamesItsLog) {
  const std::filesystem::path yosys = folder_.write_program(
      "yosys", "#!/bin/sh\nif [ \"$1\" = -V ]; then echo Yosys 0; else echo broken; exit 3; fi\n");
  const Outcome outcome = run({"--target", "xc7"}, {{"YOSYS", yosys.string()}});
  EXPECT_EQ(outcome.exit_code, 2);
  const std::filesystem::path log = out_ / "xc7" / "int_slabs_6_6_synthesis.log";
  EXPECT_EQ(outcome.err, "hitpipe: " + yosys.string() + ": failed with exit code 3; its output is in " +
                             log.string() + "\n");
  EXPECT_EQ(contents_of(log), "broken\n");
}

TEST(ImplementBoard, EndsInABitstream) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const auto json = nlohmann::json::parse(
      printed("implement int_slabs --bits 6/6 --board icebreaker --seeds 1 --format json --out " + out));
  EXPECT_EQ(json["module"], "int_slabs_6_6_board");
  EXPECT_GT(json["luts"], 100);
  EXPECT_GT(json["fmax_mhz"], 12);
  EXPECT_EQ(json["clock_mhz"], 12);
  // All bitstreams of this chip are of one size; they begin with the preamble.
  const std::string bitstream = contents_of(json["bitstream"].get<std::string>());
  EXPECT_EQ(bitstream.size(), 104'090U);
  EXPECT_EQ(json["bitstream_bytes"], bitstream.size());
  EXPECT_THAT(bitstream, HasSubstr("\x7e\xaa\x99\x7e"));
  EXPECT_THAT(contents_of(out + "/ice40_up5k/int_slabs_6_6_board.pcf"), HasSubstr("set_io tx 9\n"));
  EXPECT_THAT(contents_of(out + "/ice40_up5k/int_slabs_6_6_board.v"), HasSubstr("CLOCKS_PER_BIT = 16'd12"));
}

}  // namespace
}  // namespace hitpipe::cli::implement_command_test
