// The table agrees with the emitted Verilog. Yosys counts the register bits in a design's own module, without
// components; they are the latches, valid bits and tags of the account `built`.
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::area::yosys_test {
namespace {

int bits_found_by_yosys(const rtl::Design& design, rtl::Format format) {
  const host::ScratchFolder folder;
  const rtl::Pipeline pipeline = rtl::make_pipeline(design.trace(format), rtl::Library::thesis());
  rtl::write_text(folder / "design.v", rtl::to_verilog(pipeline, rtl::Library::thesis()));
  const std::string name(design.name);
  const rtl::ToolResult yosys = rtl::run_tool(folder.path(), "yosys", "yosys",
                                              "-p 'read_verilog design.v; hierarchy -check -top " + name +
                                                  "; proc; tee -o stat.txt stat -width " + name + "'");
  EXPECT_EQ(yosys.status, 0) << yosys.output;
  const std::string stat = rtl::read_text(folder / "stat.txt");
  const std::regex flop("\\$[a-z]*dff[a-z]*_([0-9]+) +([0-9]+)");
  int bits = 0;
  for (std::sregex_iterator at(stat.begin(), stat.end(), flop); at != std::sregex_iterator(); ++at) {
    bits += std::stoi((*at)[1]) * std::stoi((*at)[2]);
  }
  return bits;
}

TEST(BuiltAccount, HasTheRegisterBitsThatYosysFinds) {
  int designs = 0;
  for (const Entry& entry : table_7_2()) {
    const rtl::Design& design = rtl::find_design(entry.design);
    const Price built = price(design, entry.format, rtl::Library::thesis(), Account::built);
    int bits = 0;
    for (const Line& line : built.lines) {
      if (line.part.component == rtl::Component::latch) bits += line.n * line.part.bits;
    }
    EXPECT_EQ(bits_found_by_yosys(design, entry.format), bits)
        << entry.design << ' ' << to_string(entry.format);
    ++designs;
  }
  EXPECT_EQ(designs, 6);
}

}  // namespace
}  // namespace hitpipe::area::yosys_test
