// `hitpipe area`: Table 7.2 by default, both accounts, a user's own library, and what is refused.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/text.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::area_command_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

Outcome area(const std::vector<std::string>& arguments) {
  return run_hitpipe(with({"area"}, arguments));
}

std::string printed(const std::vector<std::string>& arguments) {
  const Outcome outcome = area(arguments);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

void rejected(const std::vector<std::string>& arguments, const std::string& message) {
  const Outcome outcome = area(arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
}

TEST(AreaCommand, PrintsTable72AsCsvToTheLastDigit) {
  EXPECT_THAT(
      lines_of(printed({"--account", "printed", "--format", "csv"})),
      ElementsAre(
          "design,bits,stages,stage_delay_ns,clock_mhz,latency_ns,area_mm2,area_pct,adp_mm2_ns,"
          "adp_pct,boxes_per_test,area_per_box_mm2,int_subtract_20,int_subtract_24,int_multiply_20,"
          "int_multiply_24,int_compare_20,int_compare_24,fp_subtract_32,fp_multiply_32,fp_compare_32,latch_1,"
          "latch_20,latch_24,"
          "latch_32,mux2_1,mux2_20,mux2_24,mux2_32,estimated",
          "fp_slabs,fp32,13,2.876,348,37.388,1.9284,100,5.546,100,1,1.9284,0,0,0,0,0,0,6,6,6,29,0,0,58,0,0,0,"
          "10,",
          "fp_plucker,fp32,20,2.876,348,57.520,3.6624,190,10.533,190,1,3.6624,0,0,0,0,0,0,12,12,12,20,0,0,45,"
          "6,0,0,18,",
          "int_slabs,n24/"
          "24,5,3.176,315,15.880,1.0090,52,3.205,58,1,1.0090,0,6,0,6,0,6,0,0,0,6,0,38,0,0,0,16,0,",
          "int_slabs,n20/"
          "24,4,3.176,315,12.704,0.7075,37,2.247,41,1,0.7075,6,0,6,0,0,6,0,0,0,5,33,4,0,0,12,4,0,",
          "int_plucker,n24/"
          "24,5,3.176,315,15.880,1.9091,99,6.063,109,1,1.9091,0,12,0,12,0,12,0,0,0,5,0,27,0,6,"
          "0,18,0,",
          "int_plucker,n20/"
          "24,4,3.176,315,12.704,1.3387,69,4.252,77,1,1.3387,6,6,12,0,6,6,0,0,0,4,15,12,0,6,18,"
          "0,0,int_compare_20"));
}

TEST(AreaCommand, BuiltIsTheDefaultAndHasValidAndTagBits) {
  const auto lines = lines_of(printed({"--format", "csv"}));
  EXPECT_EQ(printed({"--format", "csv", "--account", "built"}), printed({"--format", "csv"}));
  ASSERT_EQ(lines.size(), 7U);
  const std::vector<std::string> header = host::csv_cells(lines[0]);
  ASSERT_GE(header.size(), 3U);
  EXPECT_THAT(std::vector<std::string>(header.end() - 3, header.end()),
              ElementsAre("valid_1", "tag_16", "estimated"));
  for (const std::string& line : lines) EXPECT_EQ(host::csv_cells(line).size(), header.size()) << line;
  EXPECT_THAT(lines[6], testing::EndsWith(",5,5,int_subtract_25 int_compare_20 int_compare_25 tag_16"));
}

/// The figures of the CSV as numbers.
TEST(AreaCommand, PrintsTheSameFiguresAsJson) {
  const auto lines = lines_of(printed({"--format", "csv"}));
  const Json list = Json::parse(printed({"--format", "json"}));
  const std::vector<std::string> header = host::csv_cells(lines.at(0));
  ASSERT_EQ(list.size() + 1, lines.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::vector<std::string> cells = host::csv_cells(lines[i + 1]);
    ASSERT_EQ(list[i].size(), header.size());
    std::size_t column = 0;
    for (const auto& [key, value] : list[i].items()) {
      EXPECT_EQ(key, header[column]);
      if (value.is_string()) {
        EXPECT_EQ(value, cells[column]);
      } else if (key != "estimated") {
        EXPECT_EQ(value, Json::parse(cells[column])) << key;
      }
      ++column;
    }
  }
  EXPECT_EQ(list.at(5).at("estimated"),
            Json({"int_subtract_25", "int_compare_20", "int_compare_25", "tag_16"}));
}

TEST(AreaCommand, PrintsALineADesignThenAColumnADesign) {
  const std::string text = printed({"--account", "printed"});
  EXPECT_LE(widest_line(text), 80U) << text;
  const auto lines = lines_of(text);
  EXPECT_EQ(lines.at(0), "design       bits   stages  delay  clock  latency    area           ADP");
  EXPECT_EQ(lines.at(1), "                               ns    MHz       ns     mm2        mm2 ns");
  EXPECT_EQ(lines.at(3), "fp_plucker   fp32       20  2.876    348   57.520  3.6624  190%  10.533  190%");
  EXPECT_THAT(text, HasSubstr("\ncount                 fp32     fp32  24/24  20/24    24/24    20/24\n"));
  EXPECT_THAT(text, HasSubstr("\nint_compare_20 est.      -        -      -      -        -        6\n"));
  EXPECT_THAT(text, HasSubstr("\nlatch_24                 -        -     38      4       27       12\n"));
  EXPECT_THAT(text, HasSubstr("\ntotal                1.9284   3.6624  1.0090  0.7075   1.9091   1.3387\n"));
  for (const std::string& line : lines) EXPECT_FALSE(line.ends_with(' ')) << line;
}

TEST(AreaCommand, TextFitsEightyColumnsHoweverManyDesigns) {
  const std::vector<std::string> many{"int_plucker", "--bits",
                                      "6/6,8/8,10/10,12/12,14/14,16/16,18/18,20/20,22/22,24/24,32/32"};
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"--by-stage"}, {"fp_slabs"}, many, with(many, {"--by-stage"})}) {
    const std::string text = printed(arguments);
    EXPECT_LE(widest_line(text), 80U) << text;
  }
  const std::string text = printed(many);
  std::size_t columns = 0;
  for (std::size_t at = text.find("plucker "); at != std::string::npos; at = text.find("plucker", at + 1)) {
    ++columns;
  }
  EXPECT_EQ(columns, 11U + 11U + 11U) << "summary, counts and areas have every design";
}

