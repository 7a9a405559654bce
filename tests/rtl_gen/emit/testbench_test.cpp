// The emitted testbench passes on the emitted design and fails on one wrong bit. Also its vectors, and random
// graphs.
#include "rtl_gen/emit/testbench.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/emit/vector_lines.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/schedule/random_schedule.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::testbench_test {
namespace {

/// What the testbench says in Icarus about the files in a folder, without what vvp adds. The exit code must
/// agree.
std::string replayed(const ScratchFolder& folder, const std::string& module) {
  const std::filesystem::path tb = folder / "tb";
  const ToolResult compiled =
      run_tool(tb, "iverilog", "iverilog", "-g2012 -o tb " + module + "_tb.sv ../" + module + ".v");
  if (compiled.status != 0) return "iverilog: " + compiled.output;
  const ToolResult replay = run_tool(tb, "iverilog", "vvp", "-n tb");
  std::istringstream printed(replay.output);
  std::string line;
  std::string verdicts;
  while (std::getline(printed, line))
    if (line.starts_with("PASS") || line.starts_with("FAIL")) verdicts += line;
  EXPECT_EQ(replay.status == 0, verdicts.starts_with("PASS")) << replay.output;
  return verdicts;
}

void write(const ScratchFolder& folder, const EmittedDesign& unit) {
  host::write_files(folder.path(), unit.files());
}

class Replay : public testing::TestWithParam<DesignFormat> {};

TEST_P(Replay, TheEmittedDesignPasses) {
  const ScratchFolder folder;
  write(folder, GetParam().emitted());
  EXPECT_EQ(replayed(folder, GetParam().module()), "PASS 1000 vectors");
}

INSTANTIATE_TEST_SUITE_P(Designs, Replay, testing::ValuesIn(every_design()), design_suffix);

TEST(Testbench, OneWrongBitFails) {
  const ScratchFolder folder;
  const EmittedDesign unit = DesignFormat{"int_slabs", "20/24"}.emitted();
  for (const int vector : {0, 517, 999}) {
    const std::string text = with_bit_inverted(unit.vectors.contents, vector, 0);
    const std::size_t at = place_of_vector(text, vector);
    const std::string line = text.substr(at, text.find('\n', at) - at);
    const int now = std::stoi(line.substr(line.size() - 1), nullptr, 16) & 1;
    write(folder, unit);
    write_text(folder / unit.vectors.name, text);
    EXPECT_EQ(
        replayed(folder, "int_slabs"),
        fmt::format("FAIL vector {0} ({1}): hit {2}, expected {3}, tag {0}", vector, line, 1 - now, now));
  }
}

TEST(Testbench, LostDoubledAndMixedTestsFail) {
  const struct {
    const char *good, *bad, *verdict;
  } damages[] = {
      {"assign out_valid = valid[4];", "assign out_valid = 1'b0;", "FAIL 0 of 1000 vectors came back"},
      {"else if (advance) valid", "else if (advance & ~valid[0]) valid", "FAIL"},  // doubled, or not there
      {"tag_s1 <= tag_s0", "tag_s1 <= in_tag", "FAIL"}};
  const ScratchFolder folder;
  for (const auto& [good, bad, verdict] : damages) {
    write(folder, DesignFormat{"int_slabs", "6/6"}.emitted({}, {.module = "int_slabs"}));
    damage(folder / "int_slabs.v", good, bad);
    EXPECT_TRUE(replayed(folder, "int_slabs").starts_with(verdict)) << bad;
  }
}

std::vector<Port> some_ports() {
  return {{"s", 4, true}, {"u", 5, false}, {"bit", 1, false}, {"wide", 64, true}};
}

const std::vector<hls::Result> hit_alone{{"hit", hls::Meaning::hit, 0, 1, false}};

TEST(Vectors, FitTheirPorts) {
  const auto vectors = operand_vectors(some_ports(), 4000, 7);
  ASSERT_EQ(vectors.size(), 4000U);
  for (const auto& v : vectors) {
    ASSERT_EQ(v.size(), 4U);
    ASSERT_TRUE(v[0] >= -8 && v[0] <= 7 && v[1] >= 0 && v[1] <= 31 && v[2] >= 0 && v[2] <= 1);
  }
}

TEST(Vectors, ReachTheCornersOfEveryPort) {
  const auto vectors = operand_vectors(some_ports(), 400, 7);
  const auto reaches = [&](std::size_t port, std::int64_t value) {
    return std::any_of(vectors.begin(), vectors.end(), [&](const auto& v) { return v[port] == value; });
  };
  for (const std::int64_t value : {0, 1, -1, 7, -8}) EXPECT_TRUE(reaches(0, value)) << value;
  for (const std::int64_t value : {0, 1, 15, 16, 31}) EXPECT_TRUE(reaches(1, value)) << value;
  for (const std::int64_t value : {0, 1}) EXPECT_TRUE(reaches(2, value)) << value;
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{-1}, INT64_MAX, INT64_MIN}) {
    EXPECT_TRUE(reaches(3, value)) << value;
  }
}

TEST(Vectors, ComeFromTheSeedAlone) {
  EXPECT_EQ(operand_vectors(some_ports(), 50, 7), operand_vectors(some_ports(), 50, 7));
  EXPECT_NE(operand_vectors(some_ports(), 50, 7), operand_vectors(some_ports(), 50, 8));
}

