// The AXI4-Stream wrapper gives the design's own answers under every pattern of stalls, keeps the protocol,
// and leaves the design as it is.
#include "rtl_gen/emit/axi_stream.hpp"

#include <iostream>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/axi_stream_bench.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::axi_stream_test {
namespace {

std::vector<File> emitted(const DesignFormat& d, bool axi_stream) {
  return emit(d.found(), d.parsed(), Library::thesis(), d.pipeline(), {.axi_stream = axi_stream}).files();
}

const std::vector<Port>& mixed_ports() {
  static const std::vector<Port> ports{
      {"a", 20, true}, {"b", 8, false}, {"c", 1, false}, {"d", 63, true}, {"e", 9, true}};
  return ports;
}

TEST(StreamFields, BeginOnByteBoundariesInPortOrder) {
  std::vector<std::string> layout;
  for (const StreamField& field : stream_fields(mixed_ports()))
    layout.push_back(fmt::format("{} {}+{}", field.name, field.offset, field.width));
  EXPECT_EQ(layout, (std::vector<std::string>{"a 0+20", "b 24+8", "c 32+1", "d 40+63", "e 104+9"}));
  EXPECT_EQ(stream_bits(mixed_ports()), 120);
}

class AxiStream : public testing::TestWithParam<DesignFormat> {
 protected:
  void SetUp() override { host::write_files(folder.path(), emitted(GetParam(), true)); }
  ScratchFolder folder;
};

TEST_P(AxiStream, AnswersAsTheDesignUnderStalls) {
  std::cout << "seed " << beat_seed << ", " << beat_count << " beats a mode\n";
  const StreamBench bench(folder.path(), GetParam().found(), GetParam().parsed());
  for (const int mode : {1, 2, 3, 4, 5})
    EXPECT_THAT(bench.run(mode), testing::StartsWith(all_passed)) << "mode " << mode;
}

TEST_P(AxiStream, TakesABeatEveryCycleAtTheDesignsLatency) {
  const int stages = GetParam().pipeline().schedule.stages;
  EXPECT_EQ(StreamBench(folder.path(), GetParam().found(), GetParam().parsed()).run(0),
            fmt::format("{} in {} cycles", all_passed, beat_count + stages + 1));
}

TEST_P(AxiStream, LeavesTheOtherFilesAsTheyAre) {
  std::map<std::string, std::string> with;
  for (const File& file : emitted(GetParam(), true)) with[file.name] = file.contents;
  const std::string module = GetParam().module();
  EXPECT_EQ(with.erase(module + "_axis.v"), 1U);
  for (const File& file : emitted(GetParam(), false)) {
    const bool speaks_of_it = file.name == module + ".core" || file.name == module + ".json";
    EXPECT_EQ(with.at(file.name) == file.contents, !speaks_of_it) << file.name;
    with.erase(file.name);
  }
  EXPECT_TRUE(with.empty());
}

TEST_P(AxiStream, ManifestGivesTheFieldsOnlyWhenAsked) {
  const std::string module = GetParam().module();
  nlohmann::json with = nlohmann::json::parse(read_text(folder / (module + ".json")));
  nlohmann::json stream = with.at("axi_stream");
  with.erase("axi_stream");
  with.erase("files");
  for (const File& file : emitted(GetParam(), false)) {
    if (file.name == module + ".json") {
      nlohmann::json without = nlohmann::json::parse(file.contents);
      without.erase("files");
      EXPECT_EQ(with, without);
    }
  }
  int offset = 0;
  int result_bits = 0;
  nlohmann::json fields = nlohmann::json::array();
  for (const auto& port : with.at("ports")) {
    static const std::vector<std::string> handshake{"clk",    "rst",       "in_valid",  "in_ready",
                                                    "in_tag", "out_valid", "out_ready", "out_tag"};
    if (std::count(handshake.begin(), handshake.end(), port.at("name")) != 0) continue;
    const int width = port.at("width");
    if (port.at("direction") == "out") {
      result_bits += (width + 7) / 8 * 8;
      continue;
    }
    fields.push_back({{"name", port.at("name")}, {"offset", offset}, {"width", width}});
    offset += (width + 7) / 8 * 8;
  }
  EXPECT_EQ(stream.at("module"), module + "_axis");
  EXPECT_EQ(stream.at("file"), module + "_axis.v");
  EXPECT_EQ(stream.at("s_axis").at("fields"), fields);
  EXPECT_EQ(stream.at("s_axis").at("tdata_bits"), offset);
  EXPECT_EQ(stream.at("m_axis").at("tdata_bits"), result_bits);
  EXPECT_EQ(result_bits, GetParam().design == "int_major_pair" ? 120 : 8)
      << "HIT, or all that is told of two boxes";
}

std::vector<DesignFormat> streamed_designs() {
  return every_design({"24/24", "20/24", "6/11"});
}

INSTANTIATE_TEST_SUITE_P(Designs, AxiStream, testing::ValuesIn(streamed_designs()), design_suffix);

TEST(AxiStreamLint, IsSilent) {
  const ScratchFolder folder;
  std::vector<std::vector<std::string>> modules;
  for (const DesignFormat& d : streamed_designs()) {
    host::write_files(folder.path(), emitted(d, true));
    modules.push_back({d.module() + "_axis", d.module()});
  }
  expect_silent_tools(folder.path(), modules);
}

TEST(AxiStreamBench, DamagedWrappersFail) {
  const DesignFormat d{"int_slabs", "6/6"};
  const struct {
    const char *good, *bad;
  } damages[] = {{"spare_valid <= m_axis_tvalid & ~m_axis_tready", "spare_valid <= 1'b0"},
                 {".out_ready(~spare_valid)", ".out_ready(m_axis_tready)"},
                 {".out_ready(~spare_valid)", ".out_ready(1'b1)"},
                 {"if (~spare_valid) begin", "begin"},
                 {"m_axis_tvalid = spare_valid | out_valid",
                  "m_axis_tvalid = m_axis_tready & (spare_valid | out_valid)"},
                 {"if (~aresetn) spare_valid", "if (1'b0) spare_valid"},
                 {".irx(s_axis_tdata[5:0])", ".irx(s_axis_tdata[6:1])"},
                 {"m_axis_tid = spare_valid ? spare_tag", "m_axis_tid = spare_valid ? out_tag"}};
  for (const auto& [good, bad] : damages) {
    const ScratchFolder folder;
    host::write_files(folder.path(), emitted(d, true));
    std::string text = read_text(folder / "int_slabs_6_6_axis.v");
    const std::size_t at = text.find(good);
    ASSERT_NE(at, std::string::npos) << good;
    write_text(folder / "int_slabs_6_6_axis.v", text.replace(at, std::string(good).size(), bad));
    EXPECT_THAT(StreamBench(folder.path(), d.found(), d.parsed()).run(1), testing::StartsWith("FAIL")) << bad;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::axi_stream_test
