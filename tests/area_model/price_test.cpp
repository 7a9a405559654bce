// Sums, stages and the library behind a price.
#include "area_model/price.hpp"

#include <map>
#include <regex>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "area_model/figure.hpp"
#include "host/files.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::area::price_test {
namespace {

using rtl::DesignFormat;
using rtl::Library;

Price price_of(const DesignFormat& d, Account account, const Library& library = Library::thesis()) {
  return price(d.found(), d.parsed(), library, account);
}

class EveryDesign : public testing::TestWithParam<DesignFormat> {};

TEST_P(EveryDesign, StagesAddUpToTheTotal) {
  for (const Account account : {Account::built, Account::printed}) {
    if (account == Account::printed && GetParam().found().printed.rows.empty()) continue;
    const Price p = price_of(GetParam(), account);
    ASSERT_EQ(p.by_stage.size(), static_cast<std::size_t>(p.stages) + 1);
    std::map<Part, Line> sums;
    std::int64_t area_um2 = 0;
    for (const StagePrice& stage : p.by_stage) {
      std::int64_t of_lines = 0;
      for (const Line& line : stage.lines) {
        of_lines += line.area_um2;
        sums[line.part].n += line.n;
        sums[line.part].area_um2 += line.area_um2;
      }
      EXPECT_EQ(stage.area_um2, of_lines) << "stage " << stage.stage;
      area_um2 += stage.area_um2;
    }
    ASSERT_EQ(sums.size(), p.lines.size());
    std::int64_t of_lines = 0;
    for (const Line& line : p.lines) {
      EXPECT_EQ(line.n, sums[line.part].n) << part_name(line.part);
      EXPECT_EQ(line.area_um2, sums[line.part].area_um2) << part_name(line.part);
      of_lines += line.area_um2;
    }
    EXPECT_EQ(area_um2, of_lines);
    if (account == Account::built) {
      EXPECT_EQ(p.area_um2, area_um2);
    }
  }
}

TEST_P(EveryDesign, BuiltLatchesAreTheRegistersPlaced) {
  const rtl::Pipeline pipeline = GetParam().pipeline();
  int registers = 0;
  for (const Line& line : price_of(GetParam(), Account::built).lines) {
    if (line.part.component != rtl::Component::latch) continue;
    if (line.part.purpose == Purpose::datapath) {
      registers += line.n;
    } else {
      EXPECT_EQ(line.n, pipeline.schedule.stages + 1) << part_name(line.part);
    }
  }
  EXPECT_EQ(registers, static_cast<int>(pipeline.placement.registers.size()));
}

INSTANTIATE_TEST_SUITE_P(Designs, EveryDesign, testing::ValuesIn(rtl::every_design()), rtl::design_suffix);

// Inputs: 15 words of 20 bits, irlen of 24, rinf, valid bit and tag.
TEST(Built, IntSlabs2024InputLatches) {
  const Price p = price_of({"int_slabs", "20/24"}, Account::built);
  EXPECT_EQ(p.by_stage[0].area_um2, 15 * 1670 + 2004 + 84 + 84 + 1336);
  EXPECT_EQ(p.stages, 4);
  EXPECT_EQ(p.stage_delay_ps, 3176);
  EXPECT_EQ(p.latency_ps(), 12704);
  EXPECT_EQ(p.boxes, 1);
  EXPECT_EQ(p.area_per_box_um2(), p.area_um2);
  EXPECT_EQ(p.area_delay_per_box(), p.area_um2 * 3176);
}

TEST(Built, AreasOfTheSixDesigns) {
  const char* const areas[] = {"1.9484", "3.7323", "1.0175", "0.7167", "1.9526", "1.3758"};
  for (std::size_t i = 0; i < table_7_2().size(); ++i) {
    const Entry& entry = table_7_2()[i];
    const Price p = price(rtl::find_design(entry.design), entry.format, Library::thesis(), Account::built);
    EXPECT_EQ(area_mm2(p.area_um2), areas[i]) << entry.design << ' ' << to_string(entry.format);
  }
}

/// Two boxes a test: half of the area, and of area times delay, is for each.
TEST(Built, APairCountsTwoBoxes) {
  const Price p = price_of({"int_major_pair", "20+1/12"}, Account::built);
  EXPECT_EQ(p.boxes, 2);
  EXPECT_EQ(p.area_per_box_um2(), (p.area_um2 + 1) / 2);
  EXPECT_EQ(p.area_delay_per_box(), (p.area_um2 * p.stage_delay_ps + 1) / 2);
  EXPECT_EQ(adp_mm2_ns(p), decimal(p.area_um2 * p.stage_delay_ps, 2'000'000'000, 3));
  const Price one = price_of({"int_major", "20+1/12"}, Account::built);
  EXPECT_EQ(one.boxes, 1);
  EXPECT_GT(p.area_um2, one.area_um2);
  EXPECT_LT(p.area_per_box_um2(), one.area_um2) << "the boxes of a pair share the ray";
}

TEST(Price, RoundsWhatIsForEachBox) {
  Price p{.design = "toy",
          .format = hls::IntBits{6, 6},
          .lines = {},
          .by_stage = {},
          .area_um2 = 7,
          .stage_delay_ps = 3};
  EXPECT_EQ(p.area_per_box_um2(), 7);
  p.boxes = 2;
  EXPECT_EQ(p.area_per_box_um2(), 4);
  EXPECT_EQ(p.area_delay_per_box(), 11);
}

TEST(Estimated, IsWhatTheLibraryDoesNotList) {
  std::vector<std::string> estimated;
  for (const Line& line : price_of({"int_plucker", "20/24"}, Account::built).lines)
    if (line.estimated) estimated.push_back(part_name(line.part));
  EXPECT_EQ(estimated,
            (std::vector<std::string>{"int_subtract_25", "int_compare_20", "int_compare_25", "tag_16"}));
}

/// 3 um2 for each bit of a latch with an enable, where the latch without has 1.
TEST(Built, AUnitThatStallsHasEnablesWhereTheLibraryHasThem) {
  std::string json(rtl::unit_json);
  json.insert(json.rfind("\n  }"), R"(,
    "latch_enable": {"above": "same", "area": "linear", "cells": [
      {"bits": 1, "area_um2": 3, "delay_ps": 1, "stages": 0}]})");
  const Library with = Library::from_json(json, "with.json");
  const DesignFormat d{"int_slabs", "12/12"};
  const auto at = [&](const Library& library, rtl::FlowControl flow) {
    return price(d.found(), d.parsed(), library, Account::built, flow);
  };
  const auto bits_of = [](const Price& p, rtl::Component component) {
    int bits = 0;
    for (const Line& line : p.lines)
      if (line.part.component == component) bits += line.n * line.part.bits;
    return bits;
  };
  const Price none = at(with, rtl::FlowControl::none);
  const Price stall = at(with, rtl::FlowControl::stall);
  const int registers = bits_of(none, rtl::Component::latch);
  EXPECT_GT(registers, 500);
  EXPECT_EQ(bits_of(none, rtl::Component::latch_enable), 0);
  EXPECT_EQ(bits_of(stall, rtl::Component::latch), 0);
  EXPECT_EQ(bits_of(stall, rtl::Component::latch_enable), registers);
  EXPECT_EQ(stall.area_um2, none.area_um2 + 2 * registers);
  EXPECT_EQ(stall.stage_delay_ps, none.stage_delay_ps);
  EXPECT_EQ(price_of(d, Account::built, with).area_um2, stall.area_um2) << "stall is the default";
  for (const auto flow : {rtl::FlowControl::stall, rtl::FlowControl::none})
    EXPECT_EQ(at(rtl::unit_library(), flow).area_um2, none.area_um2) << "both cost what a latch costs";
}

/// The lines of a unit of 12/12 bits, fitted to these demands, in the unit library.
struct Fitted {
  Fitted(const char* name, const rtl::Demands& demands) {
    const rtl::Design& design = rtl::find_design(name);
    const hls::IntBits bits{12, 12};
    const rtl::Graph graph = rtl::prune(design.trace(bits), demands, {.shares = false}).graph;
    const Price p = price(rtl::make_pipeline(graph, rtl::unit_library()), design, bits, rtl::unit_library());
    for (const Line& line : p.lines) lines.emplace(part_name(line.part), line);
    area_um2 = p.area_um2;
  }
  std::map<std::string, Line> lines;
  std::int64_t area_um2 = 0;
};

// In um2 at 12/12 bits: a latch, mux and subtractor 12, a comparator 6, a multiplier 12 x 12.
TEST(UnitLibrary, IsAddedInTheHead) {
  const Price p = price_of({"int_slabs", "12/12"}, Account::built, rtl::unit_library());
  EXPECT_EQ(p.stage_delay_ps, 11);
  std::map<std::string, Line> lines;
  std::int64_t sum = 0;
  for (const Line& line : p.lines) {
    lines.emplace(part_name(line.part), line);
    sum += line.area_um2;
  }
  EXPECT_EQ(p.area_um2, sum);
  EXPECT_EQ(lines.at("int_multiply_12").n, 6);
  EXPECT_EQ(lines.at("int_multiply_12").area_um2, 6 * 144);
  EXPECT_EQ(lines.at("int_subtract_12").area_um2, 6 * 12);
  EXPECT_EQ(lines.at("int_compare_12").area_um2, 6 * 6);
  EXPECT_EQ(lines.at("mux2_12").area_um2, 16 * 12);
  EXPECT_EQ(lines.at("latch_12").area_um2, lines.at("latch_12").n * 12);
  EXPECT_EQ(lines.at("tag_16").area_um2, (p.stages + 1) * 16);
}

// Planes and origin of y within +-15: differences of 6 bits times IRDVCs of 12, 6 x 12 partial products.
TEST(UnitLibrary, MultipliesByNarrowerOperandsInTheirPartOfTheSquare) {
  const Fitted narrow("int_slabs", {{{"iry", {{-15, 15}}}, {"iymin", {{-15, 15}}}, {"iymax", {{-15, 15}}}}});
  EXPECT_EQ(narrow.lines.at("int_multiply_12").n, 4);
  EXPECT_EQ(narrow.lines.at("int_multiply_12x6").n, 2);
  EXPECT_EQ(narrow.lines.at("int_multiply_12x6").area_um2, 2 * 6 * 12);
  EXPECT_TRUE(narrow.lines.at("int_multiply_12x6").estimated);
}

// The low three bits of y's planes and origin are 0, so multipliers, subtractors and latches leave them out.
TEST(UnitLibrary, CoarseAxesCostLess) {
  for (const char* const name : {"int_slabs", "int_plucker"}) {
    const std::vector<rtl::Interval> all{{-2047, 2047}};
    const Fitted fine(name, {{{"iry", all}, {"iymin", all}, {"iymax", all}}});
    const Fitted coarse(name, {{{"iry", all, 3}, {"iymin", all, 3}, {"iymax", all, 3}}});
    EXPECT_LT(coarse.area_um2, fine.area_um2) << name;
    EXPECT_EQ(coarse.lines.at("int_subtract_9").n, 2) << name;
    EXPECT_EQ(coarse.lines.at("int_multiply_12x9").n, name == std::string("int_slabs") ? 2 : 4) << name;
    EXPECT_LT(coarse.lines.at("latch_12").n, fine.lines.at("latch_12").n) << name;
  }
}

TEST(PriceOfAPipeline, IsThatOfTheDesignItComesFrom) {
  for (const DesignFormat& d : rtl::every_design()) {
    const Price whole = price_of(d, Account::built);
    const Price same = price(d.pipeline(), d.found(), d.parsed(), Library::thesis());
    EXPECT_EQ(same.area_um2, whole.area_um2);
    EXPECT_EQ(same.area_delay_per_box(), whole.area_delay_per_box());
    EXPECT_EQ(same.by_stage.size(), whole.by_stage.size());
    // An n/t design that is not fitted multiplies operands of one width.
    if (!d.parsed().is<hls::IntBits>()) continue;
    for (const Line& line : whole.lines) EXPECT_EQ(line.part.by, 0) << part_name(line.part);
  }
}

TEST(UnitLibrary, HasNoFloatsToCompareWith) {
  EXPECT_TRUE(can_price_baseline(Library::thesis()));
  EXPECT_FALSE(can_price_baseline(rtl::unit_library()));
  EXPECT_EQ(message_of([] {
              return price_of({"fp_slabs", "fp32"}, Account::built, rtl::unit_library());
            }),
            "library unit: it has no fp_subtract");
}

TEST(Decimal, RoundsHalvesUp) {
  const struct {
    std::int64_t dividend, divisor;
    int digits;
    const char* text;
  } cases[] = {{0, 7, 0, "0"},
               {1, 2, 0, "1"},
               {49, 100, 0, "0"},
               {2, 3, 4, "0.6667"},
               {1'008'976, 1'000'000, 4, "1.0090"},
               {999'950, 1'000'000, 4, "1.0000"},
               {999'949, 1'000'000, 4, "0.9999"},
               {6'000'000'000'000'000'001, 1'000'000'000, 3, "6000000000.000"}};
  for (const auto& [dividend, divisor, digits, text] : cases)
    EXPECT_EQ(decimal(dividend, divisor, digits), text);
}

int bits_found_by_yosys(const rtl::Design& design, Format format, int interval) {
  const host::ScratchFolder folder;
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(design.trace(format), rtl::Library::thesis(), std::nullopt, interval);
  rtl::write_text(folder / "design.v", rtl::to_verilog(pipeline, rtl::Library::thesis()));
  const std::string name(design.name);
  const rtl::ToolResult yosys = rtl::run_tool(folder.path(), "yosys", "yosys",
                                              "-p 'read_verilog design.v; hierarchy -check -top " + name +
                                                  "; proc; tee -o stat.txt stat -width " + name + "'");
  EXPECT_EQ(yosys.status, 0) << yosys.output;
  const std::string stat = rtl::read_text(folder / "stat.txt");
  const std::regex flop("\\$[a-z]*dff[a-z]*_([0-9]+) +([0-9]+)");
  int bits = 0;
  for (std::sregex_iterator at(stat.begin(), stat.end(), flop); at != std::sregex_iterator(); ++at)
    bits += std::stoi((*at)[1]) * std::stoi((*at)[2]);
  return bits;
}

void expect_the_bits_of_yosys(const rtl::Design& design, const Format& format, int interval) {
  const Price built =
      price(design, format, rtl::Library::thesis(), Account::built, rtl::FlowControl::stall, interval);
  int bits = 0;
  for (const Line& line : built.lines)
    if (line.part.component == rtl::Component::latch) bits += line.n * line.part.bits;
  EXPECT_EQ(bits_found_by_yosys(design, format, interval), bits)
      << design.name << ' ' << to_string(format) << " every " << interval << " cycles";
}

TEST(BuiltAccount, HasTheRegisterBitsThatYosysFinds) {
  EXPECT_EQ(table_7_2().size(), 6U);
  for (const Entry& entry : table_7_2())
    expect_the_bits_of_yosys(rtl::find_design(entry.design), entry.format, 1);
}

TEST_P(EveryDesign, HasTheRegisterBitsOfEveryIntervalThatYosysFinds) {
  for (const int interval : {3, 6})
    expect_the_bits_of_yosys(GetParam().found(), GetParam().parsed(), interval);
}

TEST(Interval, OfAShareableUnitCountsEachComponentOnce) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const hls::IntBits bits{16, 16};
  const rtl::Library& library = rtl::Library::thesis();
  for (const auto& [interval, products] : {std::pair{1, 6}, {2, 3}, {3, 2}, {6, 1}}) {
    const Price built = price(design, bits, library, Account::built, rtl::FlowControl::stall, interval);
    EXPECT_EQ(built.interval, interval);
    int counted = 0;
    for (const Line& line : built.lines)
      counted += line.part.component == rtl::Component::int_multiply ? line.n : 0;
    EXPECT_EQ(counted, products) << interval;
    EXPECT_EQ(built.test_ps(), std::int64_t{interval} * built.stage_delay_ps);
    EXPECT_EQ(built.boxes_per_second(), 1'000'000'000'000 / built.test_ps());
    EXPECT_EQ(built.area_delay_per_box(), built.area_um2 * built.test_ps());
  }
}

/// The thesis's account knows no other interval.
TEST(Interval, HasNoPrintedAccount) {
  EXPECT_EQ(message_of([] {
              static_cast<void>(price(rtl::find_design("int_slabs"), hls::IntBits{20, 24},
                                      rtl::Library::thesis(), Account::printed, rtl::FlowControl::stall, 2));
            }),
            "--ii 2: the thesis's units take a test in each cycle, so only the built account has others");
}

}  // namespace
}  // namespace hitpipe::area::price_test