TEST(AreaCommand, PrintsTheBoxesOfAPair) {
  const std::string text = printed({"fp_slabs", "int_major", "int_major_pair"});
  EXPECT_LE(widest_line(text), 80U) << text;
  const auto lines = lines_of(text);
  EXPECT_EQ(lines.at(0), "design         bits    stages delay latency   area boxes   area         ADP");
  EXPECT_EQ(lines.at(1), "                                 ns      ns    mm2        a box      mm2 ns");
  EXPECT_EQ(lines.at(2), "fp_slabs       fp32        13 2.876  37.388 1.9484     1 1.9484 100%  5.604 100%");
  EXPECT_EQ(lines.at(4), "int_major_pair 20+1/13      4 3.176  12.704 0.5269     2 0.2634  14%  0.837  15%");
  EXPECT_EQ(lines.at(5), "ADP and percent of fp_slabs are for each box that a test answers for.");
  for (const std::string& line : lines) EXPECT_FALSE(line.ends_with(' ')) << line;
  // Without a pair there is nothing to say about boxes.
  EXPECT_THAT(printed({"fp_slabs", "int_major"}), testing::Not(HasSubstr("box")));
}

TEST(AreaCommand, PrintsStages) {
  EXPECT_EQ(printed({"int_slabs", "--bits", "24/24", "--by-stage", "--account", "printed"}),
            "int_slabs 24/24, 5 stages of 3.176 ns\n"
            "stage  area mm2  components\n"
            "    0    0.0321  1 latch_1, 16 latch_24\n"
            "    1    0.1170  6 int_subtract_24, 1 latch_1, 13 latch_24, 12 mux2_24\n"
            "    2    0.8080  6 int_multiply_24, 1 latch_1, 1 latch_24\n"
            "    3    0.0021  1 latch_1, 1 latch_24\n"
            "    4    0.0141  1 latch_1, 7 latch_24\n"
            "    5    0.0356  6 int_compare_24, 1 latch_1, 4 mux2_24\n"
            "total    1.0090\n");
}

