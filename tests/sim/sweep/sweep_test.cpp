// Rows of a sweep: their figures follow from their counts, their counts are those of a co-simulation, and
// neither threads nor shards change them.
#include "sim/sweep/sweep.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "area_model/price.hpp"
#include "rtl_gen/catalogue/major_formats.hpp"
#include "sim/cosim.hpp"
#include "sim/sweep/rows_file.hpp"
#include "sim/sweep/shard.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// The text of what is thrown, or "nothing".
template <class Action>
std::string message_of(const Action& action) {
  try {
    static_cast<void>(action());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

SweepRow a_row() {
  return {.scene = "two, \"quoted\"",
          .triangles = 24578,
          .bvh_nodes = 12119,
          .width = 64,
          .height = 48,
          .rays_in_flight = 32,
          .design = "int_slabs",
          .bits = "20/24",
          .stages = 4,
          .stage_delay_ps = 3176,
          .area_um2 = 1'234'567,
          .rays_primary = 3072,
          .rays_secondary = 1000,
          .rays_shadow = 4000,
          .rays_rejected = 72,
          .unit_tests = 400'000,
          .box_tests = 400'000,
          .hits = 200'000,
          .triangle_tests = 70'000,
          .reference_box_tests = 400'800,
          .reference_triangle_tests = 69'000,
          .false_hits = 123,
          .false_misses = 0,
          .rtl_mismatches = 0,
          .different_triangles = 0,
          .different_pixels = 0,
          .cycles = 500'000,
          .rtl_seconds = 0.125,
          .software_ratio = 1.75};
}

/// The same boxes in half the tests and cycles, by a unit of the same area.
SweepRow a_pair() {
  SweepRow row = a_row();
  row.design = "int_major_pair";
  row.bits = "20+1/12";
  row.boxes_per_test = 2;
  row.unit_tests /= 2;
  row.cycles /= 2;
  return row;
}

TEST(SweepRowFigures, AreThoseOfTheirDefinitions) {
  const SweepRow row = a_row();
  EXPECT_EQ(row.rays_traced(), 8000U);
  EXPECT_DOUBLE_EQ(row.occupancy_pct(), 80.0);
  EXPECT_DOUBLE_EQ(row.false_hits_per_million(), 307.5);
  EXPECT_DOUBLE_EQ(row.extra_box_tests_per_ray(), -0.1);
  EXPECT_DOUBLE_EQ(row.extra_triangle_tests_per_ray(), 0.125);
  EXPECT_DOUBLE_EQ(row.run_time_ms(), 1.588);  // 500,000 cycles of 3.176 ns
  EXPECT_DOUBLE_EQ(row.area_per_box_mm2(), 1.234567);
  EXPECT_DOUBLE_EQ(row.area_delay_mm2_ns(), 1.234567 * 3.176);
  EXPECT_DOUBLE_EQ(row.area_run_time_mm2_ms(), 1.234567 * 1.588);
}

TEST(SweepRowFigures, OfAPairAreForEachBox) {
  const SweepRow row = a_pair();
  EXPECT_DOUBLE_EQ(row.occupancy_pct(), 80.0);
  EXPECT_DOUBLE_EQ(row.false_hits_per_million(), 307.5);
  EXPECT_DOUBLE_EQ(row.extra_box_tests_per_ray(), -0.1);
  EXPECT_DOUBLE_EQ(row.run_time_ms(), 1.588 / 2);
  EXPECT_DOUBLE_EQ(row.area_per_box_mm2(), 1.234567 / 2);
  EXPECT_DOUBLE_EQ(row.area_delay_mm2_ns(), 1.234567 / 2 * 3.176);
  // The run time is that of the whole unit, so the area is too.
  EXPECT_DOUBLE_EQ(row.area_run_time_mm2_ms(), 1.234567 * 1.588 / 2);
}

TEST(SweepRowFigures, OfNothingAreZero) {
  const SweepRow row;
  for (const double figure :
       {row.occupancy_pct(), row.false_hits_per_million(), row.extra_box_tests_per_ray(),
        row.extra_triangle_tests_per_ray(), row.run_time_ms()})
    EXPECT_EQ(figure, 0.0);
}

TEST(SweepRowFigures, NothingThatMustBeZeroIsForgiven) {
  EXPECT_TRUE(a_row().verified(true));
  for (const auto count :
       {&SweepRow::rtl_mismatches, &SweepRow::different_triangles, &SweepRow::different_pixels}) {
    SweepRow row = a_row();
    row.*count = 1;
    EXPECT_FALSE(row.verified(true));
    EXPECT_FALSE(row.verified(false));
  }
  SweepRow row = a_row();
  row.false_misses = 1;
  EXPECT_FALSE(row.verified(true));
  EXPECT_TRUE(row.verified(false));
}

TEST(SweepRowCells, GiveTheRowBack) {
  const std::vector<std::string> cells = to_cells(a_row());
  ASSERT_EQ(cells.size(), sweep_columns.size());
  EXPECT_EQ(cells[8], "1");
  EXPECT_EQ(cells[10], "3.176");
  EXPECT_EQ(cells[11], "1.234567");
  EXPECT_EQ(from_cells(cells), a_row());
  EXPECT_EQ(from_cells(to_cells(a_pair())), a_pair());
}

TEST(SweepRowCells, NumbersThatDoNotBelongRejected) {
  for (std::size_t column = 0; column < sweep_columns.size(); ++column) {
    if (is_text_column(sweep_columns[column])) continue;
    for (const char* const wrong : {"", "x", "1x", "1e", "12345.5", "0x1"}) {
      std::vector<std::string> cells = to_cells(a_row());
      cells[column] = wrong;
      const bool time = column + sweep_time_columns >= sweep_columns.size();
      if (time && std::string(wrong) == "12345.5") continue;
      EXPECT_THAT(message_of([&] { return from_cells(cells); }), HasSubstr(sweep_columns[column]))
          << sweep_columns[column] << " = " << wrong;
    }
  }
  EXPECT_EQ(message_of([] { return from_cells({"spheres"}); }), "1 cells; a row has 38");
}

TEST(SweepRowCells, FiguresThatDoNotFollowRejected) {
  std::vector<std::string> cells = to_cells(a_row());
  cells[16] = cells[17] = "400001";  // unit_tests, box_tests
  EXPECT_THAT(message_of([&] { return from_cells(cells); }),
              StartsWith("80 of occupancy_pct does not follow from the counts, which give 80.0002"));
}

TEST(SweepRowCells, BoxesThatTheTestsCannotAnswerForRejected) {
  const auto refused = [](std::uint64_t unit_tests, std::uint64_t box_tests, int boxes_per_test) {
    SweepRow row = a_row();
    row.unit_tests = unit_tests;
    row.box_tests = box_tests;
    row.boxes_per_test = boxes_per_test;
    return message_of([&] { return from_cells(to_cells(row)); });
  };
  EXPECT_EQ(refused(3, 6, 2), "nothing");
  EXPECT_EQ(refused(3, 3, 2), "nothing");
  EXPECT_EQ(refused(3, 7, 2), "7 of box_tests cannot be answered by 3 tests of 2 boxes");
  EXPECT_EQ(refused(3, 2, 2), "2 of box_tests cannot be answered by 3 tests of 2 boxes");
  EXPECT_EQ(refused(3, 4, 1), "4 of box_tests cannot be answered by 3 tests of 1 boxes");
  EXPECT_EQ(refused(3, 3, 0), "0 of boxes_per_test is less than 1");
}

TEST(RowsFile, IsReadAsWritten) {
  const TemporaryFolder folder;
  const RowsFile rows{"a sweep", {a_row(), a_row()}};
  write_rows(folder.path() / "rows.csv", rows);
  const RowsFile again = read_rows(folder.path() / "rows.csv");
  EXPECT_EQ(again.about, "a sweep");
  EXPECT_EQ(again.rows, rows.rows);
  const std::string text = to_text(rows);
  EXPECT_THAT(text, StartsWith("# a sweep\nscene,triangles,bvh_nodes,width,height,rays_in_flight,design,"));
  EXPECT_THAT(text, HasSubstr(",rtl_seconds,software_ratio\n\"two, \"\"quoted\"\"\",24578,"));
}

/// Any part may be cut off. A file with whole lines is a sweep that is not finished; any other file is
/// refused.
TEST(RowsFile, CutShortRejected) {
  const std::string text = to_text({"a sweep", {a_row(), a_row()}});
  std::size_t refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string cut = text.substr(0, length);
    const std::string message = message_of([&] { return parse_rows(cut, "rows.csv"); });
    const bool whole_lines = cut.ends_with('\n') && std::count(cut.begin(), cut.end(), '\n') >= 2;
    EXPECT_EQ(message == "nothing", whole_lines) << length << ": " << message;
    refused += message == "nothing" ? 0 : 1;
  }
  fmt::print("{} of {} cuts refused\n", refused, text.size());
  EXPECT_EQ(
      message_of([] { return parse_rows("# x\nscene\n", "rows.csv"); }),
      "rows.csv: line 2 is not the header of a sweep by this version; give a file that hitpipe sweep wrote");
  EXPECT_EQ(message_of([] { return read_rows("/nonexistent/rows.csv"); }),
            "/nonexistent/rows.csv: cannot read the rows");
}

TEST(SweepFormats, HoldThoseOfTheThesis) {
  const std::vector<rtl::Format> formats = sweep_formats(rtl::find_design("int_slabs"));
  for (const int n : {16, 20, 24}) {
    for (const int t : {n, n + 4, n + 8})
      EXPECT_THAT(formats, testing::Contains(rtl::Format(hls::IntBits{n, t})));
  }
  std::map<int, int> of_n;
  for (const rtl::Format& format : formats) {
    EXPECT_TRUE(format.valid()) << rtl::to_string(format);
    ++of_n[format.as<hls::IntBits>().coord];
  }
  EXPECT_EQ(of_n, (std::map<int, int>{{8, 3}, {12, 3}, {16, 3}, {20, 3}, {24, 3}, {28, 3}, {32, 3}}));
}

std::vector<SweepPoint> small_plan() {
  const std::vector<rtl::Format> formats{hls::IntBits{24, 24}, hls::IntBits{6, 6}, hls::IntBits{6, 6}};
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_plucker"), formats},
                                           {&rtl::find_design("fp_slabs"), {hls::FpBits{}}},
                                           {&rtl::find_design("int_slabs"), formats}};
  return plan_sweep(designs, std::vector<int>{8, 1, 8});
}

