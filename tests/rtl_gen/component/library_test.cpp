// The thesis's component library as Table 7.1 prints it, the laws beyond its rows, and what a bad file is
// told.
#include "rtl_gen/component/library.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/message_of.hpp"

namespace hitpipe::rtl {
namespace {

struct Row {
  Component component;
  int bits;
  int area_um2;
  int delay_ps;
  int stages;
  bool estimated;
};

// Table 7.1, integer rows: 0.007964 mm2 is 7964 um2, 1.1 ns is 1100 ps.
constexpr Row table_7_1[] = {
    {Component::int_subtract, 16, 7964, 1100, 0, false},
    {Component::int_subtract, 20, 11005, 1100, 0, false},
    {Component::int_subtract, 24, 13677, 1200, 0, false},
    {Component::int_multiply, 16, 67137, 2600, 2, false},
    {Component::int_multiply, 20, 89194, 3000, 2, false},
    {Component::int_multiply, 24, 134324, 3000, 3, false},
    {Component::int_compare, 20, 4533, 477, 0, true},
    {Component::int_compare, 24, 5439, 477, 0, false},
    {Component::latch, 1, 84, 176, 0, false},
    {Component::latch, 20, 1670, 176, 0, false},
    {Component::latch, 24, 2004, 176, 0, false},
    {Component::latch, 32, 2673, 176, 0, false},
    {Component::mux2, 1, 30, 176, 0, false},
    {Component::mux2, 20, 608, 176, 0, false},
    {Component::mux2, 24, 730, 176, 0, false},
    {Component::mux2, 32, 973, 176, 0, false},
};

TEST(ThesisLibrary, HasTheRowsOfTable71) {
  const Library& thesis = Library::thesis();
  for (const Row& row : table_7_1) {
    const Cell cell = thesis.timing(row.component, row.bits);
    SCOPED_TRACE(std::string(component_name(row.component)) + "_" + std::to_string(row.bits));
    EXPECT_EQ(cell.bits, row.bits);
    EXPECT_EQ(cell.area_um2, row.area_um2);
    EXPECT_EQ(cell.delay_ps, row.delay_ps);
    EXPECT_EQ(cell.stages, row.stages);
    EXPECT_EQ(cell.estimated, row.estimated);
  }
  EXPECT_EQ(thesis.name(), "thesis_250nm");
  EXPECT_EQ(thesis.latch_delay_ps(), 176);
  EXPECT_EQ(thesis.gate_delay_ps(), 75) << "section 7.3";
}

struct Timing {
  Component component;
  int bits;
  int delay_ps;
  int stages;
  bool estimated;
};

void expect_timings(std::initializer_list<Timing> timings) {
  for (const Timing& t : timings) {
    const Cell cell = Library::thesis().timing(t.component, t.bits);
    SCOPED_TRACE(std::string(component_name(t.component)) + "_" + std::to_string(t.bits));
    EXPECT_EQ(cell.delay_ps, t.delay_ps);
    EXPECT_EQ(cell.stages, t.stages);
    EXPECT_EQ(cell.estimated, t.estimated);
  }
}

TEST(ThesisLibrary, AWidthBetweenRowsTakesTheNextLargerRow) {
  expect_timings({{Component::int_subtract, 1, 1100, 0, false},
                  {Component::int_subtract, 17, 1100, 0, false},
                  {Component::int_subtract, 21, 1200, 0, false},
                  {Component::int_multiply, 6, 2600, 2, false},
                  {Component::int_multiply, 17, 3000, 2, false},
                  {Component::int_multiply, 21, 3000, 3, false},
                  {Component::int_compare, 6, 477, 0, true},
                  {Component::int_compare, 21, 477, 0, false},
                  {Component::mux2, 2, 176, 0, false}});
  EXPECT_EQ(Library::thesis().timing(Component::latch, 2).area_um2, 1670);
}

TEST(ThesisLibrary, AboveTheWidestRowTheLawsHold) {
  expect_timings({// One stage for every started 8 bits.
                  {Component::int_multiply, 25, 3000, 4, true},
                  {Component::int_multiply, 27, 3000, 4, true},
                  {Component::int_multiply, 32, 3000, 4, true},
                  {Component::int_multiply, 33, 3000, 5, true},
                  {Component::int_multiply, 64, 3000, 8, true},
                  // 24 bits are a tree of depth 5, as are 32; 33 to 64 one of 6.
                  {Component::int_subtract, 25, 1200, 0, true},
                  {Component::int_subtract, 32, 1200, 0, true},
                  {Component::int_subtract, 33, 1440, 0, true},
                  {Component::int_subtract, 64, 1440, 0, true},
                  {Component::int_compare, 32, 477, 0, true},
                  {Component::int_compare, 33, 573, 0, true},  // 572.4 rounded up
                  {Component::int_compare, 64, 573, 0, true},
                  // Bits side by side.
                  {Component::latch, 64, 176, 0, true},
                  {Component::mux2, 64, 176, 0, true}});
}

TEST(Library, ComponentsOfNodesAndTheirWidths) {
  Graph g("uses");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 12, true);
  const NodeId wide = g.extend(a, 12, true);
  const auto expect = [&](NodeId node, std::string_view component, int bits) {
    const ComponentUse use = component_of(g, node);
    EXPECT_EQ(component_name(use.component), component);
    EXPECT_EQ(use.bits, bits);
  };
  expect(g.binary(Op::sub, wide, b), "int_subtract", 12);
  expect(g.binary(Op::add, wide, b), "int_subtract", 12);
  expect(g.binary(Op::mul, a, b, true), "int_multiply", 12);
  expect(g.binary(Op::mul, b, a, true), "int_multiply", 12);
  expect(g.binary(Op::less, wide, b, true), "int_compare", 12);
  expect(g.binary(Op::equal, wide, b), "int_compare", 12);
  expect(g.mux(g.slice(a, 7, 7), wide, b), "mux2", 12);
  EXPECT_EQ(component_name(Component::latch), "latch");

