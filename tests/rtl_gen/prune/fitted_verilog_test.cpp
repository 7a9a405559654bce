// A fitted unit's Verilog: taken by all tools without a word, with its check block and without, replayed with
// operands as demanded, and stopped by any that is not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/prune/all_ports.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::fitted_verilog_test {
namespace {

constexpr int vector_count = 500;

/// Of a design fitted to the last demand set, "all of these", with its check block.
class Fitted {
 public:
  Fitted(const DesignFormat& d, bool all_ports)
      : design(d.found()),
        format(d.parsed()),
        ports(design.ports(format)),
        demands(demand_sets(design, format).back().demands),
        graph(fitted_graph(all_ports)),
        left(input_ports(graph)) {}

  /// name.v, and in tb/ a testbench for so many vectors.
  void write(const ScratchFolder& folder, int vectors) const {
    const std::string name(design.name);
    const Pipeline pipeline = make_pipeline(graph, Library::thesis());
    const ModuleInterface unit =
        unit_interface(name, left, result_ports(design.results(format)), FlowControl::stall);
    const std::string verilog =
        to_verilog(pipeline, Library::thesis(), {.module_name = name, .bits = to_string(format)});
    write_text(folder / (name + ".v"), with_check_block(verilog, check_block(unit, demands, ports)));
    std::filesystem::create_directories(folder / "tb");
    write_text(folder / "tb" / (name + "_tb.sv"), testbench(unit, vectors, pipeline.latency()));
  }
  void write_vectors(const ScratchFolder& folder,
                     const std::vector<std::vector<std::int64_t>>& vectors) const {
    write_text(
        folder / "tb" / fmt::format("{}_vectors.hex", design.name),
        vector_file(ports, left, design.results(format), with_results(vectors, design.evaluate(format))));
  }
  [[nodiscard]] std::vector<std::vector<std::int64_t>> drawn(Seeded& random, int count) const {
    const Draw draw(ports, demands);
    std::vector<std::vector<std::int64_t>> vectors;
    for (int i = 0; i < count; ++i) vectors.push_back(draw(random));
    return vectors;
  }

  const Design& design;
  const Format format;
  const std::vector<Port> ports;
  const Demands demands;
  const Graph graph;  ///< with `all_ports`, behind the ports of the whole design
  const std::vector<Port> left;