TEST(AreaCommand, PrintsStagesAsCsvAndJson) {
  const auto lines = lines_of(printed({"int_slabs", "--bits", "24/24", "--by-stage", "--format", "csv"}));
  EXPECT_EQ(lines.at(0),
            "design,bits,stage,area_mm2,int_subtract_24,int_multiply_24,int_compare_24,latch_1,latch_24,"
            "mux2_24,valid_1,tag_16,estimated");
  EXPECT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines.at(4), "int_slabs,n24/24,3,0.0035,0,0,0,1,1,0,1,1,tag_16");
  const Json list = Json::parse(printed({"int_slabs", "int_plucker", "--by-stage", "--format", "json"}));
  EXPECT_EQ(list.size(), 5U + 5U);
  EXPECT_EQ(list.at(9).at("stage"), 4);
  EXPECT_EQ(list.at(9).at("int_subtract_25"), 6);
}

TEST(AreaCommand, PricesTheDesignsNamedInTheirOrder) {
  const Json list = Json::parse(printed({"int_plucker", "int_slabs", "--bits", "12/12", "--format", "json"}));
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].at("design"), "int_plucker");
  EXPECT_EQ(list[1].at("design"), "int_slabs");
  EXPECT_EQ(list[1].at("bits"), "12/12");
  EXPECT_EQ(list[1].at("int_multiply_12"), 6);
  const Json by_default = Json::parse(printed({"fp_slabs", "int_slabs", "--format", "json"}));
  EXPECT_EQ(by_default.at(0).at("bits"), "fp32");
  EXPECT_EQ(by_default.at(0).at("area_pct"), 100);
  EXPECT_EQ(by_default.at(1).at("bits"), "20/24");
}

class AreaLibrary : public testing::Test {
 protected:
  static std::string thesis() {
    return contents_of(std::filesystem::path(HITPIPE_SOURCE) /
                       "rtl_gen/component/libraries/thesis_250nm.json");
  }
  std::string write(const Json& library) const { return folder_.write("own.json", library.dump()).string(); }

  const sim::TemporaryFolder folder_;
};

TEST_F(AreaLibrary, OfOnesOwnChangesThePrices) {
  const std::vector<std::string> arguments{"int_slabs", "--account", "printed", "--format", "json"};
  Json library = Json::parse(thesis());
  const std::vector<std::string> with_library = with(arguments, {"--library", write(library)});
  EXPECT_EQ(printed(with_library), printed(arguments));
  // Six multipliers of 20 bits, each 0.01 mm2 larger.
  Json& cell = library["components"]["int_multiply"]["cells"][1];
  ASSERT_EQ(cell["bits"], 20);
  cell["area_um2"] = cell["area_um2"].get<int>() + 10000;
  write(library);
  EXPECT_EQ(Json::parse(printed(with_library)).at(0).at("area_mm2"), 0.7675);
}

TEST_F(AreaLibrary, WithoutFloatsLeavesPercentagesOut) {
  Json library = Json::parse(thesis());
  for (const char* const name : {"fp_subtract", "fp_multiply", "fp_compare"})
    library["components"].erase(name);
  const std::string file = write(library);
  const Json list = Json::parse(printed({"int_slabs", "--library", file, "--format", "json"}));
  EXPECT_TRUE(list.at(0).at("area_pct").is_null());
  EXPECT_TRUE(list.at(0).at("adp_pct").is_null());
  EXPECT_THAT(printed({"int_slabs", "--library", file, "--format", "csv"}),
              HasSubstr(",0.7167,,2.276,,1,0.7167,"));
  EXPECT_THAT(printed({"int_slabs", "--library", file}), testing::Not(HasSubstr("%")));
  rejected({"--library", file}, "library thesis_250nm: it has no fp_subtract");
}