  const NodeId gate = g.binary(Op::bit_and, wide, b);
  EXPECT_FALSE(is_component(Op::bit_and));
  EXPECT_EQ(timing_of(g, gate, unit_library()).delay_ps, 1);
  EXPECT_EQ(timing_of(g, gate, unit_library()).stages, 0);
  EXPECT_EQ(message_of<std::logic_error>([&] { static_cast<void>(component_of(g, gate)); }),
            "and is not a component");
}

/// What the unit library's text is told after one replacement.
std::string told(std::string_view from, std::string_view to) {
  std::string text(unit_json);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return "";
  text.replace(at, from.size(), to);
  return message_of<std::runtime_error>([&] { static_cast<void>(Library::from_json(text, "toy.json")); });
}

TEST(Library, AGoodTextIsTaken) {
  EXPECT_EQ(told("\"unit\"", "\"other\""), "no exception");
  EXPECT_EQ(unit_library().name(), "unit");
  EXPECT_EQ(unit_library().timing(Component::int_multiply, 12).stages, 3);
}

TEST(Library, TextThatIsNotJsonRejected) {
  EXPECT_EQ(
      message_of<std::runtime_error>([] { static_cast<void>(Library::from_json("latch 1 84", "toy.json")); }),
      "toy.json: not a component library: [json.exception.parse_error.101] parse error at line 1, column 1: "
      "syntax error while parsing value - invalid literal; last read: 'l'");
}

TEST(Library, MissingKeyRejected) {
  EXPECT_EQ(
      told("\"gate_delay_ps\": 1,", ""),
      "toy.json: not a component library: [json.exception.out_of_range.403] key 'gate_delay_ps' not found");
  EXPECT_EQ(
      told("\"int_compare\"", "\"compare\""),
      "toy.json: not a component library: [json.exception.out_of_range.403] key 'int_compare' not found");
  EXPECT_EQ(told("\"area_um2\": 144, ", ""),
            "toy.json: not a component library: [json.exception.out_of_range.403] key 'area_um2' not found");
}

TEST(Library, ValueOfAnotherTypeRejected) {
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": \"12\""),
            "toy.json: not a component library: [json.exception.type_error.302] type must be number, but is "
            "string");
}

TEST(Library, UnknownLawRejected) {
  EXPECT_EQ(told("\"mux2\": {\"above\": \"same\"", "\"mux2\": {\"above\": \"linear\""),
            "toy.json: mux2: \"above\" is \"linear\", allowed are same, tree, stages");
}

TEST(Library, NumbersOutOfRangeRejected) {
  EXPECT_EQ(told("\"gate_delay_ps\": 1", "\"gate_delay_ps\": 0"),
            "toy.json: gate_delay_ps must be at least 1");
  const std::string rule = ": bits and delay_ps must be at least 1, area_um2 and stages at least 0";
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 0"), "toy.json: int_multiply:0" + rule);
  EXPECT_EQ(told("\"area_um2\": 144", "\"area_um2\": -1"), "toy.json: int_multiply:12" + rule);
  EXPECT_EQ(told("\"delay_ps\": 2,", "\"delay_ps\": 0,"), "toy.json: mux2:1" + rule);
  EXPECT_EQ(told("\"stages\": 3", "\"stages\": -3"), "toy.json: int_multiply:12" + rule);
}

TEST(Library, NoCellsRejected) {
  EXPECT_EQ(told("[{\"bits\": 1, \"area_um2\": 1, \"delay_ps\": 2, \"stages\": 0}]", "[]"),
            "toy.json: mux2: no cells");
}

TEST(Library, WidthsOutOfOrderRejected) {
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 6"),
            "toy.json: int_multiply: cells must be in ascending order of bits");
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 8"),
            "toy.json: int_multiply: cells must be in ascending order of bits");
}

TEST(Library, TreeOfOneBitRejected) {
  EXPECT_EQ(told("\"mux2\": {\"above\": \"same\"", "\"mux2\": {\"above\": \"tree\""),
            "toy.json: mux2: \"tree\" needs a cell of at least 2 bits");
}

TEST(Library, LoadsAFile) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "hitpipe_unit_library.json";
  std::ofstream(file) << unit_json;
  EXPECT_EQ(Library::load(file).name(), "unit");
  std::ofstream(file) << "{}";
  EXPECT_EQ(
      message_of<std::runtime_error>([&] { static_cast<void>(Library::load(file)); }),
      file.string() + ": not a component library: [json.exception.out_of_range.403] key 'name' not found");
  std::filesystem::remove(file);
}

TEST(Library, FileThatIsNotThereRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(Library::load("/nowhere/cells.json")); }),
            "/nowhere/cells.json: cannot read the component library");
}

}  // namespace
}  // namespace hitpipe::rtl
