// A chip as a component library: its laws, and the messages for a bad file.
#include "rtl_gen/component/chip.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::rtl::chip_test {
namespace {

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

std::string refusal_of_chip(std::string_view from, std::string_view to) {
  std::string text(toy_json);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return "";
  text.replace(at, from.size(), to);
  return message_of<std::runtime_error>([&] { static_cast<void>(Library::from_json(text, "toy.json")); });
}

TEST(Chip, MayHaveNoBlock) {
  const std::string text(toy_json);
  EXPECT_EQ(refusal_of_chip("\"block\"", "\"other\""), "no exception");
}

TEST(Chip, WrongEntriesRejected) {
  const auto range = [](const char* least, const char* most) {
    return std::string(", allowed are whole numbers from ") + least + " to " + most;
  };
  EXPECT_EQ(refusal_of_chip("\"toy\"", "7"), "toy.json: chip: \"device\" must be a text");
  EXPECT_EQ(refusal_of_chip("\"toy\"", "\"a\\nb\""), "toy.json: chip: \"device\" must be one line");
  EXPECT_EQ(refusal_of_chip("true", "1"), "toy.json: chip: \"estimated\" must be true or false");
  EXPECT_EQ(refusal_of_chip("\"lut_inputs\": 4", "\"lut_inputs\": 1"),
            "toy.json: chip: \"lut_inputs\" is 1" + range("2", "16"));
  EXPECT_EQ(refusal_of_chip("\"gate\"", "\"gates\""), "toy.json: chip: \"gate\" is missing");
  EXPECT_EQ(refusal_of_chip("\"luts_pct\": 25", "\"luts_pct\": 1001"),
            "toy.json: chip: gate: \"luts_pct\" is 1001" + range("0", "1000"));
  EXPECT_EQ(refusal_of_chip("{\"delay_ps\": 1}", "1"), "toy.json: chip: register: must be a JSON object");
  EXPECT_EQ(refusal_of_chip("\"delay_ps\": 3", "\"delay_ps\": 0"),
            "toy.json: chip: mux2: \"delay_ps\" is 0" + range("1", "1000000"));
  EXPECT_EQ(refusal_of_chip("\"delay_ps_per_bit\": 2", "\"delay_ps_per_bit\": -2"),
            "toy.json: chip: carry: \"delay_ps_per_bit\" is -2" + range("0", "100000"));
  EXPECT_EQ(refusal_of_chip("\"M8\"", "8"), "toy.json: chip: block: \"name\" must be a text");
  EXPECT_EQ(refusal_of_chip("\"width_a\": 8", "\"width_a\": 5"),
            "toy.json: chip: block: \"width_a\" is 5, less than \"width_b\" of 6");
  EXPECT_EQ(refusal_of_chip("\"width_b\": 6", "\"width_b\": 1"),
            "toy.json: chip: block: \"width_b\" is 1" + range("2", "64"));
  EXPECT_EQ(refusal_of_chip("\"reads_unsigned\": true", "\"reads_unsigned\": \"yes\""),
            "toy.json: chip: block: \"reads_unsigned\" must be true or false");
  EXPECT_EQ(refusal_of_chip("\"operand_registers\"", "\"registers\""),
            "toy.json: chip: block: \"operand_registers\" is missing");
  EXPECT_EQ(refusal_of_chip("\"stages\": 2", "\"stages\": 0"),
            "toy.json: chip: block: \"stages\" is 0" + range("1", "64"));
  EXPECT_EQ(refusal_of_chip("\"luts\": 30", "\"luts\": -1"),
            "toy.json: chip: block: \"luts\" is -1" + range("0", "1000000"));
}

}  // namespace
}  // namespace hitpipe::rtl::chip_test
