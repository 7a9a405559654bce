// What is emitted of a design with several results: the testbench compares each of them, the wrapper streams
// them, and the manifest lists them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/emit/axi_stream_bench.hpp"
#include "tests/rtl_gen/emit/two_boxes.hpp"
#include "tests/rtl_gen/emit/vector_lines.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::several_results_test {
namespace {

using json = Json;

class SeveralResults : public testing::Test {
 protected:
  void SetUp() override { write(format); }
  void write(const Format& at) const {
    const Pipeline pipeline = make_pipeline(design.trace(at), Library::thesis());
    host::write_files(folder.path(),
                      emit(make_unit(design, at, Library::thesis(), pipeline), {.axi_stream = true}).files());
  }
  [[nodiscard]] std::string replayed() const {
    const ToolResult compiled =
        run_tool(folder / "tb", "iverilog", "iverilog", "-g2012 -Wall -o tb two_boxes_tb.sv ../two_boxes.v");
    EXPECT_EQ(compiled.output, "");
    return run_tool(folder / "tb", "iverilog", "vvp", "-n tb").output;
  }
  void flip(int vector, int bit) const {
    write_text(folder / vectors_file, with_bit_inverted(read_text(folder / vectors_file), vector, bit));
  }

  static constexpr const char* vectors_file = "tb/two_boxes_vectors.hex";
  const Design design = two_boxes();
  const Format format = design.default_format;
  const ScratchFolder folder;
};

TEST_F(SeveralResults, OfTheEmittedDesignPass) {
  EXPECT_THAT(replayed(), testing::HasSubstr("PASS 1000 vectors"));
}

TEST_F(SeveralResults, AreAllComparedByTheTestbench) {
  int bits = 0;
  for (const hls::Result& result : design.results(format)) bits += result.width;
  ASSERT_EQ(bits, 8);
  for (int bit = 0; bit < bits; ++bit) {
    flip(700, bit);
    EXPECT_THAT(replayed(), testing::HasSubstr("FAIL vector 700 (")) << bit;
    flip(700, bit);
  }
  EXPECT_THAT(replayed(), testing::HasSubstr("PASS 1000 vectors"));
}

TEST_F(SeveralResults, LintIsSilent) {
  for (const char* const bits : {"6/6", "16/16"}) {
    write(design.parse_format(bits));
    const std::string module = design.module_at(design.parse_format(bits));
    expect_silence(folder.path(), "verilator", "--lint-only -Wall " + module + ".v");
    expect_silence(folder.path(), "verilator",
                   fmt::format("--lint-only -Wall --top-module {0}_axis {0}_axis.v {0}.v", module));
  }
}

TEST_F(SeveralResults, AreStreamedOnByteBoundaries) {
  const StreamBench bench(folder.path(), design, format);
  for (const int mode : {0, 1, 2, 3})
    EXPECT_THAT(bench.run(mode), testing::StartsWith(all_passed)) << "mode " << mode;
}

TEST_F(SeveralResults, AreAllComparedByTheBenchOfTheWrapper) {
  const std::string whole = read_text(folder / "two_boxes_axis.v");
  for (const char* const name : {"entry", "hit_a", "hit_b"}) {
    write_text(folder / "two_boxes_axis.v", replaced(whole, fmt::format("? spare_{0} : out_{0}", name),
                                                     fmt::format("? ~spare_{0} : ~out_{0}", name)));
    EXPECT_THAT(StreamBench(folder.path(), design, format).run(1), testing::StartsWith("FAIL wrong result"))
        << name;
  }
}

TEST_F(SeveralResults, AreInTheManifest) {
  const json manifest = json::parse(read_text(folder / "two_boxes.json"));
  EXPECT_EQ(manifest.at("results"), json::parse(R"([
    {"name": "entry", "meaning": "entry", "box": 0, "width": 6},
    {"name": "hit_a", "meaning": "hit", "box": 0, "width": 1},
    {"name": "hit_b", "meaning": "hit", "box": 1, "width": 1}])"));
  EXPECT_EQ(manifest.at("axi_stream").at("m_axis"), json::parse(R"({"tdata_bits": 24, "fields": [
    {"name": "entry", "offset": 0, "width": 6},
    {"name": "hit_a", "offset": 8, "width": 1},
    {"name": "hit_b", "offset": 16, "width": 1}]})"));
  std::vector<json> outputs;
  for (const json& port : manifest.at("ports"))
    if (port.at("direction") == "out") outputs.push_back(port);
  ASSERT_EQ(outputs.size(), 6U);
  EXPECT_EQ(outputs[3], json::parse(R"({"name": "entry", "direction": "out", "width": 6, "signed": true})"));
  EXPECT_EQ(outputs[5], json::parse(R"({"name": "hit_b", "direction": "out", "width": 1, "signed": false})"));
}

TEST_F(SeveralResults, HaveTheLastOneInTheLowBitsOfAVector) {
  const std::vector<hls::Result> results{{"far", hls::Meaning::exit, 0, 5, true},
                                         {"hit", hls::Meaning::hit, 0, 1, false},
                                         {"near", hls::Meaning::entry, 0, 2, true}};
  const std::vector<Port> ports{{"a", 4, false}};
  // 1001 11101 1 10, and 0110 00011 0 01.
  EXPECT_EQ(vector_file(ports, ports, results, {{{9}, {-3, 1, -2}}, {{6}, {3, 0, 1}}}), "9ee\n619\n");
}

TEST_F(SeveralResults, OfADesignWithoutHitOfTheFirstBoxAreRefused) {
  EXPECT_THROW((void)place_of_hit(std::vector<hls::Result>{{"hit", hls::Meaning::hit, 1, 1, false},
                                                           {"near", hls::Meaning::entry, 0, 2, true}}),
               std::invalid_argument);
  EXPECT_EQ(place_of_hit(design.results(format)), 1U);
  EXPECT_EQ(design.kind.objects, 2);
}

TEST_F(SeveralResults, AreThoseOfTheKind) {
  const auto refused = [&](const hls::DesignKind& kind) {
    Design other = design;
    other.kind = kind;
    return message_of<std::invalid_argument>([&] { check_kind(other); });
  };
  EXPECT_EQ(refused(hls::box_kind),
            "design two_boxes is of kind box: its result hit_b is of number 1, a test answers for 1");
  EXPECT_EQ(refused(hls::pair_kind),
            "design two_boxes is of kind pair: it needs the result exit of number 0");
  EXPECT_EQ(refused({"far", 2, hls::meanings(hls::Meaning::hit), hls::meanings(hls::Meaning::order)}),
            "design two_boxes is of kind far: it needs the result order of number 0");
  EXPECT_EQ(refused({"near", 2, hls::meanings(hls::Meaning::hit, hls::Meaning::entry), hls::meanings()}),
            "design two_boxes is of kind near: it needs the result entry of number 1");
  check_kind(design);
  EXPECT_FALSE(design.kind == hls::pair_kind);
  EXPECT_TRUE(find_design("int_major_pair").kind == hls::pair_kind);
}

}  // namespace
}  // namespace hitpipe::rtl::several_results_test
