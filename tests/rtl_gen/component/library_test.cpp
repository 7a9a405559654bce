// The thesis's component library as Table 7.1 prints it, the laws beyond its rows, the messages for a bad
// file, and the libraries of the program.
#include "rtl_gen/component/library.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::library_test {
namespace {

using enum Component;

std::string range(int least, int most) {
  return fmt::format(", allowed are whole numbers from {} to {}", least, most);
}

struct Row {
  Component component;
  int bits;
  std::int64_t area_um2;  ///< not_told: the row is about timing
  int delay_ps = 0;       ///< 0: the row is about area
  int stages = 0;
  bool estimated = true;
};
constexpr std::int64_t not_told = -1;

void expect_rows(std::initializer_list<Row> rows) {
  for (const Row& row : rows) {
    SCOPED_TRACE(fmt::format("{}_{}", component_name(row.component), row.bits));
    const Cell timing = Library::thesis().timing(row.component, row.bits);
    if (row.delay_ps > 0) {
      EXPECT_EQ(timing.delay_ps, row.delay_ps);
      EXPECT_EQ(timing.stages, row.stages);
      EXPECT_EQ(timing.estimated, row.estimated);
    }
    if (row.area_um2 == not_told) continue;
    const Cell cell = Library::thesis().cell(row.component, row.bits);
    EXPECT_EQ(cell.bits, row.bits);
    EXPECT_EQ(cell.area_um2, row.area_um2);
    EXPECT_EQ(cell.estimated, row.estimated);
    EXPECT_EQ(cell.delay_ps, timing.delay_ps);
    EXPECT_EQ(cell.stages, timing.stages);
  }
}

// Table 7.1: 0.007964 mm2 is 7964 um2, 1.1 ns is 1100 ps.
TEST(ThesisLibrary, HasTheRowsOfTable71) {
  expect_rows({{int_subtract, 16, 7964, 1100, 0, false},
               {int_subtract, 20, 11005, 1100, 0, false},
               {int_subtract, 24, 13677, 1200, 0, false},
               {int_multiply, 16, 67137, 2600, 2, false},
               {int_multiply, 20, 89194, 3000, 2, false},
               {int_multiply, 24, 134324, 3000, 3, false},
               {int_compare, 20, 4533, 477, 0, true},
               {int_compare, 24, 5439, 477, 0, false},
               {fp_subtract, 32, 105673, 2700, 7, false},
               {fp_multiply, 32, 174797, 2300, 5, false},
               {fp_compare, 32, 13083, 477, 0, false},
               {latch, 1, 84, 176, 0, false},
               {latch, 20, 1670, 176, 0, false},
               {latch, 24, 2004, 176, 0, false},
               {latch, 32, 2673, 176, 0, false},
               {mux2, 1, 30, 176, 0, false},
               {mux2, 20, 608, 176, 0, false},
               {mux2, 24, 730, 176, 0, false},
               {mux2, 32, 973, 176, 0, false}});
  EXPECT_EQ(Library::thesis().name(), "thesis_250nm");
  EXPECT_EQ(Library::thesis().latch_delay_ps(), 176);
  EXPECT_EQ(Library::thesis().gate_delay_ps(), 75) << "section 7.3";
}

TEST(ThesisLibrary, AWidthBetweenRowsTakesTheTimingOfTheNextLargerRow) {
  expect_rows({{int_subtract, 1, not_told, 1100, 0, false},
               {int_subtract, 17, not_told, 1100, 0, false},
               {int_subtract, 21, not_told, 1200, 0, false},
               {int_multiply, 6, not_told, 2600, 2, false},
               {int_multiply, 17, not_told, 3000, 2, false},
               {int_multiply, 21, not_told, 3000, 3, false},
               {int_compare, 6, not_told, 477, 0, true},
               {int_compare, 21, not_told, 477, 0, false},
               {fp_subtract, 8, not_told, 2700, 7, false},
               {mux2, 2, not_told, 176, 0, false}});
}

// A multiplier has a stage for each 8 bits or part of 8 bits. 24 bits are a tree of depth 5, and so are 32;
// 33 to 64 bits are one of depth 6. 572.4 is rounded up. Latches and multiplexers have bits side by side.
TEST(ThesisLibrary, AboveTheWidestRowTheLawsOfTimingHold) {
  expect_rows({{int_multiply, 25, not_told, 3000, 4},
               {int_multiply, 27, not_told, 3000, 4},
               {int_multiply, 32, not_told, 3000, 4},
               {int_multiply, 33, not_told, 3000, 5},
               {int_multiply, 64, not_told, 3000, 8},
               {int_subtract, 25, not_told, 1200},
               {int_subtract, 32, not_told, 1200},
               {int_subtract, 33, not_told, 1440},
               {int_subtract, 64, not_told, 1440},
               {int_compare, 32, not_told, 477},
               {int_compare, 33, not_told, 573},
               {int_compare, 64, not_told, 573},
               {fp_multiply, 64, not_told, 2300, 5},
               {latch, 64, not_told, 176},
               {mux2, 64, not_told, 176}});
}

TEST(ThesisLibrary, AreaBetweenRowsIsInterpolatedAndRounded) {
  expect_rows({{latch, 2, 167},               // 84 + 1586 / 19 = 167.47
               {latch, 16, 1336},             // 84 + 15 * 1586 / 19 = 1336.1
               {int_subtract, 18, 9485},      // 9484.5, halfway
               {int_subtract, 22, 12341},     // likewise
               {mux2, 28, 852},               // 851.5
               {int_multiply, 18, 77553},     // by the square: 67137 + 22057 * 68 / 144
               {int_multiply, 22, 110733}});  // 89194 + 45130 * 84 / 176
}

TEST(ThesisLibrary, AreaBeyondTheRowsIsInProportionToTheEndRow) {
  expect_rows({{int_subtract, 8, 3982},
               {int_subtract, 25, 14247},   // 14246.9
               {int_compare, 6, 1360},      // 4533 * 6 / 20 = 1359.9
               {int_multiply, 8, 16784},    // 67137 / 4 = 16784.25
               {int_multiply, 32, 238798},  // 134324 * 16 / 9
               {latch, 64, 5346},
               {fp_subtract, 8, 26418},  // 26418.25
               {fp_multiply, 64, 699188}});
}

TEST(UnitLibrary, AreaLawsInTheHead) {
  const Library unit = unit_library();
  for (const int bits : {1, 5, 8, 9, 24}) {
    EXPECT_EQ(unit.cell(latch, bits).area_um2, bits);
    EXPECT_EQ(unit.cell(int_subtract, bits).area_um2, bits);
    EXPECT_EQ(unit.cell(int_multiply, bits).area_um2, bits * bits);
    EXPECT_EQ(unit.cell(latch, bits).estimated, bits != 1);
  }
}

TEST(Library, ComponentsMayBeLeftOut) {
  const Library unit = unit_library();
  EXPECT_TRUE(Library::thesis().has(fp_multiply));
  EXPECT_FALSE(Library::thesis().has(latch_enable));
  EXPECT_TRUE(unit.has(int_multiply));
  EXPECT_FALSE(unit.has(fp_multiply));
  EXPECT_EQ(message_of([&] { return unit.timing(fp_multiply, 32); }), "library unit: it has no fp_multiply");
  EXPECT_EQ(message_of([&] { return unit.cell(fp_multiply, 32); }), "library unit: it has no fp_multiply");
  EXPECT_EQ(message_of([] { return Library::thesis().cell(latch_enable, 8); }),
            "library thesis_250nm: it has no latch_enable");
}

TEST(Library, ComponentsHaveNames) {
  for (std::size_t i = 0; i < component_count; ++i) {
    const auto component = static_cast<Component>(i);
    EXPECT_EQ(component_called(component_name(component)), component);
  }
  EXPECT_EQ(message_of<std::invalid_argument>([] { return component_called("fp_divide"); }),
            "component fp_divide: no library has it");
}

TEST(Library, ComponentsOfNodesAndTheirWidths) {
  Graph g("uses");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 12, true);
  const NodeId wide = g.extend(a, 12, true);
  const std::pair<NodeId, Component> cases[] = {
      {g.binary(Op::sub, wide, b), int_subtract},       {g.binary(Op::add, wide, b), int_subtract},
      {g.binary(Op::mul, a, b, true), int_multiply},    {g.binary(Op::mul, b, a, true), int_multiply},
      {g.binary(Op::less, wide, b, true), int_compare}, {g.binary(Op::equal, wide, b), int_compare},
      {g.mux(g.slice(a, 7, 7), wide, b), mux2}};
  for (const auto& [node, component] : cases) {
    EXPECT_EQ(component_of(g, node).component, component);
    EXPECT_EQ(component_of(g, node).bits, 12);
  }
  const NodeId and_gate = g.binary(Op::bit_and, wide, b);
  EXPECT_FALSE(is_component(Op::bit_and));
  EXPECT_EQ(timing_of(g, and_gate, unit_library()).delay_ps, 1);
  EXPECT_EQ(timing_of(g, and_gate, unit_library()).stages, 0);
  EXPECT_EQ(message_of<std::logic_error>([&] { return component_of(g, and_gate); }),
            "and is not a component");
}

