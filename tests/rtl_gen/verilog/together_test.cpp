// Two formats of a design, and two designs, are elaborated together: no module is defined twice.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::together_test {
namespace {

/// A module that instantiates the wrappers of both units, with every port on a port of its own.
std::string top_of_both(const std::vector<EmittedDesign>& units,
                        const std::vector<std::vector<int>>& widths) {
  std::string ports;
  std::string instances;
  for (std::size_t i = 0; i < units.size(); ++i) {
    ports += fmt::format(
        ",\n  input wire s_valid_{0}, output wire s_ready_{0}, input wire [{1}:0] s_data_{0},\n"
        "  input wire [15:0] s_id_{0}, output wire m_valid_{0}, input wire m_ready_{0},\n"
        "  output wire [{2}:0] m_data_{0}, output wire [15:0] m_id_{0}",
        i, widths[i][0] - 1, widths[i][1] - 1);
    instances += fmt::format(
        "  {1}_axis unit_{0} (.aclk(clk), .aresetn(rst_n), .s_axis_tvalid(s_valid_{0}),\n"
        "    .s_axis_tready(s_ready_{0}), .s_axis_tdata(s_data_{0}), .s_axis_tid(s_id_{0}),\n"
        "    .m_axis_tvalid(m_valid_{0}), .m_axis_tready(m_ready_{0}), .m_axis_tdata(m_data_{0}),\n"
        "    .m_axis_tid(m_id_{0}));\n",
        i, units[i].module);
  }
  return fmt::format("module both (\n  input wire clk, input wire rst_n{}\n);\n{}endmodule\n", ports,
                     instances);
}

class Together : public testing::TestWithParam<std::pair<DesignFormat, DesignFormat>> {};

TEST_P(Together, VerilatorAndYosysAreSilent) {
  const ScratchFolder folder;
  std::vector<EmittedDesign> units;
  std::vector<std::vector<int>> widths;
  std::string files = "both.v";
  for (const DesignFormat& d : {GetParam().first, GetParam().second}) {
    units.push_back(d.emitted({.axi_stream = true}));
    host::write_files(folder.path(), units.back().files());
    widths.push_back(
        {stream_bits(d.found().ports(d.parsed())), stream_bits(result_ports(d.found().results(d.parsed())))});
    files += fmt::format(" {0}.v {0}_axis.v", units.back().module);
  }
  write_text(folder / "both.v", top_of_both(units, widths));
  const ToolResult lint =
      run_tool(folder.path(), "verilator", "verilator", "--lint-only -Wall --top-module both " + files);
  EXPECT_EQ(lint.status, 0);
  EXPECT_EQ(lint.output, "");
  const ToolResult yosys =
      run_tool(folder.path(), "yosys", "yosys",
               "-q -p 'read_verilog " + files + "; hierarchy -check -top both; proc; check -assert'");
  EXPECT_EQ(yosys.status, 0);
  EXPECT_EQ(yosys.output, "");
}

INSTANTIATE_TEST_SUITE_P(
    Units, Together,
    testing::Values(std::pair{DesignFormat{"int_slabs", "20/24"}, DesignFormat{"int_slabs", "16/16"}},
                    std::pair{DesignFormat{"fp_slabs", "fp32"}, DesignFormat{"fp_plucker", "fp32"}},
                    std::pair{DesignFormat{"int_major", "20+1/13"},
                              DesignFormat{"int_major_pair", "20+1/13"}}),
    [](const auto& units) { return units.param.first.module() + "_and_" + units.param.second.module(); });

}  // namespace
}  // namespace hitpipe::rtl::together_test