 private:
  [[nodiscard]] Graph fitted_graph(bool all_ports) const {
    Graph fitted = prune(design.trace(format), demands, {.shares = false}).graph;
    return all_ports ? with_all_ports(fitted, ports) : fitted;
  }
};

void compile(const ScratchFolder& folder, const std::string& name) {
  expect_silence(folder / "tb", "iverilog",
                 "-g2012 -DHITPIPE_CHECK -o tb " + name + "_tb.sv ../" + name + ".v");
}

/// What the testbench prints. The exit code must agree.
std::string replayed(const ScratchFolder& folder) {
  const ToolResult result = run_tool(folder / "tb", "iverilog", "vvp", "-n tb");
  EXPECT_EQ(result.status == 0, result.output.find("PASS") != std::string::npos) << result.output;
  return result.output;
}

class FittedVerilog : public testing::TestWithParam<DesignFormat> {
 protected:
  const std::string name = GetParam().design;
  ScratchFolder folder;
};

TEST(FittedVerilogLint, EveryToolIsSilent) {
  for (const bool all_ports : {false, true}) {
    const ScratchFolder folder;
    std::vector<std::vector<std::string>> modules;
    for (const DesignFormat& d : every_design({"20/24"})) {
      const Fitted fitted(d, all_ports);
      fitted.write(folder, 1);
      const std::string outside = d.design + "_outside";
      write_text(folder / (outside + ".v"), check_module(outside, fitted.demands, fitted.ports));
      modules.push_back({d.design});
      modules.push_back({outside});
    }
    expect_silent_tools(folder.path(), modules, "", "-DHITPIPE_CHECK");
  }
}

TEST_P(FittedVerilog, AnswersInIcarusAsTheUnfittedCpp) {
  for (const bool all_ports : {false, true}) {
    Seeded random(23);
    const Fitted fitted(GetParam(), all_ports);
    fitted.write(folder, vector_count);
    fitted.write_vectors(folder, fitted.drawn(random, vector_count));
    compile(folder, name);
    EXPECT_NE(replayed(folder).find(fmt::format("PASS {} vectors", vector_count)), std::string::npos);
  }
}

/// What a unit was fitted to, less one: each demand in turn, then each one's low zeros alone.
std::vector<std::pair<std::string, Demands>> weakened(const Demands& demands) {
  std::vector<std::pair<std::string, Demands>> all;
  for (std::size_t i = 0; i < demands.count(); ++i)
    all.emplace_back(demand_text(demands, i), demands.without(i));
  for (std::size_t i = 0; i < demands.ports.size(); ++i) {
    if (hull(demands.ports[i]).low == hull(demands.ports[i]).high || demands.ports[i].low_zeros == 0)
      continue;
    all.emplace_back(demand_text(demands, i), demands);
    all.back().second.ports[i].low_zeros = 0;
  }
  return all;
}

/// Operands as demanded but for one, which is just outside: by every demand that can be broken alone.
TEST_P(FittedVerilog, TheCheckBlockStopsEveryBrokenDemand) {
  Seeded random(29);
  const Fitted fitted(GetParam(), true);
  fitted.write(folder, 20);
  compile(folder, name);
  std::size_t broken = 0;
  for (const auto& [demand, others] : weakened(fitted.demands)) {
    std::vector<std::vector<std::int64_t>> vectors = fitted.drawn(random, 20);
    const Draw draw(fitted.ports, others);
    std::vector<std::int64_t> outside;
    for (int tries = 0; tries < 10'000 && outside.empty(); ++tries) {
      const std::vector<std::int64_t> operands = draw(random);
      if (!meets(fitted.demands, fitted.ports, operands.data())) outside = operands;
    }
    ASSERT_FALSE(outside.empty()) << demand;
    vectors[10] = outside;
    fitted.write_vectors(folder, vectors);
    const std::string printed = replayed(folder);
    EXPECT_NE(printed.find(fmt::format("{}: {} is broken by", name, demand)), std::string::npos) << printed;
    EXPECT_EQ(printed.find("PASS"), std::string::npos);
    ++broken;
  }
  std::cout << broken << " demands broken\n";
  const std::size_t coarse_planes = GetParam().found().kind.of_boxes ? 2 : 0;
  EXPECT_EQ(broken, fitted.demands.count() + coarse_planes);
}

INSTANTIATE_TEST_SUITE_P(Designs, FittedVerilog, testing::ValuesIn(every_design({"20/24"})), design_suffix);

ModuleInterface unit_of(const std::vector<Port>& operands) {
  return unit_interface("unit", operands, {}, FlowControl::stall);
}

TEST(CheckBlock, WithoutDemandsIsNothing) {
  EXPECT_EQ(check_block(unit_of({{"a", 8, true}}), {}, {{"a", 8, true}}), "");
}

TEST(CheckBlock, TestsOnlyWhatAPortCanBreak) {
  const std::vector<Port> ports{{"a", 8, true}, {"b", 8, true}, {"c", 1, false}};
  const Demands demands{{{"a", {{-128, 5}}}, {"b", {{-9, -1}, {1, 9}}}, {"c", {{0, 1}}}}, {{"a", "b"}}};
  EXPECT_EQ(
      check_block(unit_of(ports), demands, ports),
      "\n  // Demands that the unit was fitted to.\n"
      "`ifdef HITPIPE_CHECK\n`ifndef SYNTHESIS\n  always @(posedge clk) begin\n    if (in_valid && in_ready "
      "&& !rst) begin\n"
      "      if (!($signed(a) <= 8'sh5)) begin\n"
      "        $display(\"unit: a in [-128, 5] is broken by a = %h\", a);\n        $fatal(1);\n      end\n"
      "      if (!(($signed(b) >= 8'shf7 && $signed(b) <= 8'shff) || ($signed(b) >= 8'sh1 && $signed(b) <= "
      "8'sh9))) begin\n"
      "        $display(\"unit: b in [-9, -1] or [1, 9] is broken by b = %h\", b);\n        $fatal(1);\n"
      "      end\n"
      "      if ($signed(a) > $signed(b)) begin\n"
      "        $display(\"unit: a <= b is broken by a = %h b = %h\", a, b);\n        $fatal(1);\n      end\n"
      "    end\n  end\n`endif\n`endif\n");
}

TEST(CheckBlock, TestsLowZeros) {
  const std::vector<Port> ports{{"a", 8, true}, {"b", 8, false}};
  const Demands demands{{{"a", {{-9, 127}}, 1}, {"b", {{0, 255}}, 3}}, {}};
  EXPECT_EQ(check_module("outside", demands, ports),
            "// outside: 1 when an operand is not as demanded.\nmodule outside (\n  input  wire [7:0] a,\n  "
            "input  wire [7:0] b,\n  output wire error\n);\n"
            "  assign error = (!($signed(a) >= 8'shf7) || |a[0:0])\n    || (|b[2:0]);\nendmodule\n");
}

TEST(CheckBlock, NamesWhatNarrowPortsCannotTell) {
  const std::vector<Port> ports{{"a", 8, true}, {"b", 8, true}};
  const Demands demands{{{"a", {{3, 3}}}, {"b", {{-7, -3}}}}, {}};
  // b is -8 and what its three bits say.
  EXPECT_EQ(
      check_block(unit_of({{"b", 3, false}}), demands, ports),
      "\n  // Demands that the unit was fitted to.\n"
      "  //   a = 3: not seen at these ports\n"
      "`ifdef HITPIPE_CHECK\n`ifndef SYNTHESIS\n  always @(posedge clk) begin\n    if (in_valid && "
      "in_ready && !rst) begin\n"
      "      if (!(b >= 3'h1 && b <= 3'h5)) begin\n"
      "        $display(\"unit: b in [-7, -3] is broken by b = %h\", b);\n        $fatal(1);\n      end\n"
      "    end\n  end\n`endif\n`endif\n");
}

}  // namespace
}  // namespace hitpipe::rtl::fitted_verilog_test