TEST(Library, BadTextRejected) {
  expect_refusals(
      unit_json,
      {{R"("unit")", R"("other")", ""},
       {R"({)", "latch 1 84 {",
        "not JSON: [json.exception.parse_error.101] parse error at line 1, column 1: syntax error while "
        "parsing "
        "value - invalid literal; last read: 'l'"},
       {R"("bits": 12)", R"("bits": 1e999)",
        "not JSON: [json.exception.out_of_range.406] number overflow parsing '1e999'"},
       // Missing keys.
       {R"("gate_delay_ps": 1,)", "", R"("gate_delay_ps" is missing)"},
       {R"("int_compare")", R"("compare")", R"("int_compare" is missing)"},
       {R"("area": "quadratic", )", "", R"(int_multiply: "area" is missing)"},
       {R"("bits": 12, )", "", R"(int_multiply: "bits" is missing)"},
       {R"("area_um2": 144, )", "", R"(int_multiply_12: "area_um2" is missing)"},
       // Values of another type.
       {R"("bits": 12)", R"("bits": "12")", R"(int_multiply: "bits" is "12")" + range(1, 1024)},
       {R"("bits": 12)", R"("bits": 12.5)", R"(int_multiply: "bits" is 12.5)" + range(1, 1024)},
       {R"("unit")", "7", R"("name" must be a text)"},
       {R"("unit")", R"("two\nlines")", R"("name" must be one line)"},
       {R"("bits": 12)", R"("bits": )" + std::string(200'000, '[') + std::string(200'000, ']'),
        R"(int_multiply: "bits" is array)" + range(1, 1024)},
       {R"({"bits": 12, "area_um2": 144, "delay_ps": 10, "stages": 3})", "12",
        "int_multiply: must be a JSON object"},
       {R"("stages": 3)", R"("stages": 3, "estimated": "yes")",
        R"(int_multiply_12: "estimated" must be true or false)"},
       // Unknown laws.
       {R"("mux2": {"above": "same")", R"("mux2": {"above": "linear")",
        R"(mux2: "above" is "linear", allowed are same, tree, stages)"},
       {R"("area": "quadratic")", R"("area": "cubic")",
        R"(int_multiply: "area" is "cubic", allowed are linear, quadratic)"},
       {R"("mux2": {"above": "same")", R"("mux2": {"above": "tree")",
        R"(mux2: "tree" needs a cell of at least 2 bits)"},
       // Numbers out of range.
       {R"("gate_delay_ps": 1)", R"("gate_delay_ps": 0)", R"("gate_delay_ps" is 0)" + range(1, 1000000)},
       {R"("bits": 12)", R"("bits": 0)", R"(int_multiply: "bits" is 0)" + range(1, 1024)},
       {R"("bits": 12)", R"("bits": 1025)", R"(int_multiply: "bits" is 1025)" + range(1, 1024)},
       {R"("area_um2": 144)", R"("area_um2": -1)",
        R"(int_multiply_12: "area_um2" is -1)" + range(0, 100000000)},
       {R"("area_um2": 144)", R"("area_um2": 18446744073709551615)",
        R"(int_multiply_12: "area_um2" is 18446744073709551615)" + range(0, 100000000)},
       {R"("delay_ps": 2,)", R"("delay_ps": 0,)", R"(mux2_1: "delay_ps" is 0)" + range(1, 1000000)},
       {R"("stages": 3)", R"("stages": -3)", R"(int_multiply_12: "stages" is -3)" + range(0, 64)},
       // No cells, and cells in another order.
       {R"({"bits": 8, "area_um2": 4, "delay_ps": 5, "stages": 0})", "", "int_compare: no cells"},
       {"[\n      {\"bits\": 8, \"area_um2\": 4, \"delay_ps\": 5, \"stages\": 0}]", "4",
        "int_compare: no cells"},
       {R"("bits": 12)", R"("bits": 6)", "int_multiply: cells must be in ascending order of bits"},
       {R"("bits": 12)", R"("bits": 8)", "int_multiply: cells must be in ascending order of bits"}});
}

TEST(Library, AreaBeyondAllBoundsRejected) {
  const Library large = Library::from_json(
      replaced(std::string(unit_json), R"("area_um2": 144)", R"("area_um2": 100000000)"), "toy.json");
  EXPECT_EQ(large.cell(int_multiply, 12).area_um2, 100'000'000);
  EXPECT_EQ(message_of([&] { return large.cell(int_multiply, 24); }),
            "library unit: int_multiply_24 would have 400000000 um2, allowed are 100000000");
}

TEST(Library, IsAFileByItsPath) {
  const ScratchFolder folder;
  const std::string file = folder / "unit.json";
  write_text(file, std::string(unit_json));
  EXPECT_EQ(Library::load(file).name(), "unit");
  EXPECT_EQ(library_called(file).name(), "unit");
  write_text(file, "{}");
  EXPECT_EQ(message_of([&] { return Library::load(file); }), file + ": \"name\" is missing");
  const std::string nowhere = folder / "no.json";
  EXPECT_EQ(message_of([&] { return Library::load(nowhere); }),
            nowhere + ": cannot read the component library");
  EXPECT_EQ(message_of([&] { return library_called(nowhere); }),
            nowhere + ": cannot read the component library");
}

TEST(BuiltIn, EveryFileOfTheFolderIsThereByItsName) {
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(HITPIPE_SOURCE "/rtl_gen/component/libraries")) {
    EXPECT_EQ(entry.path().extension(), ".json");
    files.push_back(entry.path().stem().string());
    EXPECT_EQ(library_called(files.back()).name(), files.back());
    EXPECT_NE(library_called(files.back()).source(), "") << files.back();
  }
  std::sort(files.begin(), files.end());
  EXPECT_EQ(built_in_names(), files);
  EXPECT_THAT(files, testing::IsSupersetOf({"ecp5", "ice40_hx", "ice40_up5k", "thesis_250nm", "xc7"}));
  EXPECT_EQ(Library::thesis().name(), default_library);
}

