// The thesis's component library as Table 7.1 prints it, the laws beyond its rows, and the messages for a bad
// file.
#include "rtl_gen/component/library.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace hitpipe::rtl::library_test {
namespace {

struct Row {
  Component component;
  int bits;
  int area_um2;
  int delay_ps;
  int stages;
  bool estimated;
};

// Table 7.1: 0.007964 mm2 is 7964 um2, 1.1 ns is 1100 ps.
constexpr Row table_7_1[] = {
    {Component::int_subtract, 16, 7964, 1100, 0, false},
    {Component::int_subtract, 20, 11005, 1100, 0, false},
    {Component::int_subtract, 24, 13677, 1200, 0, false},
    {Component::int_multiply, 16, 67137, 2600, 2, false},
    {Component::int_multiply, 20, 89194, 3000, 2, false},
    {Component::int_multiply, 24, 134324, 3000, 3, false},
    {Component::int_compare, 20, 4533, 477, 0, true},
    {Component::int_compare, 24, 5439, 477, 0, false},
    {Component::fp_subtract, 32, 105673, 2700, 7, false},
    {Component::fp_multiply, 32, 174797, 2300, 5, false},
    {Component::fp_compare, 32, 13083, 477, 0, false},
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
    const Cell cell = thesis.cell(row.component, row.bits);
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
                  {Component::fp_subtract, 8, 2700, 7, false},
                  {Component::mux2, 2, 176, 0, false}});
}

TEST(ThesisLibrary, AboveTheWidestRowTheLawsHold) {
  expect_timings({// One stage for each 8 bits or part of 8 bits.
                  {Component::int_multiply, 25, 3000, 4, true},
                  {Component::int_multiply, 27, 3000, 4, true},
                  {Component::int_multiply, 32, 3000, 4, true},
                  {Component::int_multiply, 33, 3000, 5, true},
                  {Component::int_multiply, 64, 3000, 8, true},
                  // 24 bits are a tree of depth 5, and so are 32. 33 to 64 bits are one of depth 6.
                  {Component::int_subtract, 25, 1200, 0, true},
                  {Component::int_subtract, 32, 1200, 0, true},
                  {Component::int_subtract, 33, 1440, 0, true},
                  {Component::int_subtract, 64, 1440, 0, true},
                  {Component::int_compare, 32, 477, 0, true},
                  {Component::int_compare, 33, 573, 0, true},  // 572.4 rounded up
                  {Component::int_compare, 64, 573, 0, true},
                  {Component::fp_multiply, 64, 2300, 5, true},
                  // Bits side by side.
                  {Component::latch, 64, 176, 0, true},
                  {Component::mux2, 64, 176, 0, true}});
}

struct Area {
  Component component;
  int bits;
  int area_um2;
};

void expect_estimates(std::initializer_list<Area> areas) {
  for (const Area& a : areas) {
    const Cell cell = Library::thesis().cell(a.component, a.bits);
    SCOPED_TRACE(std::string(component_name(a.component)) + "_" + std::to_string(a.bits));
    EXPECT_EQ(cell.bits, a.bits);
    EXPECT_EQ(cell.area_um2, a.area_um2);
    EXPECT_TRUE(cell.estimated);
    EXPECT_EQ(cell.delay_ps, Library::thesis().timing(a.component, a.bits).delay_ps);
    EXPECT_EQ(cell.stages, Library::thesis().timing(a.component, a.bits).stages);
  }
}

TEST(ThesisLibrary, AreaBetweenRowsIsInterpolatedAndRounded) {
  expect_estimates({{Component::latch, 2, 167},               // 84 + 1586 / 19 = 167.47
                    {Component::latch, 16, 1336},             // 84 + 15 * 1586 / 19 = 1336.1
                    {Component::int_subtract, 18, 9485},      // 9484.5, halfway
                    {Component::int_subtract, 22, 12341},     // likewise
                    {Component::mux2, 28, 852},               // 851.5
                    {Component::int_multiply, 18, 77553},     // by the square: 67137 + 22057 * 68 / 144
                    {Component::int_multiply, 22, 110733}});  // 89194 + 45130 * 84 / 176
}