std::string text_of(const std::vector<SweepPoint>& points) {
  std::string text;
  for (const SweepPoint& p : points)
    text += fmt::format("{} {} {}\n", p.design->name, rtl::to_string(p.format), p.rays_in_flight);
  return text;
}

TEST(SweepPlan, IsSortedAndHasEachRowOnce) {
  EXPECT_EQ(text_of(small_plan()),
            "fp_slabs fp32 1\nfp_slabs fp32 8\n"
            "int_slabs 6/6 1\nint_slabs 6/6 8\nint_slabs 24/24 1\nint_slabs 24/24 8\n"
            "int_plucker 6/6 1\nint_plucker 6/6 8\nint_plucker 24/24 1\nint_plucker 24/24 8\n");
}

TEST(SweepPlan, FindsThePlaceOfADesignByItsName) {
  const rtl::Design copied = rtl::find_design("int_slabs");
  EXPECT_EQ(key_of({&copied, hls::IntBits{6, 6}, 8}), key_of("int_slabs", "6/6", 8));
  rtl::Design outside = copied;
  outside.name = "outside";
  EXPECT_EQ(key_of({&outside, hls::IntBits{6, 6}, 8}).design, rtl::designs().size())
      << "behind all of the catalogue";
}

TEST(Shards, ShareThePlanWithoutLossOrOverlap) {
  const std::vector<SweepPoint> whole = small_plan();
  for (int count = 1; count <= 7; ++count) {
    std::map<RowKey, int> times;
    for (int index = 1; index <= count; ++index) {
      for (const SweepPoint& point : part_of(whole, {index, count})) ++times[key_of(point)];
    }
    EXPECT_EQ(times.size(), whole.size());
    for (const auto& [key, n] : times) EXPECT_EQ(n, 1);
  }
  EXPECT_EQ(text_of(part_of(whole, {2, 2})),
            "int_slabs 6/6 1\nint_slabs 6/6 8\nint_plucker 6/6 1\nint_plucker 6/6 8\n");
}