TEST(BuiltIn, ChipsHaveNoFloatsOfTheirOwn) {
  const Library xilinx = library_called("xc7");
  EXPECT_TRUE(xilinx.has(int_multiply));
  EXPECT_FALSE(library_called("ice40_hx").has(int_multiply));
  EXPECT_EQ(message_of([&] { return xilinx.timing(fp_multiply, 32); }), "library xc7: it has no fp_multiply");
}

TEST(BuiltIn, UnknownNameRejected) {
  const std::string message = message_of([] { return library_called("virtex"); });
  EXPECT_THAT(message, testing::StartsWith("library virtex: unknown; there are ecp5, ice40_hx, "));
  EXPECT_THAT(message, testing::EndsWith(", xc7, and any file whose name ends in .json"));
}

constexpr std::string_view toy_json = R"json({
  "name": "toy_chip",
  "chip": {
    "device": "toy",
    "estimated": true,
    "lut_inputs": 4,
    "register": {"delay_ps": 1},
    "gate": {"delay_ps": 2, "luts_pct": 25},
    "mux2": {"delay_ps": 3, "luts_pct": 50},
    "carry": {"delay_ps": 10, "delay_ps_per_bit": 2, "luts_pct": 110},
    "block": {"name": "M8", "width_a": 8, "width_b": 6, "reads_unsigned": true, "operand_registers": true,
              "product_registers": true, "stages": 2, "delay_ps": 7, "luts": 30}
  }
})json";