TEST(ThesisLibrary, AreaBeyondTheRowsIsInProportionToTheEndRow) {
  expect_estimates({{Component::int_subtract, 8, 3982},
                    {Component::int_subtract, 25, 14247},   // 14246.9
                    {Component::int_compare, 6, 1360},      // 4533 * 6 / 20 = 1359.9
                    {Component::int_multiply, 8, 16784},    // 67137 / 4 = 16784.25
                    {Component::int_multiply, 32, 238798},  // 134324 * 16 / 9
                    {Component::latch, 64, 5346},
                    {Component::fp_subtract, 8, 26418},  // 26418.25
                    {Component::fp_multiply, 64, 699188}});
}

TEST(UnitLibrary, AreaLawsInTheHead) {
  const Library unit = unit_library();
  for (const int bits : {1, 5, 8, 9, 24}) {
    EXPECT_EQ(unit.cell(Component::latch, bits).area_um2, bits);
    EXPECT_EQ(unit.cell(Component::int_subtract, bits).area_um2, bits);
    EXPECT_EQ(unit.cell(Component::int_multiply, bits).area_um2, bits * bits);
    EXPECT_EQ(unit.cell(Component::latch, bits).estimated, bits != 1);
  }
}

TEST(Library, FloatsMayBeLeftOut) {
  const Library unit = unit_library();
  EXPECT_TRUE(Library::thesis().has(Component::fp_multiply));
  EXPECT_TRUE(unit.has(Component::int_multiply));
  EXPECT_FALSE(unit.has(Component::fp_multiply));
  const std::string message = "library unit: it has no fp_multiply";
  EXPECT_EQ(
      message_of<std::runtime_error>([&] { static_cast<void>(unit.timing(Component::fp_multiply, 32)); }),
      message);
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(unit.cell(Component::fp_multiply, 32)); }),
            message);
}

TEST(Library, ALatchWithAnEnableMayBeLeftOut) {
  EXPECT_FALSE(Library::thesis().has(Component::latch_enable));
  EXPECT_EQ(message_of<std::runtime_error>(
                [] { static_cast<void>(Library::thesis().cell(Component::latch_enable, 8)); }),
            "library thesis_250nm: it has no latch_enable");
  EXPECT_EQ(component_name(Component::latch_enable), "latch_enable");
}

TEST(Library, ComponentsHaveNames) {
  for (std::size_t i = 0; i < component_count; ++i) {
    const auto component = static_cast<Component>(i);
    EXPECT_EQ(component_called(component_name(component)), component);
  }
  EXPECT_EQ(message_of<std::invalid_argument>([] { static_cast<void>(component_called("fp_divide")); }),
            "component fp_divide: no library has it");
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

/// The message for the unit library's text after one replacement.
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
      "toy.json: not JSON: [json.exception.parse_error.101] parse error at line 1, column 1: "
      "syntax error while parsing value - invalid literal; last read: 'l'");
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 1e999"),
            "toy.json: not JSON: [json.exception.out_of_range.406] number overflow parsing '1e999'");
}

TEST(Library, MissingKeyRejected) {
  EXPECT_EQ(told("\"gate_delay_ps\": 1,", ""), "toy.json: \"gate_delay_ps\" is missing");
  EXPECT_EQ(told("\"int_compare\"", "\"compare\""), "toy.json: \"int_compare\" is missing");
  EXPECT_EQ(told("\"area\": \"quadratic\", ", ""), "toy.json: int_multiply: \"area\" is missing");
  EXPECT_EQ(told("\"bits\": 12, ", ""), "toy.json: int_multiply: \"bits\" is missing");
  EXPECT_EQ(told("\"area_um2\": 144, ", ""), "toy.json: int_multiply_12: \"area_um2\" is missing");
}

