// Targets are data. What is wrong with a file is one line.
#include "sim/implement/target.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::target_test {
namespace {

using testing::ElementsAre;

constexpr const char* small = R"({
  "name": "small", "chip": "A small chip", "library": "thesis_250nm", "synthesis": ["synth -top {top}"],
  "resources": {"logic_cells": {"packed": "LC", "available": 7}, "luts": {"cells": {"LUT[1-3]": 2}}},
  "place": {"options": ["--small"]}
})";

/// The file with one text in place of another.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = small;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& from, const std::string& to) {
  return message_of<std::runtime_error>(
      [&] { static_cast<void>(Target::from_json(changed(from, to), "small.json")); });
}

TEST(Target, IsReadFromItsFile) {
  const Target target = Target::from_json(small, "small.json");
  EXPECT_EQ(target.name, "small");
  EXPECT_EQ(target.chip, "A small chip");
  EXPECT_EQ(target.library, "thesis_250nm");
  EXPECT_THAT(target.synthesis, ElementsAre("synth -top {top}"));
  ASSERT_EQ(target.resources.size(), 2U);
  EXPECT_EQ(target.resources[0].name, "luts");
  EXPECT_THAT(target.resources[0].cells, ElementsAre(std::pair<std::string, int>("LUT[1-3]", 2)));
  EXPECT_FALSE(target.resources[0].available);
  EXPECT_EQ(target.resources[1].packed, "LC");
  EXPECT_EQ(target.resources[1].available, 7);
  ASSERT_TRUE(target.placement);
  EXPECT_THAT(*target.placement, ElementsAre("--small"));
  EXPECT_FALSE(target.models);
}

TEST(Target, EveryBuiltInOneIsGood) {
  EXPECT_THAT(target_names(), ElementsAre("ecp5", "ice40_hx", "ice40_up5k", "osu018", "xc7"));
  for (const std::string& name : target_names()) {
    const Target target = target_called(name);
    EXPECT_EQ(target.name, name);
    EXPECT_NO_THROW(static_cast<void>(rtl::library_called(target.library))) << name;
    EXPECT_NE(target.placement.has_value(), !target.not_placed.empty()) << name;
    EXPECT_EQ(target.liberty.empty(), target.package.empty()) << name;
  }
}

TEST(Target, IsAlsoReadFromAFileOfTheUser) {
  const TemporaryFolder folder;
  EXPECT_EQ(target_called(folder.write("mine.json", small).string()).name, "small");
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(target_called("/nowhere/mine.json")); }),
            "/nowhere/mine.json: cannot read the file");
}

TEST(Target, UnknownNameRejected) {
  EXPECT_EQ(
      message_of<std::runtime_error>([] { static_cast<void>(target_called("ice41")); }),
      "target ice41: unknown; there are ecp5, ice40_hx, ice40_up5k, osu018, xc7, and any file whose name "
      "ends in .json");
}

TEST(Target, WrongEntryRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(Target::from_json("{", "small.json")); }),
            "small.json: is not JSON");
  EXPECT_EQ(
      refusal("\"chip\"", "\"chop\""),
      "small.json: chop: unknown; allowed are name, chip, library, synthesis, files, resources, liberty, "
      "package, place, not_placed, models");
  EXPECT_EQ(refusal("\"A small chip\"", "3"), "small.json: chip: is not a text");
  EXPECT_EQ(refusal("\"small\"", "\"a/b\""), "small.json: name: is empty or has a slash, a blank or a point");
  EXPECT_EQ(refusal("[\"synth -top {top}\"]", "\"synth\""), "small.json: synthesis: is not a list of texts");
  EXPECT_EQ(refusal("\"luts\"", "\"lots\""),
            "small.json: resources: lots: unknown; allowed are luts, registers, dsps, rams, lut_rams, "
            "carries, logic_cells");
  EXPECT_EQ(refusal("\"available\": 7", "\"available\": -7"),
            "small.json: resources: logic_cells: available: is not a whole number from 0 to 10^9");
  EXPECT_EQ(refusal("\"packed\": \"LC\", ", ""),
            "small.json: resources: logic_cells: has either cells or packed");
  EXPECT_EQ(refusal("\"LUT[1-3]\": 2", "\"LUT[1-3]\": 0.5"),
            "small.json: resources: luts: cells: LUT[1-3]: is not a whole number from 0 to 10^9");
  EXPECT_EQ(refusal(",\n  \"place\": {\"options\": [\"--small\"]}", ""),
            "small.json: has either place or not_placed");
  EXPECT_EQ(refusal("\"options\"", "\"option\""), "small.json: place: option: unknown; allowed are options");
}

TEST(Target, LongWordsAreCutInMessages) {
  const std::string word(1000, 'x');
  const std::string cut = std::string(50, 'x') + "... (1000 bytes)";
  EXPECT_EQ(refusal("\"options\"", "\"" + word + "\""),
            "small.json: place: " + cut + ": unknown; allowed are options");
  EXPECT_EQ(refusal("\"LUT[1-3]\": 2", "\"" + word + "\": 0.5"),
            "small.json: resources: luts: cells: " + cut + ": is not a whole number from 0 to 10^9");
  EXPECT_EQ(refusal("\"place\"", "\"files\": {\"" + word + "\": 3}, \"place\""),
            "small.json: files: " + cut + ": is not a text");
  EXPECT_EQ(
      message_of<std::runtime_error>([&] { static_cast<void>(target_called(word)); }),
      "target " + cut +
          ": unknown; there are ecp5, ice40_hx, ice40_up5k, osu018, xc7, and any file whose name ends in "
          ".json");
}

}  // namespace
}  // namespace hitpipe::sim::target_test
