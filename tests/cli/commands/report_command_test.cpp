// `hitpipe report`: one page with its rows in a file beside it, where every number can be found.
#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "area_model/triangle_unit.hpp"
#include "cli/report/report_page.hpp"
#include "cli/report/sweep_rows.hpp"
#include "host/text.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/sweep/rows_file.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::report_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> report(const fs::path& out, const std::vector<std::string>& more) {
  return with({"report", "--scene", "spheres", "--width", "8", "--height", "8", "--occlusion", "1",
               "--diffuse", "2", "--light-seed", "9", "--tests", "600", "--out", out.string()},
              more);
}

/// The beginning of a line of CSV.
std::string csv_start(const std::vector<std::string>& cells) {
  std::string line = host::csv_line(cells);
  line.back() = ',';
  return line;
}

/// One report with its own sweep, shared by all tests.
class ReportCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new sim::TemporaryFolder;
    outcome_ = run_hitpipe(report(out(), {"--bits", "6/6,12+1/10,e5m10"}));
    page_ = fs::exists(out() / "index.html") ? contents_of(out() / "index.html") : "";
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  void SetUp() override { ASSERT_EQ(outcome_.exit_code, 0) << outcome_.err; }

  static fs::path out() { return folder_->path() / "out"; }

  static inline sim::TemporaryFolder* folder_ = nullptr;
  static inline Outcome outcome_;
  static inline std::string page_;
};

/// The designs that the report measures in a format beyond Table 7.2, and these formats as it names
/// them for a sweep: the given one of their family, or their own.
struct Others {
  std::vector<std::string> designs, formats;

  Others() {
    for (const rtl::Design& design : rtl::designs()) {
      if (!design.kind.of_boxes) continue;
      const bool single = design.default_format.family().single;
      if (single && !design.printed.rows.empty()) continue;
      designs.emplace_back(design.name);
      const std::string format = format_of(design);
      if (!single && std::find(formats.begin(), formats.end(), format) == formats.end())
        formats.push_back(format);
    }
  }
  static std::string format_of(const rtl::Design& design) {
    for (const std::string given : {"6/6", "12+1/10", "e5m10"}) {
      const auto numbers = design.default_format.family().parse(given);
      if (numbers && rtl::Format(design.default_format.family(), *numbers).valid()) return given;
    }
    return rtl::to_string(design.default_format);
  }
};
constexpr std::size_t thesis_units = 6;
constexpr std::size_t rays_in_flight = 9;  ///< for each of them: 1, 2, .. 256

TEST_F(ReportCommand, WritesThePageAndWhatItsNumbersComeFrom) {
  EXPECT_EQ(outcome_.err, "");
  EXPECT_THAT(outcome_.out, HasSubstr(fmt::format("rows                 {}\n",
                                                  thesis_units * rays_in_flight + Others().designs.size())));
  std::vector<std::string> expected{
      "box_tests.png", "core.csv",          "csv-metadata.json", "extra_box_tests_6_6.png",
      "index.html",    "integer_world.csv", "pictures.csv",      "pipelines.csv",
      "rows.csv",      "rtl.png",           "software.png",      "stability.csv",
      "stiffness.csv"};
  for (const std::string plot :
       {"core_busy", "core_cache", "core_memory", "core_rate", "error_area", "error_area_run_time",
        "error_run_time", "error_software_time", "integer_world", "memory", "occupancy", "stiffness",
        "whole_area_run_time", "whole_run_time"})
    for (const char* const kind : {".gp", ".pdf", ".svg"}) expected.push_back(plot + kind);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(files_below(out()), expected);
}

TEST_F(ReportCommand, PageNeedsNothingButItself) {
  for (const char* const outside : {"src=\"http", "href=\"http", "url(http", "@import", "<script", ".csv\""})
    EXPECT_THAT(page_, Not(HasSubstr(outside)));
  std::size_t pictures = 0;
  for (std::size_t at = page_.find("<img "); at != std::string::npos; at = page_.find("<img ", at + 1)) {
    EXPECT_EQ(page_.substr(at, 32), "<img src=\"data:image/png;base64,");
    ++pictures;
  }
  EXPECT_EQ(pictures, 4U);
}

