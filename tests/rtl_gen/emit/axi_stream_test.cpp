// The AXI4-Stream wrapper gives the design's own answers under every pattern of stalls, keeps the protocol,
// and leaves the design as it is.
#include "rtl_gen/emit/axi_stream.hpp"

#include <iostream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/axi_stream_bench.hpp"
#include "tests/rtl_gen/emit/wrapper.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::axi_stream_test {
namespace {

TEST(StreamFields, BeginOnByteBoundariesInPortOrder) {
  const std::vector<Port> ports{
      {"a", 20, true}, {"b", 8, false}, {"c", 1, false}, {"d", 63, true}, {"e", 9, true}};
  std::vector<std::string> layout;
  for (const StreamField& field : stream_fields(ports))
    layout.push_back(fmt::format("{} {}+{}", field.name, field.offset, field.width));
  EXPECT_EQ(layout, (std::vector<std::string>{"a 0+20", "b 24+8", "c 32+1", "d 40+63", "e 104+9"}));
  EXPECT_EQ(stream_bits(ports), 120);
}

class AxiStream : public testing::TestWithParam<DesignFormat> {};

TEST_P(AxiStream, AnswersAsTheDesignAndLeavesItAsItIs) {
  std::cout << "seed " << beat_seed << ", " << beat_count << " beats a mode\n";
  const ScratchFolder folder;
  const EmittedDesign with = GetParam().emitted({.axi_stream = true});
  expect_only_wrapper_added(GetParam().emitted(), with, "_axis", "axi_stream");
  EXPECT_EQ(with.manifest->at("axi_stream").at("module"), with.module + "_axis");
  EXPECT_EQ(with.manifest->at("axi_stream").at("file"), with.module + "_axis.v");
  host::write_files(folder.path(), with.files());
  const StreamBench bench(folder.path(), GetParam().found(), GetParam().parsed());
  for (const int mode : {1, 2, 3, 4, 5})
    EXPECT_THAT(bench.run(mode), testing::StartsWith(all_passed)) << "mode " << mode;
  EXPECT_EQ(bench.cycles(0), beat_count + with.manifest->at("latency").get<int>() + 1)
      << "a beat every cycle";
}

std::vector<DesignFormat> streamed_designs() {
  return every_design({"20/24", "6/11"}, {"6+0/4"}, {"e5m10"}, {"8+0/4s8"}, {"8+0s8", "8+0s8c2"});
}

INSTANTIATE_TEST_SUITE_P(Designs, AxiStream, testing::ValuesIn(streamed_designs()), design_suffix);

TEST(AxiStreamLint, IsSilent) {
  const ScratchFolder folder;
  std::vector<std::vector<std::string>> modules;
  for (const DesignFormat& d : streamed_designs()) {
    host::write_files(folder.path(), d.emitted({.axi_stream = true}).files());
    modules.push_back({d.module() + "_axis", d.module()});
  }
  expect_silent_tools(folder.path(), modules);
}

TEST(AxiStreamNames, AResultWithTheNameOfItsOwnRejected) {
  for (const std::string name : {"valid", "tag"}) {
    const ModuleInterface unit =
        unit_interface("unit", {{name, 4, false}}, {{name, 1, false}}, FlowControl::stall);
    EXPECT_EQ(message_of([&] { return axi_stream(unit); }),
              "unit: its port " + name + " has the name of one of unit_axis");
  }
  const ModuleInterface unit =
      unit_interface("unit", {{"tag", 4, false}}, {{"hit", 1, false}}, FlowControl::stall);
  EXPECT_EQ(message_of([&] { return axi_stream(unit); }), "no exception");
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
  const ScratchFolder folder;
  for (const auto& [good, bad] : damages) {
    host::write_files(folder.path(), d.emitted({.axi_stream = true}).files());
    damage(folder / "int_slabs_6_6_axis.v", good, bad);
    EXPECT_THAT(StreamBench(folder.path(), d.found(), d.parsed()).run(1), testing::StartsWith("FAIL")) << bad;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::axi_stream_test