Library toy() {
  return Library::from_json(toy_json, "toy.json");
}

TEST(Chip, DelaysAndCellsFollowTheLaws) {
  const Library library = toy();
  const auto expect = [&](Component component, int bits, int delay_ps, const ChipCells& taken) {
    const Cell cell = library.cell(component, bits);
    EXPECT_EQ(cell.bits, bits);
    EXPECT_EQ(cell.delay_ps, delay_ps) << component_name(component);
    EXPECT_EQ(cell.taken, taken) << component_name(component);
    EXPECT_EQ(cell.area_um2, 0);
    EXPECT_EQ(cell.stages, component == Component::int_multiply ? 2 : 0);
    EXPECT_TRUE(cell.estimated);
  };
  expect(Component::latch, 9, 1, {0, 9, 0});
  expect(Component::gate, 9, 2, {3, 0, 0});
  expect(Component::mux2, 9, 3, {5, 0, 0});
  expect(Component::int_subtract, 20, 50, {22, 0, 0});
  expect(Component::int_compare, 7, 24, {8, 0, 0});
  expect(Component::int_multiply, 8, 7, {0, 0, 1});
  EXPECT_EQ(library.latch_delay_ps(), 1);
  EXPECT_EQ(library.gate_delay_ps(), 2);
  EXPECT_EQ(library.chip()->device, "toy");
  EXPECT_EQ(Library::thesis().chip(), nullptr);
}