Environment with(const std::map<std::string, std::string>& variables) {
  return [variables](const char* name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    if (found == variables.end()) return std::nullopt;
    return found->second;
  };
}

TEST(Shards, AreTheRanksOfTheLauncher) {
  EXPECT_EQ(parse_shard("2/4"), (Shard{2, 4}));
  EXPECT_EQ(parse_shard("mpi", with({{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}})),
            (Shard{2, 2}));
  EXPECT_EQ(parse_shard("mpi", with({{"PMI_RANK", "0"}, {"PMI_SIZE", "3"}})), (Shard{1, 3}));
  // mpirun inside a Slurm job of one task: the launcher's own variables count first.
  EXPECT_EQ(
      parse_shard("mpi",
                  with({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "1"}, {"PMI_RANK", "4"}, {"PMI_SIZE", "8"}})),
      (Shard{5, 8}));
  EXPECT_EQ(parse_shard("mpi", with({{"SLURM_PROCID", "7"}, {"SLURM_NTASKS", "8"}})), (Shard{8, 8}));
}

TEST(Shards, ThatDoNotExistRejected) {
  for (const std::string text : {"", "1", "/", "0/2", "3/2", "1/0", "-1/2", "1/2x", "1/200000", "MPI"}) {
    EXPECT_EQ(message_of([&] { return parse_shard(text, with({})); }),
              "--shard " + text + ": allowed is I/N with I in 1..N and N in 1..100000, or mpi");
  }
  EXPECT_EQ(message_of([] {
              return parse_shard("mpi", with({{"PMI_RANK", "0"}}));
            }),
            "--shard mpi: no rank in the environment; start it with mpirun, mpiexec or srun");
  EXPECT_EQ(message_of([] {
              return parse_shard("mpi", with({{"PMI_RANK", "2"}, {"PMI_SIZE", "2"}}));
            }),
            "--shard mpi: PMI_RANK=2 and PMI_SIZE=2 are not a rank and a size");
}