/// A chip's units are counted in its cells.
TEST(AreaOnAChip, PrintsTablesRegistersAndBlocks) {
  const std::string text = printed({"int_slabs", "--bits", "16/16,24/24", "--library", "xc7"});
  EXPECT_LE(widest_line(text), 80U) << text;
  const auto lines = lines_of(text);
  EXPECT_THAT(lines.at(0), testing::ContainsRegex(
                               "^design  *bits  *stages  *delay  *clock  *latency  *LUT  *FF  *DSP48E1$"));
  EXPECT_THAT(lines.at(2), testing::ContainsRegex("^int_slabs  *16/16 .* 6$"));
  EXPECT_THAT(lines.at(3), testing::ContainsRegex("^int_slabs  *24/24 .* 12$"));
  EXPECT_EQ(lines.at(4), "On AMD 7 series (Artix-7, speed grade 1). Delays are estimated.");
  EXPECT_THAT(text, testing::Not(HasSubstr("mm2")));
  EXPECT_THAT(text, testing::Not(HasSubstr("%")));
}

TEST(AreaOnAChip, PrintsTheSameFiguresInEveryFormat) {
  const std::vector<std::string> arguments{"int_slabs", "fp_slabs", "--library", "ice40_up5k", "--format"};
  const Json list = Json::parse(printed(with(arguments, {"json"})));
  const auto lines = lines_of(printed(with(arguments, {"csv"})));
  ASSERT_EQ(list.size(), 2U);
  ASSERT_EQ(lines.size(), 3U);
  const auto header = host::csv_cells(lines[0]);
  for (std::size_t row = 0; row < list.size(); ++row) {
    const auto cells = host::csv_cells(lines[row + 1]);
    EXPECT_EQ(list[row].at("library"), "ice40_up5k");
    EXPECT_EQ(list[row].at("dsp_name"), "SB_MAC16");
    EXPECT_EQ(list[row].at("delay_estimated"), true);
    EXPECT_GT(list[row].at("lut").get<int>(), 0);
    EXPECT_GT(list[row].at("ff").get<int>(), 0);
    for (const char* const key : {"lut", "ff", "dsp", "stages"}) {
      const auto column = std::find(header.begin(), header.end(), key) - header.begin();
      EXPECT_EQ(cells.at(static_cast<std::size_t>(column)), list[row].at(key).dump()) << key;
    }
  }
  EXPECT_EQ(list[0].at("dsp"), 6);
  // A table and the register behind it are one cell.
  for (const Json& row : list) {
    EXPECT_GT(row.at("logic_cells"), row.at("lut"));
    EXPECT_LT(row.at("logic_cells").get<int>(), row.at("lut").get<int>() + row.at("ff").get<int>());
  }
  const std::string text = printed({"fp_plucker_direct", "--library", "ice40_up5k"});
  EXPECT_THAT(text, testing::ContainsRegex("LUT  *FF  *SB_MAC16  *cells\n"));
  EXPECT_LE(widest_line(text), 80U) << text;
}

/// The odd bits of a product of 20 x 24 bits are logic or a second block.
TEST(AreaOnAChip, ABlockIsWorthWhatTheUserSays) {
  const std::vector<std::string> unit{"int_slabs", "--library", "xc7"};
  const std::string usual = printed(unit);
  EXPECT_LE(widest_line(usual), 80U) << usual;
  EXPECT_THAT(usual, testing::ContainsRegex("\nint_slabs  *20/24 .* 6\n"));
  const auto of = [&](const char* luts) {
    return Json::parse(printed(with(unit, {"--block-luts", luts, "--format", "json"}))).at(0);
  };
  const Json free = of("0");
  EXPECT_EQ(free["dsp"], 12);
  EXPECT_EQ(free["library"], "xc7 --block-luts 0");
  EXPECT_THAT(usual, HasSubstr(fmt::format("\nA product's odd bits take a block where logic would take more "
                                           "than 182 LUT.\nint_slabs 20/24 with --block-luts 0: 12 DSP48E1, "
                                           "{} LUT, {} FF\n",
                                           free["lut"].dump(), free["ff"].dump())));
  EXPECT_EQ(of("182")["dsp"], 6);
  EXPECT_GT(of("182")["lut"], free["lut"]);
  EXPECT_THAT(printed(with(unit, {"--bits", "16/16"})), testing::Not(HasSubstr("--block-luts")));
  rejected({"int_slabs", "--block-luts", "3"},
           "--block-luts: the library thesis_250nm has no multiplier blocks; allowed with one of a chip that "
           "has them");
}