TEST(Chip, ComparatorsMayHaveADelayOfTheirOwn) {
  std::string json(toy_json);
  const std::string delays = R"("delay_ps": 10, )";
  json.insert(json.find(delays) + delays.size(), R"("compare_delay_ps": 30, )");
  const Library library = Library::from_json(json, "toy.json");
  EXPECT_EQ(library.cell(Component::int_subtract, 20).delay_ps, 50);
  EXPECT_EQ(library.cell(Component::int_compare, 7).delay_ps, 44);
}

TEST(Chip, OnlyAFileThatSaysSoPacksRegisters) {
  EXPECT_FALSE(toy().chip()->packs_registers);
  std::string json(toy_json);
  const std::string inputs = R"("lut_inputs": 4,)";
  json.insert(json.find(inputs), R"("packs_registers": true, )");
  EXPECT_TRUE(Library::from_json(json, "toy.json").chip()->packs_registers);
}

std::string with_synthesis_targets() {
  std::string json(toy_json);
  const std::string name = R"("name": "toy_chip",)";
  return json.insert(json.find(name) + name.size(), R"(
  "fusesoc": {
    "synth": {"description": "For toys", "flow": "icestorm", "flow_options": {"pnr": "none", "list": ["-a", "b c"]}},
    "synth_2": {"description": "Another", "flow": "generic", "flow_options": {}}
  },)");
}

TEST(SynthesisTargets, AreThoseOfTheFile) {
  const Library library = Library::from_json(with_synthesis_targets(), "toy.json");
  ASSERT_EQ(library.synthesis_targets().size(), 2U);
  const SynthesisTarget& first = library.synthesis_targets().front();
  EXPECT_EQ(first.name, "synth");
  EXPECT_EQ(first.description, "For toys");
  EXPECT_EQ(first.flow, "icestorm");
  EXPECT_EQ(first.options, R"({"list":["-a","b c"],"pnr":"none"})");
  EXPECT_EQ(library.synthesis_targets().back().name, "synth_2");
}

