// A fitted unit's Verilog: taken by all tools without a word, with its check block and without, replayed with
// operands as demanded, and stopped by any that is not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/prune/all_ports.hpp"
#include "tests/rtl_gen/prune/compare.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::fitted_verilog_test {
namespace {

constexpr int vector_count = 500;

/// As the design's own vector file: operands first port first, then the results with the last in bit 0,
/// without leading zeros' rule.
std::string vector_line(const std::vector<Port>& ports, const std::vector<std::uint64_t>& operands,
                        const std::vector<hls::Result>& results, const std::vector<std::int64_t>& values) {
  std::string bits;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    for (int b = ports[i].width - 1; b >= 0; --b) bits += (operands[i] >> b & 1) != 0 ? '1' : '0';
  }
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (int b = results[i].width - 1; b >= 0; --b) bits += (values[i] >> b & 1) != 0 ? '1' : '0';
  }
  while (bits.size() % 4 != 0) bits.insert(bits.begin(), '0');
  std::string text;
  for (std::size_t i = 0; i < bits.size(); i += 4)
    text += fmt::format("{:x}", std::stoi(bits.substr(i, 4), nullptr, 2));
  return text + "\n";
}

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
    std::string lines;
    for (const auto& operands : vectors) {
      const Vector vector = with_results(operands, design.evaluate(format));
      lines +=
          vector_line(left, operands_left(graph, ports, operands), design.results(format), vector.results);
    }
    write_text(folder / "tb" / fmt::format("{}_vectors.hex", design.name), lines);
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
  const ToolResult compiled = run_tool(folder / "tb", "iverilog", "iverilog",
                                       "-g2012 -DHITPIPE_CHECK -o tb " + name + "_tb.sv ../" + name + ".v");
  ASSERT_EQ(compiled.status, 0) << compiled.output;
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

TEST_P(FittedVerilog, EveryToolIsSilent) {
  for (const bool all_ports : {false, true}) {
    const Fitted fitted(GetParam(), all_ports);
    fitted.write(folder, 1);
    write_text(folder / "outside.v", check_module("outside", fitted.demands, fitted.ports));
    const auto expect_silence = [&](const std::string& program, const std::string& arguments) {
      const ToolResult result = run_tool(folder.path(), program, program, arguments);
      EXPECT_EQ(result.status, 0);
      EXPECT_EQ(result.output, "") << program << ' ' << arguments;
    };
    const std::string define = all_ports ? "" : "-DHITPIPE_CHECK ";
    expect_silence("verilator", "--lint-only -Wall -DHITPIPE_CHECK " + name + ".v");
    expect_silence("iverilog", "-g2001 -Wall " + define + "-o design " + name + ".v");
    expect_silence("yosys", "-q -p 'read_verilog " + define + name + ".v; hierarchy -check -top " + name +
                                "; proc; check -assert'");
    expect_silence("verilator", "--lint-only -Wall outside.v");
    expect_silence("yosys",
                   "-q -p 'read_verilog outside.v; hierarchy -check -top outside; proc; check -assert'");
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
  EXPECT_EQ(broken, fitted.demands.count() + 2) << "both planes of the coarse axis";
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