TEST(Shards, ThatAreNotAllThereAreNotJoined) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "rows.csv";
  const std::string name = file.string();
  const auto refused = [&] { return message_of([&] { return join_shards(file); }); };
  EXPECT_EQ(refused(), name + ": no shards beside it; run hitpipe sweep --shard I/N first");
  SweepRow other = a_row();
  other.bits = "24/24";
  write_rows(shard_file(file, {2, 2}), {about_shard("a sweep", {2, 2}, 1), {a_row()}});
  EXPECT_EQ(refused(), name + ".1-of-2: is missing; run this shard first");
  write_rows(shard_file(file, {1, 2}), {about_shard("a sweep", {1, 2}, 2), {other}});
  EXPECT_EQ(refused(), name + ".1-of-2: has 1 of 2 rows; run this shard again, it continues");
  write_rows(shard_file(file, {1, 2}), {about_shard("another", {1, 2}, 1), {other}});
  EXPECT_EQ(refused(), name + ".2-of-2: was made of another scene or by other options than shard 1");
  write_rows(shard_file(file, {1, 2}), {about_shard("a sweep", {1, 2}, 1), {a_row()}});
  EXPECT_EQ(refused(),
            name + ".2-of-2: int_slabs 20/24 is in another shard too; the shards were cut differently");
  write_rows(shard_file(file, {1, 2}), {"a sweep", {other}});
  EXPECT_EQ(refused(), name + ".1-of-2: line 1 does not say that it is this shard");
  write_rows(shard_file(file, {1, 2}), {about_shard("a sweep", {1, 2}, 1), {other}});
  const RowsFile joined = join_shards(file);
  EXPECT_EQ(joined.about, "a sweep");
  EXPECT_EQ(joined.rows, (std::vector<SweepRow>{a_row(), other}));  // sorted
  write_rows(shard_file(file, {1, 3}), {about_shard("a sweep", {1, 3}, 0), {}});
  EXPECT_EQ(refused(), name + ": shards of 2 and of 3 beside it; remove those of another run");
}