TEST(SynthesisTargets, ALibraryOfAChipHasOneAndOthersHaveNone) {
  for (const std::string& name : built_in_names()) {
    const Library library = library_called(name);
    const auto& targets = library.synthesis_targets();
    const bool has_one = std::any_of(targets.begin(), targets.end(),
                                     [](const SynthesisTarget& target) { return target.name == "synth"; });
    EXPECT_EQ(has_one, library.chip() != nullptr) << name;
    EXPECT_TRUE(has_one || targets.empty()) << name;
  }
}

TEST(SynthesisTargets, BadEntriesRejected) {
  const std::string json = with_synthesis_targets();
  const std::string option = "must be a text, a number, true, false or a list of texts";
  expect_refusals(
      json, {{R"("synth_2")", R"("lint")",
              R"(fusesoc: target "lint", allowed are synth and what begins with it, of a-z, 0-9 and _)"},
             {R"("synth_2")", R"("synth: 2")",
              R"(fusesoc: target "synth: 2", allowed are synth and what begins with it, of a-z, 0-9 and _)"},
             {R"("Another")", R"("a\nb")", R"(fusesoc: synth_2: "description" must be one line)"},
             {R"("flow": "generic", )", "", R"(fusesoc: synth_2: "flow" is missing)"},
             {R"({}})", "7}", R"(fusesoc: synth_2: "flow_options" must be a JSON object)"},
             {R"("none")", "null", R"(fusesoc: synth: flow_options: "pnr" )" + option},
             {R"("none")", R"({"a": 1})", R"(fusesoc: synth: flow_options: "pnr" )" + option},
             {R"("b c")", "7", R"(fusesoc: synth: flow_options: "list" )" + option}});
}

TEST(Chip, BadEntriesRejected) {
  expect_refusals(
      toy_json,
      {{R"("block")", R"("other")", ""},  // a chip may have no block
       {R"("toy")", "7", R"(chip: "device" must be a text)"},
       {R"("toy")", R"("a\nb")", R"(chip: "device" must be one line)"},
       {"true", "1", R"(chip: "estimated" must be true or false)"},
       {R"("lut_inputs": 4)", R"("lut_inputs": 1)", R"(chip: "lut_inputs" is 1)" + range(2, 16)},
       {R"("gate")", R"("gates")", R"(chip: "gate" is missing)"},
       {R"("luts_pct": 25)", R"("luts_pct": 1001)", R"(chip: gate: "luts_pct" is 1001)" + range(0, 1000)},
       {R"({"delay_ps": 1})", "1", "chip: register: must be a JSON object"},
       {R"("delay_ps": 3)", R"("delay_ps": 0)", R"(chip: mux2: "delay_ps" is 0)" + range(1, 1000000)},
       {R"("delay_ps_per_bit": 2)", R"("delay_ps_per_bit": -2)",
        R"(chip: carry: "delay_ps_per_bit" is -2)" + range(0, 100000)},
       {R"("M8")", "8", R"(chip: block: "name" must be a text)"},
       {R"("width_a": 8)", R"("width_a": 5)", R"(chip: block: "width_a" is 5, less than "width_b" of 6)"},
       {R"("width_b": 6)", R"("width_b": 1)", R"(chip: block: "width_b" is 1)" + range(2, 64)},
       {R"("reads_unsigned": true)", R"("reads_unsigned": "yes")",
        R"(chip: block: "reads_unsigned" must be true or false)"},
       {R"("operand_registers")", R"("registers")", R"(chip: block: "operand_registers" is missing)"},
       {R"("stages": 2)", R"("stages": 0)", R"(chip: block: "stages" is 0)" + range(1, 64)},
       {R"("luts": 30)", R"("luts": -1)", R"(chip: block: "luts" is -1)" + range(0, 1000000)}});
}

}  // namespace
}  // namespace hitpipe::rtl::library_test