TEST_F(ReportCommand, EveryRowOfTheTableIsTheLineOfTheFile) {
  const std::vector<sim::SweepRow> rows = sim::read_rows(out() / "rows.csv");
  std::size_t shown = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const sim::SweepRow& row = rows[i];
    if (row.rays_in_flight != 32) continue;
    const std::vector<std::vector<const char*>> tables{
        {"boxes_per_test", "stages", "stage_delay_ns", "area_mm2", "area_per_box_mm2", "occupancy_pct",
         "run_time_ms", "area_run_time_mm2_ms", "whole_run_time_ms", "whole_area_run_time_mm2_ms",
         "set_up_run_time_ms", "energy_nj_per_ray"},
        {"box_tests", "extra_box_tests_pct", "triangle_tests", "extra_triangle_tests_pct",
         "false_hits_per_million", "false_misses", "nodes_fetched", "bytes_per_ray", "bytes_per_ray_4kib",
         "bytes_per_ray_16kib", "bytes_per_ray_64kib"}};
    for (const std::vector<const char*>& columns : tables) {
      std::string line = "<tr><td>" + unit_name(row) + "</td>";
      for (const char* const column : columns) {
        const std::string text = readable_number(cell(row, column));
        line += (text.empty() ? "<td>" : "<td class=\"n\">") + text + "</td>";
      }
      EXPECT_THAT(page_, HasSubstr(line + "<td class=\"n\">" + std::to_string(i + 2) + "</td></tr>\n"));
    }
    ++shown;
  }
  EXPECT_EQ(shown, thesis_units + Others().designs.size());
}

/// What to build is told by the whole cost, with what that counts.
TEST_F(ReportCommand, RecommendsByTheWholeCost) {
  const std::vector<sim::SweepRow> rows = sim::read_rows(out() / "rows.csv");
  const std::optional<std::size_t> best = cheapest(rows, 32);
  ASSERT_TRUE(best);
  EXPECT_THAT(page_, HasSubstr("<dt>Least whole area × run time of all</dt><dd>" + unit_name(rows[*best])));
  EXPECT_THAT(page_, HasSubstr(cost_caveat(rows.front())));
  const area::Price triangle = area::price_of_triangle_unit(rtl::Library::thesis());
  EXPECT_EQ(rows.front().triangle.area_um2, triangle.area_um2);
  EXPECT_EQ(rows.front().triangle.delay_ps, triangle.stage_delay_ps);
}

/// A sampled share stands with its interval; the file has the number of cases.
TEST_F(ReportCommand, TellsIntervalsOfWhatIsSampled) {
  const std::vector<std::string> stability = lines_of(contents_of(out() / "stability.csv"));
  EXPECT_EQ(stability.front(),
            "design,bits,category,tests,seed,exact_hits,false_misses,false_miss_pct,false_miss_pct_low,"
            "false_miss_pct_high,false_hits,false_hit_pct,false_hit_pct_low,false_hit_pct_high");
  EXPECT_EQ(stability.size(), 1U + 6U * 27U);
  EXPECT_THAT(stability[1], testing::StartsWith("fp_slabs,fp32,"));
  EXPECT_THAT(page_,
              testing::ContainsRegex("<td>corner</td><td class=\"n\">2[23]</td><td>[0-9.]+ \\([0-9.]+ to "));
  EXPECT_THAT(page_, HasSubstr("What units miss that can miss, and why: fp_slabs missed "));
  const std::string stiffness = contents_of(out() / "stiffness.csv");
  EXPECT_THAT(stiffness, HasSubstr("int_slabs,n16/16,16,aimed "));
  EXPECT_THAT(page_, HasSubstr("hitpipe check --stiff --tests 600 --seed 1 --out FOLDER\n"));
}

TEST_F(ReportCommand, HasHeadingsInWords) {
  for (const char* const heading : {"clock period, ns", "clock, MHz", "whole area × run time, mm² ms"})
    EXPECT_THAT(page_, HasSubstr("<th scope=\"col\">" + std::string(heading) + "</th>"));
  EXPECT_THAT(page_, Not(testing::ContainsRegex("<th scope=\"col\">[a-z_]*_(ns|ms|mm2|pct|mhz)</th>")));
}