std::vector<SweepRow> swept(const ref::Scene& scene, const ref::Bvh& bvh,
                            const std::vector<SweepPoint>& points, int threads) {
  std::map<RowKey, SweepRow> rows;
  run_sweep(scene, bvh, points, {.width = 24, .height = 16, .threads = threads}, [&](const SweepRow& row) {
    EXPECT_TRUE(rows.emplace(key_of(row.design, row.bits, row.rays_in_flight), row).second);
  });
  std::vector<SweepRow> sorted;
  for (auto& [key, row] : rows) {
    EXPECT_GT(row.rtl_seconds, -1e-9);
    EXPECT_GT(row.software_ratio, 0.0);
    row.rtl_seconds = row.software_ratio = 0;
    sorted.push_back(row);
  }
  return sorted;
}

TEST(Sweep, RowsAreTheCountsOfTheirCosimulation) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<SweepPoint> points = small_plan();
  const std::vector<SweepRow> rows = swept(scene, bvh, points, 2);
  ASSERT_EQ(rows.size(), points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const SweepRow& row = rows[i];
    const SweepPoint& point = points[i];
    SCOPED_TRACE(row.design + " " + row.bits);
    const VerilatedDesign verilated(*point.design, point.format, rtl::Library::thesis());
    const CosimResult counted =
        cosimulate(*point.design, point.format, verilated, scene, bvh,
                   {.width = 24, .height = 16, .rays_in_flight = point.rays_in_flight, .referee = true});
    const area::Price price =
        area::price(*point.design, point.format, rtl::Library::thesis(), area::Account::built);
    EXPECT_EQ(row.design, point.design->name);
    EXPECT_EQ(row.bits, rtl::to_string(point.format));
    EXPECT_EQ(row.rays_in_flight, point.rays_in_flight);
    EXPECT_EQ(row.area_um2, price.area_um2);
    EXPECT_EQ(row.stage_delay_ps, price.stage_delay_ps);
    EXPECT_EQ(row.stages, price.stages);
    EXPECT_EQ(row.triangles, 288U);
    EXPECT_EQ(row.rays_primary, 384U);
    EXPECT_EQ(row.rays_shadow, counted.rays_shadow);
    EXPECT_EQ(row.rays_rejected, counted.rejected);
    EXPECT_EQ(row.boxes_per_test, price.boxes);
    EXPECT_EQ(row.unit_tests, counted.unit.tests);
    EXPECT_EQ(row.box_tests, counted.unit.box_tests);
    EXPECT_DOUBLE_EQ(row.occupancy_pct(), counted.occupancy_pct());
    EXPECT_EQ(row.hits, counted.unit.hits);
    EXPECT_EQ(row.triangle_tests, counted.unit.triangle_tests);
    EXPECT_EQ(row.reference_box_tests, counted.reference.box_tests);
    EXPECT_EQ(row.reference_triangle_tests, counted.reference.triangle_tests);
    EXPECT_EQ(row.false_hits, counted.unit.false_hits);
    EXPECT_EQ(row.false_misses, counted.unit.false_misses);
    EXPECT_EQ(row.cycles, counted.unit.cycles);
    EXPECT_TRUE(row.verified(point.design->conservative));
    EXPECT_EQ(row.false_hits > 0, row.bits == "6/6");
  }
}

/// Almost two boxes for each test and cycle.
TEST(Sweep, APairAnswersForTwoBoxesInACycle) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const rtl::Format bits = hls::MajorBits{12, 1, 12};
  const std::vector<DesignFormats> designs{{&rtl::find_design("int_major"), {bits}},
                                           {&rtl::find_design("int_major_pair"), {bits}}};
  const std::vector<SweepRow> rows = swept(scene, bvh, plan_sweep(designs, std::vector<int>{32}), 2);
  ASSERT_EQ(rows.size(), 2U);
  const SweepRow& one = rows[0];
  const SweepRow& pair = rows[1];
  EXPECT_EQ(one.boxes_per_test, 1);
  EXPECT_EQ(one.unit_tests, one.box_tests);
  EXPECT_EQ(pair.boxes_per_test, 2);
  EXPECT_LT(pair.unit_tests, pair.box_tests);
  EXPECT_LE(pair.box_tests, 2 * pair.unit_tests);
  EXPECT_GE(pair.cycles, pair.unit_tests);
  EXPECT_LT(pair.cycles, pair.box_tests);
  EXPECT_LE(pair.occupancy_pct(), 100.0);
  EXPECT_GT(pair.occupancy_pct(), 90.0);
  EXPECT_GT(pair.area_um2, one.area_um2);
  EXPECT_LT(pair.area_delay_mm2_ns(), one.area_delay_mm2_ns());
  for (const SweepRow& row : rows) EXPECT_TRUE(row.verified(true));
}