TEST(Library, ValueOfAnotherTypeRejected) {
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": \"12\""),
            "toy.json: int_multiply: \"bits\" is \"12\", allowed are whole numbers from 1 to 1024");
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 12.5"),
            "toy.json: int_multiply: \"bits\" is 12.5, allowed are whole numbers from 1 to 1024");
  EXPECT_EQ(told("\"unit\"", "7"), "toy.json: \"name\" must be a text");
  EXPECT_EQ(told("\"unit\"", "\"two\\nlines\""), "toy.json: \"name\" must be one line");
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": " + std::string(200'000, '[') + std::string(200'000, ']')),
            "toy.json: int_multiply: \"bits\" is array, allowed are whole numbers from 1 to 1024");
  EXPECT_EQ(told("{\"bits\": 12, \"area_um2\": 144, \"delay_ps\": 10, \"stages\": 3}", "12"),
            "toy.json: int_multiply: must be a JSON object");
  EXPECT_EQ(told("\"stages\": 3", "\"stages\": 3, \"estimated\": \"yes\""),
            "toy.json: int_multiply_12: \"estimated\" must be true or false");
}

TEST(Library, UnknownLawRejected) {
  EXPECT_EQ(told("\"mux2\": {\"above\": \"same\"", "\"mux2\": {\"above\": \"linear\""),
            "toy.json: mux2: \"above\" is \"linear\", allowed are same, tree, stages");
  EXPECT_EQ(told("\"area\": \"quadratic\"", "\"area\": \"cubic\""),
            "toy.json: int_multiply: \"area\" is \"cubic\", allowed are linear, quadratic");
}

TEST(Library, NumbersOutOfRangeRejected) {
  const auto rule = [](const std::string& least, const std::string& most) {
    return ", allowed are whole numbers from " + least + " to " + most;
  };
  EXPECT_EQ(told("\"gate_delay_ps\": 1", "\"gate_delay_ps\": 0"),
            "toy.json: \"gate_delay_ps\" is 0" + rule("1", "1000000"));
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 0"), "toy.json: int_multiply: \"bits\" is 0" + rule("1", "1024"));
  EXPECT_EQ(told("\"bits\": 12", "\"bits\": 1025"),
            "toy.json: int_multiply: \"bits\" is 1025" + rule("1", "1024"));
  EXPECT_EQ(told("\"area_um2\": 144", "\"area_um2\": -1"),
            "toy.json: int_multiply_12: \"area_um2\" is -1" + rule("0", "100000000"));
  EXPECT_EQ(told("\"area_um2\": 144", "\"area_um2\": 18446744073709551615"),
            "toy.json: int_multiply_12: \"area_um2\" is 18446744073709551615" + rule("0", "100000000"));
  EXPECT_EQ(told("\"delay_ps\": 2,", "\"delay_ps\": 0,"),
            "toy.json: mux2_1: \"delay_ps\" is 0" + rule("1", "1000000"));
  EXPECT_EQ(told("\"stages\": 3", "\"stages\": -3"),
            "toy.json: int_multiply_12: \"stages\" is -3" + rule("0", "64"));
}

TEST(Library, AreaBeyondAllBoundsRejected) {
  std::string text(unit_json);
  const std::string row = "\"area_um2\": 144";
  text.replace(text.find(row), row.size(), "\"area_um2\": 100000000");
  const Library large = Library::from_json(text, "toy.json");
  EXPECT_EQ(large.cell(Component::int_multiply, 12).area_um2, 100'000'000);
  EXPECT_EQ(
      message_of<std::runtime_error>([&] { static_cast<void>(large.cell(Component::int_multiply, 24)); }),
      "library unit: int_multiply_24 would have 400000000 um2, allowed are 100000000");
}

TEST(Library, NoCellsRejected) {
  const std::string none = "toy.json: int_compare: no cells";
  EXPECT_EQ(told("{\"bits\": 8, \"area_um2\": 4, \"delay_ps\": 5, \"stages\": 0}", ""), none);
  EXPECT_EQ(told("[\n      {\"bits\": 8, \"area_um2\": 4, \"delay_ps\": 5, \"stages\": 0}]", "4"), none);
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
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(Library::load(file)); }),
            file.string() + ": \"name\" is missing");
  std::filesystem::remove(file);
}

TEST(Library, FileThatIsNotThereRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(Library::load("/nowhere/cells.json")); }),
            "/nowhere/cells.json: cannot read the component library");
}

}  // namespace
}  // namespace hitpipe::rtl::library_test