/// Units of the cheapest rows have a line each, with the command that prints its figures.
TEST_F(ReportCommand, PipelinesHaveTheRecommendedUnits) {
  const std::vector<sim::SweepRow> rows = sim::read_rows(out() / "rows.csv");
  const std::string pipelines = contents_of(out() / "pipelines.csv");
  bool beyond_the_thesis = false;
  for (const NamedRow& best : best_rows(rows)) {
    const sim::SweepRow& row = rows[best.row];
    EXPECT_THAT(pipelines,
                HasSubstr("\n" + csv_start({row.design, row.bits, std::to_string(row.interval),
                                            std::to_string(row.boxes_per_test), std::to_string(row.stages),
                                            cell(row, "stage_delay_ns")})))
        << best.name;
    if (is_thesis_unit(row)) continue;
    beyond_the_thesis = true;
    EXPECT_THAT(page_,
                HasSubstr(fmt::format("hitpipe area {} --bits {} --format csv\n", row.design, row.bits)));
  }
  EXPECT_TRUE(beyond_the_thesis);
  EXPECT_EQ(best_rows(rows).back().row, cheapest_boxes(rows, 32));
}

/// Designs of all families are on the page, floats that never miss too.
TEST_F(ReportCommand, SaysNothingThatHoldsOfSomeUnitsOnly) {
  EXPECT_THAT(page_, HasSubstr("false misses of units that never miss 0"));
  for (const char* const untrue : {"n/t", "integer unit", "What float units"})
    EXPECT_THAT(page_, Not(HasSubstr(untrue)));
}

/// A map without extra tests would be of one colour.
TEST_F(ReportCommand, TellsWhyAMapIsNotDrawn) {
  EXPECT_THAT(page_,
              testing::ContainsRegex("<p>Extra box tests of int_slabs 20/24 have no map, because only "
                                     "[0-6] of 64 pixels have any[.] -?[0-9]+ in all, of [0-9,]+[.]</p>"));
}

