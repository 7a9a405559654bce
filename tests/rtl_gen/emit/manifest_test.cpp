// The manifest is JSON and agrees with the graph, the schedule and the registers.
#include "rtl_gen/emit/manifest.hpp"

#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"

namespace hitpipe::rtl::manifest_test {
namespace {

struct Emitted {
  explicit Emitted(const DesignFormat& d)
      : pipeline(d.pipeline()),
        json(manifest(d.found(), d.parsed(), d.interface(), pipeline, Library::thesis())) {}
  explicit Emitted(hls::IntBits bits) : Emitted(DesignFormat{"int_slabs", to_string(Format(bits))}) {}
  Pipeline pipeline;
  Json json;
};

TEST(Manifest, NamesTheDesignAndItsConventions) {
  const Json json = Emitted({20, 24}).json;
  EXPECT_EQ(json.at("design"), "int_slabs");
  EXPECT_EQ(json.at("kind"), "box");
  EXPECT_EQ(json.at("bits"), "20/24");
  EXPECT_EQ(json.at("module"), "int_slabs");
  EXPECT_EQ(json.at("verilog"), Json::array({"int_slabs.v"}));
  EXPECT_EQ(json.at("clock"), "clk, rising edge");
  EXPECT_EQ(json.at("reset"), "rst, synchronous, active high, valid bits only");
  EXPECT_EQ(json.at("handshake"), "valid/ready; results in order; the whole pipeline waits for out_ready");
  EXPECT_EQ(json.at("parameters"), Json({{"TAG_BITS", 16}}));
  EXPECT_EQ(json.at("library"), "thesis_250nm");
}

TEST(Manifest, GivesStagesLatencyAndClock) {
  const struct {
    hls::IntBits bits;
    int stages, clock_ps;
  } formats[] = {{{24, 24}, 5, 3176}, {{20, 24}, 4, 3176}, {{16, 16}, 4, 2776}};
  for (const auto& f : formats) {
    const Json json = Emitted(f.bits).json;
    EXPECT_EQ(json.at("stages"), f.stages);
    EXPECT_EQ(json.at("latency"), f.stages);
    EXPECT_EQ(json.at("clock_ps"), f.clock_ps);
    EXPECT_EQ(json.at("by_stage").size(), static_cast<std::size_t>(f.stages) + 1);
  }
}

TEST(Manifest, PortsAreTheHandshakesAndTheGraphs) {
  const Emitted emitted({20, 24});
  Json expected = Json::array();
  const auto add = [&](const std::string& name, const char* direction, const Json& width, bool is_signed) {
    expected.push_back({{"name", name}, {"direction", direction}, {"width", width}, {"signed", is_signed}});
  };
  add("clk", "in", 1, false);
  add("rst", "in", 1, false);
  add("in_valid", "in", 1, false);
  add("in_ready", "out", 1, false);
  add("in_tag", "in", "TAG_BITS", false);
  add("out_valid", "out", 1, false);
  add("out_ready", "in", 1, false);
  add("out_tag", "out", "TAG_BITS", false);
  const std::vector<Port> ports = input_ports(emitted.pipeline.graph);
  ASSERT_EQ(ports.size(), 17U);
  for (const Port& port : ports) add(port.name, "in", port.width, port.is_signed);
  add("hit", "out", 1, false);
  EXPECT_EQ(emitted.json.at("ports"), expected);
}

TEST(Manifest, CountsComponentsAndLatchesByStage) {
  EXPECT_EQ(Emitted({24, 24}).json.at("by_stage"), Json::parse(R"([
    {"stage": 0, "components": {"latch_1": 1, "latch_24": 16}, "latch_bits": 385},
    {"stage": 1, "components": {"int_subtract_24": 6, "latch_1": 1, "latch_24": 13, "mux2_24": 12}, "latch_bits": 313},
    {"stage": 2, "components": {"int_multiply_24": 6, "latch_1": 1, "latch_24": 1}, "latch_bits": 25},
    {"stage": 3, "components": {"latch_1": 1, "latch_24": 1}, "latch_bits": 25},
    {"stage": 4, "components": {"latch_1": 1, "latch_24": 7}, "latch_bits": 169},
    {"stage": 5, "components": {"int_compare_24": 6, "latch_1": 1, "mux2_24": 4}, "latch_bits": 1}
  ])"));
}

TEST(Manifest, OfAFloatDesignSaysBinary32) {
  const struct {
    const char* design;
    int stages, subtract, multiply, compare;
  } designs[] = {{"fp_slabs", 13, 6, 6, 6}, {"fp_plucker", 20, 12, 12, 12}};
  for (const auto& d : designs) {
    const Json json = Emitted(DesignFormat{d.design, "fp32"}).json;
    EXPECT_EQ(json.at("bits"), "fp32");
    EXPECT_EQ(json.at("latency"), d.stages);
    EXPECT_EQ(json.at("clock_ps"), 2876);
    std::map<std::string, int> total;
    for (const Json& stage : json.at("by_stage")) {
      for (const auto& [component, count] : stage.at("components").items())
        total[component] += count.get<int>();
    }
    EXPECT_EQ(total["fp_subtract_32"], d.subtract);
    EXPECT_EQ(total["fp_multiply_32"], d.multiply);
    EXPECT_EQ(total["fp_compare_32"], d.compare);
    for (const Json& port : json.at("ports")) {
      if (port.at("name") == "xmin") {
        EXPECT_EQ(port.at("width"), 32);
      }
    }
  }
}

TEST(Manifest, SpeaksOfAxiStreamOnlyWhenAsked) {
  const Emitted emitted({20, 24});
  EXPECT_FALSE(emitted.json.contains("axi_stream"));
  const EmittedDesign with = emit(find_design("int_slabs"), hls::IntBits{20, 24}, Library::thesis(),
                                  emitted.pipeline, {.axi_stream = true});
  EXPECT_EQ(with.manifest->at("axi_stream").at("module"), "int_slabs_axis");
  EXPECT_EQ(with.manifest->at("axi_stream").at("s_axis").at("tdata_bits"), 392);
}

class ManifestOfADesign : public testing::TestWithParam<DesignFormat> {};

TEST_P(ManifestOfADesign, LatchBitsAreThePlacedRegisters) {
  const Emitted emitted(GetParam());
  int manifest_bits = 0;
  for (const Json& stage : emitted.json.at("by_stage")) manifest_bits += stage.at("latch_bits").get<int>();
  int placed_bits = 0;
  for (const Register& r : emitted.pipeline.placement.registers) placed_bits += r.width();
  EXPECT_EQ(manifest_bits, placed_bits);
  EXPECT_GT(placed_bits, 0);
}

INSTANTIATE_TEST_SUITE_P(Designs, ManifestOfADesign, testing::ValuesIn(every_design()), design_suffix);

}  // namespace
}  // namespace hitpipe::rtl::manifest_test
