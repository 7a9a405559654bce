// Sums, stages and the library behind a price.
#include "area_model/price.hpp"

#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include "area_model/figure.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

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
    EXPECT_EQ(area_mm2(p.area_um2), areas[i]) << entry.design << ' ' << rtl::to_string(entry.format);
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
  for (const Line& line : price_of({"int_plucker", "20/24"}, Account::built).lines) {
    if (line.estimated) estimated.push_back(part_name(line.part));
  }
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
  // Without it both cost what a latch costs.
  for (const auto flow : {rtl::FlowControl::stall, rtl::FlowControl::none}) {
    const Price p = at(rtl::unit_library(), flow);
    EXPECT_EQ(p.area_um2, none.area_um2);
    EXPECT_EQ(bits_of(p, rtl::Component::latch), registers);
  }
}

// In um2 at 12/12 bits: a latch, mux and subtractor 12, a comparator 6, a multiplier 12 x 12.
TEST(UnitLibrary, IsAddedInTheHead) {
  const Price p = price_of({"int_slabs", "12/12"}, Account::built, rtl::unit_library());
  EXPECT_EQ(p.stage_delay_ps, 11);
  std::map<std::string, int> counts;
  std::map<std::string, std::int64_t> areas;
  for (const Line& line : p.lines) {
    counts[part_name(line.part)] = line.n;
    areas[part_name(line.part)] = line.area_um2;
  }
  EXPECT_EQ(counts.at("int_multiply_12"), 6);
  EXPECT_EQ(areas.at("int_multiply_12"), 6 * 144);
  EXPECT_EQ(areas.at("int_subtract_12"), 6 * 12);
  EXPECT_EQ(areas.at("int_compare_12"), 6 * 6);
  EXPECT_EQ(areas.at("mux2_12"), 16 * 12);
  EXPECT_EQ(areas.at("latch_12"), counts.at("latch_12") * 12);
  EXPECT_EQ(areas.at("tag_16"), (p.stages + 1) * 16);
  std::int64_t sum = 0;
  for (const auto& [name, area_um2] : areas) sum += area_um2;
  EXPECT_EQ(p.area_um2, sum);
}

// Planes and origin of y within +-15: differences of 6 bits times IRDVCs of 12, 6 x 12 partial products.
TEST(UnitLibrary, MultipliesByNarrowerOperandsInTheirPartOfTheSquare) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Demands narrow{{{"iry", {{-15, 15}}}, {"iymin", {{-15, 15}}}, {"iymax", {{-15, 15}}}}};
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(rtl::prune(design.trace(hls::IntBits{12, 12}), narrow).graph, rtl::unit_library());
  const Price p = price(pipeline, design, hls::IntBits{12, 12}, rtl::unit_library());
  std::map<std::string, Line> lines;
  for (const Line& line : p.lines) lines.emplace(part_name(line.part), line);
  EXPECT_EQ(lines.at("int_multiply_12").n, 4);
  EXPECT_EQ(lines.at("int_multiply_12x6").n, 2);
  EXPECT_EQ(lines.at("int_multiply_12x6").area_um2, 2 * 6 * 12);
  EXPECT_TRUE(lines.at("int_multiply_12x6").estimated);
}

// The low three bits of y's planes and origin are 0, so multipliers, subtractors and latches leave them out.
TEST(UnitLibrary, CoarseAxesCostLess) {
  for (const char* const name : {"int_slabs", "int_plucker"}) {
    const rtl::Design& design = rtl::find_design(name);
    const rtl::Interval all{-2047, 2047};
    const auto y = [&](int zeros) {
      return rtl::Demands{{{"iry", {all}, zeros}, {"iymin", {all}, zeros}, {"iymax", {all}, zeros}}};
    };
    std::map<std::string, Line> fine;
    std::map<std::string, Line> coarse;
    const auto priced = [&](int zeros, std::map<std::string, Line>& lines) {
      const rtl::Pipeline pipeline = rtl::make_pipeline(
          rtl::prune(design.trace(hls::IntBits{12, 12}), y(zeros)).graph, rtl::unit_library());
      const Price p = price(pipeline, design, hls::IntBits{12, 12}, rtl::unit_library());
      for (const Line& line : p.lines) lines.emplace(part_name(line.part), line);
      return p.area_um2;
    };
    EXPECT_LT(priced(3, coarse), priced(0, fine)) << name;
    EXPECT_EQ(coarse.at("int_subtract_9").n, 2) << name;
    EXPECT_EQ(coarse.at("int_multiply_12x9").n, design.name == "int_slabs" ? 2 : 4) << name;
    EXPECT_LT(coarse.at("latch_12").n, fine.at("latch_12").n) << name;
  }
}

TEST(PriceOfAPipeline, IsThatOfTheDesignItComesFrom) {
  for (const DesignFormat& d : rtl::every_design()) {
    const Price whole = price_of(d, Account::built);
    const Price same = price(d.pipeline(), d.found(), d.parsed(), Library::thesis());
    EXPECT_EQ(same.area_um2, whole.area_um2);
    EXPECT_EQ(same.boxes, whole.boxes);
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
  EXPECT_EQ(message_of<std::runtime_error>([] {
              static_cast<void>(price_of({"fp_slabs", "fp32"}, Account::built, rtl::unit_library()));
            }),
            "library unit: it has no fp_subtract");
}

TEST(Decimal, RoundsHalvesUp) {
  EXPECT_EQ(decimal(0, 7, 0), "0");
  EXPECT_EQ(decimal(1, 2, 0), "1");
  EXPECT_EQ(decimal(49, 100, 0), "0");
  EXPECT_EQ(decimal(2, 3, 4), "0.6667");
  EXPECT_EQ(decimal(1'008'976, 1'000'000, 4), "1.0090");
  EXPECT_EQ(decimal(999'950, 1'000'000, 4), "1.0000");
  EXPECT_EQ(decimal(999'949, 1'000'000, 4), "0.9999");
  EXPECT_EQ(decimal(6'000'000'000'000'000'001, 1'000'000'000, 3), "6000000000.000");
}

}  // namespace
}  // namespace hitpipe::area::price_test