/// Another cost of a triangle test needs no new measurement.
TEST_F(ReportCommand, TakesAnotherCostOfATriangleTest) {
  const fs::path again = folder_->path() / "costly";
  const Outcome outcome = run_hitpipe(report(
      again, {"--rows", (out() / "rows.csv").string(), "--triangle-ns", "4", "--triangle-mm2", "2.5"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<sim::SweepRow> before = sim::read_rows(out() / "rows.csv");
  const std::vector<sim::SweepRow> rows = sim::read_rows(again / "rows.csv");
  ASSERT_EQ(rows.size(), before.size());
  EXPECT_EQ(rows[0].triangle, (sim::TriangleCost{4000, 2'500'000}));
  EXPECT_EQ(rows[0].run_time_ms(), before[0].run_time_ms());
  EXPECT_NE(rows[0].whole_run_time_ms(), before[0].whole_run_time_ms());
  EXPECT_THAT(contents_of(again / "index.html"), HasSubstr("is taken as 4 ns of a unit of 2.5 mm²"));
}

/// An error does not depend on the interval, so these diagrams stay; one of rates is added.
TEST_F(ReportCommand, ShowsAreaAgainstRate) {
  const fs::path rates = folder_->path() / "rates";
  const Outcome outcome = run_hitpipe(report(rates, {"--bits", "6/6,12+1/10,e5m10", "--ii", "1,3"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(contents_of(rates / "error_area.svg"), contents_of(out() / "error_area.svg"));
  EXPECT_FALSE(fs::exists(out() / "area_rate.svg"));
  EXPECT_TRUE(fs::exists(rates / "area_rate.svg"));
  const std::string page = contents_of(rates / "index.html");
  EXPECT_THAT(page, HasSubstr("<td>int_slabs 6/6 II 3</td>"));
  EXPECT_THAT(page, HasSubstr(" --ii 1,3 --out rows.csv"));
}

/// The page says what a picture shows.
TEST_F(ReportCommand, PlotsHaveTheirTitlesOnThePage) {
  for (const char* const title :
       {"spheres: error and area", "False hits on stiff rays", "spheres: what a cache saves"}) {
    EXPECT_THAT(page_, HasSubstr(fmt::format("<figcaption><strong>{}.</strong> ", title)));
    EXPECT_THAT(page_, HasSubstr(fmt::format("aria-label=\"{}\"", title)));
    EXPECT_THAT(page_, Not(HasSubstr(fmt::format("<text><tspan font-family=\"sans-serif\" >{}<", title))));
  }
}

TEST_F(ReportCommand, DrawsPlotsForAPaper) {
  const fs::path paper = folder_->path() / "paper";
  const Outcome outcome =
      run_hitpipe(report(paper, {"--rows", (out() / "rows.csv").string(), "--plot-width", "84mm"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files_below(paper), files_below(out()));
  for (const fs::directory_entry& file : fs::directory_iterator(paper)) {
    const std::string kind = file.path().extension();
    const char* const expected = kind == ".svg"   ? "width=\"317\""
                                 : kind == ".gp"  ? "set terminal pdfcairo size 8.4000cm,"
                                 : kind == ".pdf" ? "/MediaBox [ 0 0 238 "
                                                  : "";
    EXPECT_THAT(contents_of(file), HasSubstr(expected)) << file;
  }
  EXPECT_EQ(contents_of(paper / "rows.csv"), contents_of(out() / "rows.csv"));
  EXPECT_THAT(contents_of(paper / "index.html"), HasSubstr(" --plot-width 84mm"));
}

TEST_F(ReportCommand, ComparesAreasForEachBox) {
  EXPECT_THAT(page_, HasSubstr("area for each box tested in a cycle, mm²"));
  EXPECT_THAT(page_, HasSubstr("is compared as two units: its area per box is half of its area."));
  const std::vector<sim::SweepRow> rows = sim::read_rows(out() / "rows.csv");
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [](const sim::SweepRow& row) { return row.design == "int_major_pair"; });
  ASSERT_NE(found, rows.end());
  const sim::SweepRow& pair = *found;
  EXPECT_EQ(pair.boxes_per_test, 2);
  EXPECT_DOUBLE_EQ(pair.area_per_box_mm2(), static_cast<double>(pair.area_um2) / 2e6);
  // The cheapest is told with what its area is for.
  EXPECT_THAT(page_, HasSubstr(" mm² for 2 boxes in a test; "));
}

/// Its command makes the rows of the file.
TEST_F(ReportCommand, AsksTheQuestionOfTheIntegerWorld) {
  const fs::path file = folder_->path() / "world.csv";
  EXPECT_THAT(
      page_,
      HasSubstr("hitpipe sweep int_triangle --scene spheres --width 8 --height 8 --diffuse 2 --occlusion 1 "
                "--light-seed 9 --builder sah --max-triangles 2 --mantissas 11 "
                "--out integer_world.csv"));
  const Outcome outcome = run_hitpipe({"sweep", "int_triangle", "--scene", "spheres", "--width", "8",
                                       "--height", "8", "--diffuse", "2", "--occlusion", "1", "--light-seed",
                                       "9", "--mantissas", "11", "--out", file.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string rows = contents_of(out() / "integer_world.csv");
  EXPECT_EQ(rows, contents_of(file));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 6) << "a head and five formats";
  EXPECT_THAT(page_, HasSubstr("24+1s24"));
}

/// The rows of core.csv as values by column.
std::vector<std::map<std::string, std::string>> core_rows(const fs::path& folder) {
  std::vector<std::map<std::string, std::string>> rows;
  const std::vector<std::string> lines = lines_of(contents_of(folder / "core.csv"));
  const std::vector<std::string> columns = host::csv_cells(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> values = host::csv_cells(lines[i]);
    EXPECT_EQ(values.size(), columns.size()) << lines[i];
    auto& row = rows.emplace_back();
    for (std::size_t c = 0; c < std::min(values.size(), columns.size()); ++c) row[columns[c]] = values[c];
  }
  return rows;
}

TEST_F(ReportCommand, CoresAnswerEveryRayRight) {
  const auto rows = core_rows(out());
  // Two formats with three intervals and two numbers of rays; three latencies with seven numbers of rays, of
  // which two are among these; three caches; three memories with four.
  EXPECT_EQ(rows.size(), 2U * 3U * 2U + 3U * 7U - 2U + 3U + 3U * 4U);
  std::uint64_t answers = 0;
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("wrong"), "0");
    EXPECT_GT(std::stod(row.at("mrays_s")), 0);
    EXPECT_GT(std::stod(row.at("area_mm2")), 0.5);
    answers += std::stoull(row.at("rays"));
  }
  EXPECT_THAT(page_, HasSubstr(">The core</h2>"));
  EXPECT_THAT(page_,
              HasSubstr(fmt::format("wrong answers 0 of {}, rows with other reads than software&#39;s 0",
                                    readable_number(std::to_string(answers)))));
  EXPECT_THAT(outcome_.out, HasSubstr("wrong_core_answers   0\n"));
}

/// What the plots of the core must show whatever the scene is.
TEST_F(ReportCommand, CoresAreBusierWithMoreRaysAndReadLessWithACache) {
  const auto rows = core_rows(out());
  const auto value = [&](std::map<std::string, std::string> of, const std::string& column) {
    of.insert({{"bits", "20+1/11s20"},
               {"triangle_ii", "4"},
               {"memory", "ideal"},
               {"latency", "100"},
               {"cache_kib", "0"},
               {"rays_in_flight", "128"}});
    for (const auto& row : rows)
      if (std::includes(row.begin(), row.end(), of.begin(), of.end())) return std::stod(row.at(column));
    ADD_FAILURE() << "no such row";
    return 0.0;
  };
  for (const char* const latency : {"20", "100", "200"}) {
    const double few = value({{"latency", latency}, {"rays_in_flight", "8"}}, "port_busy_pct");
    EXPECT_LT(2 * few, value({{"latency", latency}, {"rays_in_flight", "128"}}, "port_busy_pct")) << latency;
    EXPECT_LT(value({{"latency", "200"}, {"rays_in_flight", "8"}}, "port_busy_pct"), few + 1e-9) << latency;
  }
  double bytes = value({}, "bytes_a_ray");
  for (const char* const cache : {"4", "16", "64"}) {
    const double cached = value({{"cache_kib", cache}}, "bytes_a_ray");
    EXPECT_LE(cached, bytes) << cache;
    bytes = cached;
  }
  EXPECT_LT(bytes, 0.9 * value({}, "bytes_a_ray"));
  for (const char* const memory : {"dram", "litedram-128"}) {
    std::map<std::string, std::string> behind{{"memory", memory}, {"latency", ""}, {"rays_in_flight", "32"}};
    const double without = value(behind, "mrays_s");
    behind["cache_kib"] = "16";
    EXPECT_GT(value(behind, "mrays_s"), without) << memory;
  }
  for (const char* const bits : {"16+1/11s16", "20+1/11s20"}) {
    EXPECT_LT(value({{"bits", bits}, {"triangle_ii", "16"}}, "area_mm2"),
              value({{"bits", bits}, {"triangle_ii", "4"}}, "area_mm2"));
    EXPECT_LT(value({{"bits", bits}, {"rays_in_flight", "32"}}, "memory_bits"),
              value({{"bits", bits}}, "memory_bits"));
  }
  EXPECT_LT(value({{"bits", "16+1/11s16"}}, "area_mm2"), value({}, "area_mm2"));
}

/// Of one row, and of the numbers of rays that a command of the page has.
TEST_F(ReportCommand, NamesCommandsThatTraceTheSameCores) {
  const auto of_trace = [](const std::string& command) {
    std::istringstream words(command);
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    EXPECT_EQ(arguments.front(), "hitpipe");
    arguments.erase(arguments.begin());
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::vector<std::string> lines = lines_of(outcome.out);
    // The page says once, for all rows, what the first five cells say of the mesh.
    for (std::string& line : lines)
      for (int cell = 0; cell < 5; ++cell) line.erase(0, line.find(',') + 1);
    return lines;
  };
  const std::string csv = contents_of(out() / "core.csv");
  std::size_t run = 0;
  for (const auto& row : core_rows(out())) {
    const bool small =
        row.at("bits") == "16+1/11s16" && row.at("triangle_ii") == "8" && row.at("rays_in_flight") == "32";
    const bool real = row.at("memory") == "litedram-128" && row.at("cache_kib") == "16";
    if (!small && !real && (row.at("cache_kib") != "4" || row.at("memory") != "ideal")) continue;
    ++run;
    const std::vector<std::string> traced = of_trace(row.at("command"));
    ASSERT_EQ(traced.size(), 2U);
    EXPECT_THAT(csv, HasSubstr("," + traced[0] + ","));
    EXPECT_THAT(csv, HasSubstr("," + traced[1] + ","));
  }
  EXPECT_EQ(run, 3U);
  const std::string of_page =
      "hitpipe core trace --native --scene spheres --builder sah --max-triangles 2 --width 8 --height 8 "
      "--bits "
      "20+1s20 "
      "--triangle-ii 4 --rays-in-flight 8,16,32,64,128,192,256 --memory ideal,latency=20 --format csv";
  EXPECT_THAT(page_, HasSubstr(of_page + "\n"));
  for (const std::string& line : of_trace(of_page)) EXPECT_THAT(csv, HasSubstr("," + line + ","));
}

TEST_F(ReportCommand, RowsThatAreGivenMakeTheSamePage) {
  const fs::path again = folder_->path() / "again";
  const Outcome outcome = run_hitpipe(report(again, {"--rows", (out() / "rows.csv").string()}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* const file : {"rows.csv", "pictures.csv", "pipelines.csv", "stability.csv",
                                 "error_area.svg", "occupancy.svg", "rtl.png"})
    EXPECT_EQ(contents_of(again / file), contents_of(out() / file)) << file;
}

TEST_F(ReportCommand, NamesCommandsThatMeasureTheSameRows) {
  const Others others;
  EXPECT_EQ(fmt::format("{}", fmt::join(others.designs, ","))
                .find("int_slabs,int_plucker,fp_plucker_direct,int_major,int_major_pair,fp_slabs_safe"),
            0U);
  EXPECT_THAT(
      page_,
      HasSubstr(fmt::format(
          "hitpipe sweep --scene spheres --width 8 --height 8 --diffuse 2 --occlusion 1 --light-seed 9 "
          "--builder sah --max-triangles 2 {} --bits {} "
          "--rays-in-flight 32 --out rows.csv\n",
          fmt::join(others.designs, ","), fmt::join(others.formats, ","))));
  EXPECT_THAT(page_,
              HasSubstr("--bits 20/24,24/24 --rays-in-flight 1,2,4,8,16,32,64,128,256 --out rows.csv\n"));
  EXPECT_THAT(page_, HasSubstr("hitpipe check int_plucker --bits 20/24 --tests 600 --seed 1\n"));
}

/// The command beside each picture draws that picture.
TEST_F(ReportCommand, NamesCommandsThatDrawTheSamePictures) {
  const fs::path drawn = folder_->path() / "drawn";
  fs::create_directory(drawn);
  std::vector<std::string> rows = lines_of(contents_of(out() / "pictures.csv"));
  ASSERT_EQ(rows.size(), 5U);
  rows.erase(rows.begin());
  for (const std::string& row : rows) {
    const std::string file = row.substr(0, row.find(','));
    std::istringstream words(row.substr(row.rfind(',') + 1));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;)
      arguments.push_back(word == "FILE.png" ? (drawn / file).string()
                          : word == "FOLDER" ? (drawn / "folder").string()
                                             : word);
    ASSERT_GT(arguments.size(), 1U) << row;
    ASSERT_EQ(arguments.front(), "hitpipe");
    arguments.erase(arguments.begin());
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << row << "\n" << outcome.err;
    const fs::path picture = arguments.front() == "cosim" ? drawn / "folder/spheres.png" : drawn / file;
    EXPECT_EQ(contents_of(picture), contents_of(out() / file)) << row;
  }
}

TEST_F(ReportCommand, BadInputRejected) {
  const auto rejected = [&](const std::vector<std::string>& more, const std::string& message) {
    const Outcome outcome = run_hitpipe(report(folder_->path() / "none", more));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(lines_of(outcome.err).size(), 1U);
    EXPECT_FALSE(fs::exists(folder_->path() / "none"));
  };
  rejected({"--image-design", "fp_slabs"},
           "hitpipe: design fp_slabs: can miss boxes; give a design that never does\n");
  rejected({"--plot-width", "84"},
           "hitpipe: --plot-width: 84 is no width from 40mm to 400mm, such as 84mm, 3.3in or 240pt; see "
           "hitpipe report --help\n");
  const std::string rows = (out() / "rows.csv").string();
  rejected({"--rows", rows, "--fov", "30"}, "give another file or remove it\n");
  const std::string none = (out() / "none.csv").string();
  rejected({"--rows", none}, "hitpipe: " + none + ": cannot read the rows\n");
}

TEST_F(ReportCommand, MissingGnuplotRejected) {
  const Outcome outcome =
      run_hitpipe(report(folder_->path() / "none", {"--rows", (out() / "rows.csv").string()}),
                  {{"PATH", folder_->path().string()}});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "hitpipe: report: gnuplot was not found; install the package gnuplot-nox\n");
}

}  // namespace
}  // namespace hitpipe::cli::report_command_test