/// Six products, then three, two and one.
TEST(AreaAgainstRate, PrintsALineForEachInterval) {
  const std::vector<std::string> intervals{"int_slabs", "--bits",    "16/16", "--ii",
                                           "1,2,3,6",   "--library", "xc7"};
  const Json rows = Json::parse(printed(with(intervals, {"--format", "json"})));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["lut_of_ii_1_pct"], 100);
  const std::vector<std::string> text = lines_of(printed(intervals));
  for (const auto& [row, interval, blocks] : {std::tuple{0U, 1, 6}, {1U, 2, 3}, {2U, 3, 2}, {3U, 6, 1}}) {
    EXPECT_EQ(rows[row]["ii"], interval);
    EXPECT_EQ(rows[row]["dsp"], blocks);
    EXPECT_EQ(rows[row]["int_multiply_16"], blocks);
    EXPECT_NEAR(rows[row]["boxes_per_second"].get<double>() * interval,
                1e9 / rows[row]["stage_delay_ns"].get<double>(), 10.0);
    EXPECT_THAT(text[row + 2], HasSubstr(fmt::format("16/16   {}  ", interval)));
  }
  EXPECT_EQ(lines_of(printed(with(intervals, {"--format", "csv"}))).size(), 5U);
}

TEST(AreaAgainstRate, FloatSlabsOfAThirdOfTheRateTakeLessThanAHalf) {
  const Json rows = Json::parse(printed({"fp_slabs", "--ii", "1,3,6", "--format", "json"}));
  EXPECT_EQ(rows[0]["area_of_ii_1_pct"], 100);
  EXPECT_LT(rows[1]["area_of_ii_1_pct"], 50);
  EXPECT_LE(rows[2]["area_of_ii_1_pct"], 30);
  EXPECT_EQ(rows[2]["fp_multiply_32"], 1);
}

TEST(AreaAgainstRate, PricesTheFloatTriangle) {
  const Json rows = Json::parse(printed({"--triangle", "--ii", "1,4,8,16", "--format", "json"}));
  ASSERT_EQ(rows.size(), 4U);
  for (const Json& row : rows) EXPECT_EQ(row["design"], "float_triangle");
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_LT(rows[i]["area_mm2"].get<double>(), rows[i - 1]["area_mm2"].get<double>());
}

TEST(AreaAgainstRate, TextFitsEightyColumns) {
  for (const std::string library : {"thesis_250nm", "ecp5"})
    for (const std::string& line :
         lines_of(printed({"fp_plucker_direct", "int_major_pair", "--ii", "1,2,64", "--library", library})))
      EXPECT_LE(line.size(), 80U) << line;
}

TEST(AreaAgainstRate, WrongIntervalsRejected) {
  for (const char* const wrong : {"0", "65", "x", "1.5"})
    rejected({"int_slabs", "--ii", wrong},
             fmt::format("--ii: Value {} not in range 1 to 64; see hitpipe area --help", wrong));
  rejected({"--ii", "2", "--by-stage"},
           "--ii excludes --by-stage: a shared component works in several stages; see hitpipe area --help");
  rejected({"--ii", "2", "--account", "printed"},
           "--ii 2: the thesis's units take a test in each cycle, so only the built account has others");
}

}  // namespace
}  // namespace hitpipe::cli::area_command_test
