// The manifest is JSON and agrees with the graph, the schedule and the registers.
#include "rtl_gen/emit/manifest.hpp"

#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/rtl_gen/catalogue/formats.hpp"

namespace hitpipe::rtl::manifest_test {
namespace {

Json manifest_of(const DesignFormat& d) {
  return manifest(d.unit(), Library::thesis());
}

TEST(Manifest, NamesTheDesignItsConventionsAndItsPorts) {
  Json json = manifest_of({"int_slabs", "20/24"});
  Json expected = Json::parse(R"([
    {"name": "clk", "direction": "in", "width": 1, "signed": false},
    {"name": "rst", "direction": "in", "width": 1, "signed": false},
    {"name": "in_valid", "direction": "in", "width": 1, "signed": false},
    {"name": "in_ready", "direction": "out", "width": 1, "signed": false},
    {"name": "in_tag", "direction": "in", "width": "TAG_BITS", "signed": false},
    {"name": "out_valid", "direction": "out", "width": 1, "signed": false},
    {"name": "out_ready", "direction": "in", "width": 1, "signed": false},
    {"name": "out_tag", "direction": "out", "width": "TAG_BITS", "signed": false}])");
  for (const Port& port : find_design("int_slabs").ports(hls::IntBits{20, 24}))
    expected.push_back(
        {{"name", port.name}, {"direction", "in"}, {"width", port.width}, {"signed", port.is_signed}});
  expected.push_back({{"name", "hit"}, {"direction", "out"}, {"width", 1}, {"signed", false}});
  EXPECT_EQ(json.at("ports"), expected);
  json.erase("ports");
  json.erase("by_stage");
  EXPECT_EQ(json, Json::parse(R"({
    "design": "int_slabs", "kind": "box", "bits": "20/24", "module": "int_slabs", "license": "0BSD", "verilog": ["int_slabs.v"],
    "clock": "clk, rising edge", "reset": "rst, synchronous, active high, valid bits only", "flow_control": "stall",
    "handshake": "valid/ready; results in order; the whole pipeline waits for out_ready",
    "parameters": {"TAG_BITS": 16}, "results": [{"name": "hit", "meaning": "hit", "box": 0, "width": 1}],
    "stages": 4, "latency": 4, "clock_ps": 3176, "library": "thesis_250nm"})"));
}

TEST(Manifest, GivesStagesLatencyAndClock) {
  const struct {
    DesignFormat design;
    int stages, clock_ps;
  } cases[] = {{{"int_slabs", "24/24"}, 5, 3176},
               {{"int_slabs", "16/16"}, 4, 2776},
               {{"fp_slabs", "fp32"}, 13, 2876},
               {{"fp_plucker", "fp32"}, 20, 2876}};
  for (const auto& [design, stages, clock_ps] : cases) {
    const Json json = manifest_of(design);
    EXPECT_EQ(json.at("bits"), design.format);
    EXPECT_EQ(json.at("stages"), stages);
    EXPECT_EQ(json.at("latency"), stages);
    EXPECT_EQ(json.at("clock_ps"), clock_ps);
    EXPECT_EQ(json.at("by_stage").size(), static_cast<std::size_t>(stages) + 1);
  }
}

TEST(Manifest, CountsComponentsAndLatchesByStage) {
  EXPECT_EQ(manifest_of({"int_slabs", "24/24"}).at("by_stage"), Json::parse(R"([
    {"stage": 0, "components": {"latch_1": 1, "latch_24": 16}, "latch_bits": 385},
    {"stage": 1, "components": {"int_subtract_24": 6, "latch_1": 1, "latch_24": 13, "mux2_24": 12}, "latch_bits": 313},
    {"stage": 2, "components": {"int_multiply_24": 6, "latch_1": 1, "latch_24": 1}, "latch_bits": 25},
    {"stage": 3, "components": {"latch_1": 1, "latch_24": 1}, "latch_bits": 25},
    {"stage": 4, "components": {"latch_1": 1, "latch_24": 7}, "latch_bits": 169},
    {"stage": 5, "components": {"int_compare_24": 6, "latch_1": 1, "mux2_24": 4}, "latch_bits": 1}
  ])"));
  std::map<std::string, int> total;
  const Json plucker = manifest_of({"fp_plucker", "fp32"});
  for (const Json& stage : plucker.at("by_stage"))
    for (const auto& [component, count] : stage.at("components").items())
      total[component] += count.get<int>();
  for (const char* const component : {"fp_subtract_32", "fp_multiply_32", "fp_compare_32"})
    EXPECT_EQ(total[component], 12) << component;
}

TEST(Manifest, LatchBitsAreThePlacedRegisters) {
  for (const DesignFormat& d : every_design()) {
    int manifest_bits = 0;
    const Json json = manifest_of(d);
    for (const Json& stage : json.at("by_stage")) manifest_bits += stage.at("latch_bits").get<int>();
    int placed_bits = 0;
    for (const Register& r : d.pipeline().placement.registers) placed_bits += r.width();
    EXPECT_EQ(manifest_bits, placed_bits) << d;
    EXPECT_GT(placed_bits, 0);
  }
}

}  // namespace
}  // namespace hitpipe::rtl::manifest_test