TEST(Sweep, RowsDoNotDependOnThreads) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<SweepRow> one = swept(scene, bvh, small_plan(), 1);
  for (const int threads : {2, 64}) EXPECT_EQ(swept(scene, bvh, small_plan(), threads), one) << threads;
}

/// Section 7.4 assumes that a long pipeline is not always full: a single ray fills only one stage of it.
TEST(Sweep, OccupancyRisesWithRaysInFlightUpToThePipelinesLength) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const std::vector<DesignFormats> designs{{&rtl::find_design("fp_slabs"), {hls::FpBits{}}}};
  const std::vector<int> rays{1, 4, 32};
  const std::vector<SweepRow> rows = swept(scene, bvh, plan_sweep(designs, rays), 2);
  ASSERT_EQ(rows.size(), rays.size());
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_GT(rows[i].occupancy_pct(), rows[i - 1].occupancy_pct());
  const double alone = 100.0 / verilated({"fp_slabs", rtl::Format(hls::FpBits{})}).latency();
  EXPECT_NEAR(rows.front().occupancy_pct(), alone, 0.15 * alone);
  EXPECT_GT(rows.back().occupancy_pct(), 90.0);
}

TEST(Sweep, FailureOfARowEndsItWithItsMessage) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  setenv("VERILATOR", "/nonexistent/verilator", 1);
  const std::string message = message_of([&] {
    run_sweep(scene, bvh, small_plan(), {.width = 8, .height = 8, .threads = 2}, [](const SweepRow&) {});
    return 0;
  });
  unsetenv("VERILATOR");
  EXPECT_THAT(message, StartsWith("/nonexistent/verilator: cannot be run; "));
}

TEST(AboutSweep, ChangesWithAllThatDecidesTheRows) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  std::set<std::string> all;
  const auto about = [&](const ref::Scene& s, const ref::Bvh& b, const SweepOptions& options) {
    all.insert(about_sweep("hitpipe 1", s, b, options));
  };
  about(scene, bvh, {});
  about(scene, bvh, {.threads = 7});  // the only one that changes nothing
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(*all.begin(), testing::MatchesRegex("hitpipe 1 sweep: hills, content [0-9a-f]+, 256 x 256 "
                                                  "pixels, 5 bounces"));
  about(scene, bvh, {.width = 255});
  about(scene, bvh, {.height = 255});
  about(scene, bvh, {.light = {.bounces = 4}});
  about(scene, ref::build_bvh(scene.mesh, {.max_triangles = 1}), {});
  const auto changed = [&](auto change) {
    ref::Scene other = hills();
    change(other);
    about(other, bvh, {});
  };
  changed([](ref::Scene& s) { s.camera.eye.x += 0.001F; });
  changed([](ref::Scene& s) { s.camera.projection = ref::Projection::orthographic; });
  changed([](ref::Scene& s) { s.camera.half_height += 0.001; });
  changed([](ref::Scene& s) { s.lights.pop_back(); });
  changed([](ref::Scene& s) { s.lights.back().kind = ref::LightKind::sun; });
  changed([](ref::Scene& s) { s.materials[0].reflect.x = 0.25F; });
  changed([](ref::Scene& s) { s.mesh.vertices[3].y += 0.001F; });
  changed([](ref::Scene& s) { s.name = "line\nbreak"; });
  EXPECT_EQ(all.size(), 13U);
  for (const std::string& text : all) EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace hitpipe::sim