TEST(Vectors, PortsThatAreGoneAreNotWritten) {
  const std::vector<Port> ports{{"a", 4, false}, {"b", 4, false}, {"c", 8, true}};
  EXPECT_EQ(vector_file(ports, {{"b", 4, false}, {"c", 3, true}}, hit_alone,
                        {{{15, 9, -2}, {1}}, {{15, 1, 2}, {0}}}),
            "9d\n14\n");
}

TEST(Vectors, FirstPortIsInTheHighBitsAndHitInBit0) {
  const std::vector<Port> ports{{"a", 6, true}, {"b", 5, false}};
  const auto vectors = operand_vectors(ports, 20, 3);
  std::string expected;
  for (const auto& v : vectors) {
    const std::int64_t word = (v[0] & 0x3f) << 6 | v[1] << 1 | (v[0] < v[1] ? 1 : 0);
    expected += fmt::format("{:03x}\n", word);
  }
  const Evaluate less(
      [](const Format&, const std::int64_t* v, std::int64_t* results) { *results = v[0] < v[1] ? 1 : 0; },
      hls::IntBits{}, hit_alone);
  EXPECT_EQ(vector_file(ports, ports, hit_alone, with_results(vectors, less)), expected);
}

/// What Icarus prints about a graph with one output, "hit", compared with evaluate().
std::string replayed(const Graph& graph, const Pipeline& pipeline, const Library& library, int vectors) {
  const std::vector<Port> ports = input_ports(pipeline.graph);
  const ModuleInterface unit = unit_interface("toy", ports, result_ports(hit_alone), FlowControl::stall);
  const ScratchFolder folder;
  std::vector<Vector> expected;
  for (const std::vector<std::int64_t>& operands : operand_vectors(ports, vectors, 5)) {
    const std::vector<std::uint64_t> in(operands.begin(), operands.end());
    expected.push_back({operands, {static_cast<std::int64_t>(evaluate(graph, in).front())}});
  }
  host::write_files(folder.path(), {{"toy.v", to_verilog(pipeline, library)},
                                    {"tb/toy_tb.sv", testbench(unit, vectors, pipeline.latency())},
                                    {"tb/toy_vectors.hex", vector_file(ports, ports, hit_alone, expected)}});
  return replayed(folder, "toy");
}

// Tags are 16 bits: vector 65,536 has the tag of vector 0.
TEST(Testbench, MoreVectorsThanTagsPass) {
  Graph graph("toy");
  const NodeId a = graph.input("a", 4, false);
  graph.output("hit", graph.binary(Op::less, a, graph.input("b", 4, false)));
  const Library library = unit_library();
  EXPECT_EQ(replayed(graph, make_pipeline(graph, library), library, 65'600), "PASS 65600 vectors");
}

// Random graphs of every operation with good and bad schedules. Icarus finds the same bits as evaluate().
TEST(Testbench, RandomPipelinesPass) {
  constexpr int graphs = 40;
  Seeded random(151);
  const Library library = unit_library();
  int replays = 0;
  for (int i = 0; i < graphs; ++i, ++replays) {
    Recipe recipe(random, 4, 70, 8, i % 4 == 0 ? most_value_bits : 64);
    recipe.join_outputs();
    const Graph graph = recipe.graph("toy", "hit");
    Pipeline pipeline = make_pipeline(graph, library);
    if (i % 2 == 1) {
      pipeline.schedule = random_schedule(pipeline.graph, library, pipeline.schedule.clock_ps, random);
      pipeline.placement = place_registers(pipeline.graph, pipeline.schedule, Ports::latched);
    }
    ASSERT_EQ(replayed(graph, pipeline, library, 300), "PASS 300 vectors")
        << "graph " << i << "\n"
        << to_text(pipeline.graph) << to_verilog(pipeline, library);
  }
  EXPECT_EQ(replays, graphs);
}

// d[7:3] is latched; the comparison reads bits 6:4 of it.
TEST(Testbench, PartsOfARegisterWithoutItsLowBitsPass) {
  Graph graph("toy");
  const NodeId a = graph.input("a", 8, false);
  const NodeId b = graph.input("b", 8, false);
  const NodeId d = graph.binary(Op::sub, a, b);
  const NodeId e = graph.binary(Op::sub, graph.slice(d, 7, 3), graph.slice(b, 4, 0));
  const NodeId part = graph.binary(Op::less, graph.slice(d, 6, 4), graph.slice(a, 2, 0));
  const NodeId bit = graph.binary(Op::bit_xor, graph.slice(d, 5, 5), graph.slice(e, 4, 4));
  graph.output("hit", graph.binary(Op::bit_xor, part, bit));
  const Library library = unit_library();
  EXPECT_EQ(replayed(graph, make_pipeline(graph, library), library, 300), "PASS 300 vectors");
}

// Verilog extends operands to the width of the result before it inverts them.
TEST(Testbench, ACombinationalProductOfAnInvertedValuePasses) {
  for (const bool is_signed : {false, true}) {
    Graph graph("toy");
    const NodeId a = graph.input("a", 4, is_signed);
    const NodeId b = graph.input("b", 4, is_signed);
    const NodeId product = graph.binary(Op::mul, graph.invert(a), b, is_signed);
    graph.output("hit", graph.binary(Op::less, product, graph.constant(8, 0x1b)));
    const Library library = unit_library();
    EXPECT_EQ(replayed(graph, make_pipeline(graph, library), library, 300), "PASS 300 vectors");
  }
}

}  // namespace
}  // namespace hitpipe::rtl::testbench_test
