// `hitpipe sweep`: the file is the same whoever did the work and however often the run was killed.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sim/sweep/rows_file.hpp"
#include "tests/cli/killed_at_call.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::sweep_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// A mesh of 288 triangles: reading and building take no time.
std::string comb() {
  std::string text;
  for (int i = 0; i < 144; ++i) {
    text += fmt::format("v {0} 0 0\nv {1} 0 0\nv {0} 9 {2}\nv {1} 9 {2}\n", i * 0.1, i * 0.1 + 0.06, i % 7);
    text += fmt::format("f {} {} {}\nf {} {} {}\n", 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 2, 4 * i + 4,
                        4 * i + 3);
  }
  return text;
}

class SweepCommand : public testing::Test {
 protected:
  /// Three units, each with two numbers of rays in flight.
  [[nodiscard]] static std::vector<std::string> sweep(const fs::path& file,
                                                      const std::vector<std::string>& more = {}) {
    return with({"sweep", "--scene", scene_.string(), "--width", "40", "--height", "30",
                 "int_plucker,fp_slabs,int_slabs", "--bits", "6/6", "--rays-in-flight", "8,1", "--out",
                 file.string()},
                more);
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_.path() / name; }
  /// The file of an undisturbed run on one thread.
  [[nodiscard]] static const fs::path& whole() { return *whole_; }
  /// A copy of it.
  [[nodiscard]] fs::path copy() const {
    fs::copy_file(whole(), file("copy.csv"));
    return file("copy.csv");
  }

  static void SetUpTestSuite() {
    suite_folder_ = std::make_unique<sim::TemporaryFolder>();
    scene_ = suite_folder_->write("comb.obj", comb());
    whole_ = suite_folder_->path() / "whole.csv";
    const Outcome outcome = run_hitpipe(sweep(*whole_, {"--threads", "1"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() { suite_folder_.reset(); }

 private:
  const sim::TemporaryFolder folder_;
  static inline std::unique_ptr<sim::TemporaryFolder> suite_folder_;
  static inline fs::path scene_;
  static inline std::optional<fs::path> whole_;
};

constexpr std::size_t all_rows = 6;

/// All columns but the two with measured times.
std::string untimed(const fs::path& file) {
  std::string text;
  for (std::string line : lines_of(contents_of(file))) {
    if (!line.starts_with('#')) {
      for (std::size_t i = 0; i < sim::sweep_time_columns; ++i) line.erase(line.rfind(','));
    }
    text += line + "\n";
  }
  return text;
}

/// The rows of a test in every cycle stay, and those of a test every three cycles are added.
TEST_F(SweepCommand, AddsTheRowsOfAnInterval) {
  const fs::path rows = copy();
  const std::vector<std::string> more{"--ii", "1,3", "--threads", "2"};
  const Outcome outcome = run_hitpipe(sweep(rows, more));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U) << outcome.out;
  EXPECT_THAT(lines_of(outcome.out).at(0), testing::ContainsRegex("^design +bits +II +rays"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("\nint_slabs +6/6 +3 +8 "));
  const std::vector<sim::SweepRow> all = sim::read_rows(rows);
  ASSERT_EQ(all.size(), 2 * all_rows);
  std::vector<sim::SweepRow> in_every_cycle;
  for (const sim::SweepRow& row : all) {
    if (row.interval == 1) in_every_cycle.push_back(row);
    EXPECT_EQ(row.rtl_mismatches, 0U);
  }
  EXPECT_EQ(in_every_cycle, sim::read_rows(whole()));
  const json records = json::parse(run_hitpipe(with(sweep(rows, more), {"--format", "json"})).out);
  EXPECT_EQ(records.at(1).at("ii"), 3);
  for (const char* const bad : {"0", "65", "x", ""}) {
    const Outcome refused = run_hitpipe(sweep(file("none.csv"), {"--ii", bad}));
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err,
              fmt::format("hitpipe: --ii: Value {} not in range 1 to 64; see hitpipe sweep --help\n", bad));
    EXPECT_FALSE(fs::exists(file("none.csv")));
  }
}

TEST_F(SweepCommand, FileDoesNotDependOnThreadsPartsOrOrder) {
  const std::string one = untimed(whole());
  EXPECT_EQ(sim::read_rows(whole()).size(), all_rows);

  EXPECT_EQ(run_hitpipe(sweep(file("two.csv"), {"--threads", "2"})).exit_code, 0);
  EXPECT_EQ(untimed(file("two.csv")), one);

  // Two sweeps at once of parts of the designs, then one that joins them and measures nothing.
  const auto part = [&](const char* name, const char* designs) {
    std::vector<std::string> arguments = sweep(file(name), {"--threads", "1"});
    *std::find(arguments.begin(), arguments.end(), "int_plucker,fp_slabs,int_slabs") = designs;
    return run_hitpipe(arguments).exit_code;
  };
  int second = -1;
  std::thread other([&] { second = part("b.csv", "fp_slabs,int_slabs"); });
  EXPECT_EQ(part("a.csv", "int_plucker"), 0);
  other.join();
  EXPECT_EQ(second, 0);
  const Outcome joined =
      run_hitpipe(sweep(file("all.csv"), {"--rows", file("a.csv").string() + "," + file("b.csv").string()}),
                  {{"VERILATOR", "/nonexistent"}});
  EXPECT_EQ(joined.exit_code, 0) << joined.err;
  EXPECT_EQ(untimed(file("all.csv")), one);
}

/// Each run is killed at a later call that changes files, some of them in the middle of a row.
TEST_F(SweepCommand, KilledAtAnyCallComesToTheSameEnd) {
  const fs::path out = file("killed.csv");
  const auto finished = [&] {
    const std::string text = fs::exists(out) ? contents_of(out) : "";
    return std::max<std::ptrdiff_t>(std::count(text.begin(), text.end(), '\n'), 1) - 1;  // below the header
  };
  std::ptrdiff_t rows = 0;
  int killed = 0;
  int cut = 0;
  std::string history;
  for (int call = 1;; ++call) {
    const int ended = run_hitpipe(sweep(out), killed_at_call(call)).exit_code;
    EXPECT_GE(finished(), rows) << "a finished row was lost";
    rows = finished();
    if (ended != -1) {
      EXPECT_EQ(ended, 0);
      break;
    }
    ++killed;
    cut += fs::exists(out) && !contents_of(out).ends_with('\n') ? 1 : 0;
    history += fmt::format(" {}", rows);
  }
  fmt::print("{} runs killed; finished rows after each:{}\n", killed, history);
  EXPECT_GE(killed, 8);
  EXPECT_GE(cut, 1) << "no run was killed within a row";
  EXPECT_EQ(untimed(out), untimed(whole()));
}

TEST_F(SweepCommand, RowsOfSomethingElseRejected) {
  const fs::path rows = copy();
  const std::string before = contents_of(rows);
  const Outcome outcome = run_hitpipe(sweep(rows, {"--bounces", "2"}));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, StartsWith("hitpipe: " + rows.string() + ": holds rows of \"hitpipe "));
  EXPECT_THAT(
      outcome.err,
      HasSubstr(
          " 40 x 30 pixels, 5 bounces, library thesis_250nm, cost of tests and set-up\", asked for are \""));
  EXPECT_THAT(outcome.err, testing::EndsWith(" 40 x 30 pixels, 2 bounces, library thesis_250nm, cost of "
                                             "tests and set-up\"; give another file or remove it\n"));
  EXPECT_THAT(run_hitpipe(sweep(rows, {"--diffuse", "1"})).err,
              testing::EndsWith(" 40 x 30 pixels, 5 bounces, 1 diffuse, light seed 1, library thesis_250nm, "
                                "cost of tests and set-up\"; "
                                "give another file or remove it\n"));
  EXPECT_EQ(contents_of(rows), before);
}

TEST_F(SweepCommand, TracesTheRaysOfAFile) {
  const sim::TemporaryFolder folder;
  const std::string scene = folder.write("comb.obj", comb()).string();
  const fs::path rays = folder.write("rays.csv", "ox,oy,oz,dx,dy,dz,any\n3,5,40,0,0,-1,0\n3,5,40,0,0,-1,1\n");
  const std::vector<std::string> words{
      "sweep",    "int_slabs", "--scene",     scene,   "--bits",
      "20/24",    "--rays",    rays.string(), "--out", (folder.path() / "rows.csv").string(),
      "--format", "json"};
  const Outcome outcome = run_hitpipe(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json row = json::parse(outcome.out).at(0);
  EXPECT_EQ(row.at("width"), 0);
  EXPECT_EQ(row.at("rays_primary"), 1);
  EXPECT_EQ(row.at("rays_shadow"), 1);
  EXPECT_EQ(row.at("different_pixels"), 0);
  (void)folder.write("rays.csv", "ox,oy,oz,dx,dy,dz\n3,5,40,0,0,-1\n");
  const Outcome other = run_hitpipe(words);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(
      other.err,
      HasSubstr(", rays of a file, library thesis_250nm, cost of tests and set-up\", asked for are \""));
}

TEST_F(SweepCommand, DoesNotReplaceTheRowsThatItTakes) {
  const std::string rows = copy().string();
  const Outcome outcome = run_hitpipe(sweep(rows, {"--rows", rows}));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "hitpipe: " + rows + ": is an input, which would be lost; give another file to write\n");
}

/// The cost of a triangle test is no measurement: the rows stay. A last line that was cut is measured again;
/// here nothing is missing.
TEST_F(SweepCommand, TakesTheRowsThatThereAre) {
  const fs::path rows = copy();
  std::ofstream(rows, std::ios::app) << "comb,1,2";
  const Outcome outcome = run_hitpipe(sweep(rows, {"--triangle-ns", "5", "--triangle-mm2", "0.25"}),
                                      {{"VERILATOR", "/nonexistent"}});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<sim::SweepRow> before = sim::read_rows(whole());
  const std::vector<sim::SweepRow> after = sim::read_rows(rows);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].triangle, (sim::TriangleCost{5000, 250'000}));
    EXPECT_EQ(after[i].cycles, before[i].cycles);
  }
}

TEST_F(SweepCommand, PrintsTextThatFitsEightyColumnsAndJson) {
  const fs::path rows_file = copy();
  const Outcome text = run_hitpipe(sweep(rows_file));
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_EQ(text.err, "");
  EXPECT_LE(widest_line(text.out), 80U) << text.out;
  const std::vector<std::string> lines = lines_of(text.out);
  ASSERT_GT(lines.size(), 2 + all_rows);
  EXPECT_THAT(lines[2 + all_rows], StartsWith("Least whole area × time: "));
  EXPECT_THAT(text.out, HasSubstr("triangle test is taken as 2.876 ns of a unit of 7.886 mm². "));
  // A program that reads it finds the header first.
  const std::string csv = run_hitpipe(sweep(rows_file, {"--format", "csv"})).out;
  EXPECT_THAT(csv, StartsWith("program,scene,content,triangles,"));
  EXPECT_EQ(csv, contents_of(rows_file));

  const json rows = json::parse(run_hitpipe(sweep(rows_file, {"--format", "json"})).out);
  ASSERT_EQ(rows.size(), all_rows);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("scene"), "comb");
    EXPECT_EQ(row.at("rays_primary"), 1200);
    EXPECT_EQ(row.at("different_pixels"), 0);
    EXPECT_NEAR(row.at("run_time_ms").get<double>(),
                row.at("cycles").get<double>() * row.at("stage_delay_ns").get<double>() * 1e-6, 1e-9);
  }
}

/// A table with a pair fits too, has the area for each box, and says so.
TEST_F(SweepCommand, PrintsTheAreaOfAPairForEachBox) {
  const fs::path out = file("pair.csv");
  std::vector<std::string> arguments = sweep(out);
  const auto at = std::find(arguments.begin(), arguments.end(), "int_plucker,fp_slabs,int_slabs");
  arguments.erase(at, at + 5);
  arguments.insert(arguments.end(), {"--bits", "6/6,20+1/12", "int_major_pair", "int_slabs"});
  const Outcome outcome = run_hitpipe(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U) << outcome.out;
  const auto lines = lines_of(outcome.out);
  ASSERT_GT(lines.size(), 2U + 2U + 1U);
  EXPECT_THAT(lines[3], StartsWith("int_major_pair 20+1/12    32  0.25 "));
  EXPECT_EQ(lines[4], "area: for each box that a test answers for; area*time: of the whole unit");
}

/// A chip has lookup tables in place of an area, and a clock of its own.
TEST_F(SweepCommand, PricesByTheLibraryOfAChip) {
  const fs::path out = file("chip.csv");
  std::vector<std::string> arguments = sweep(out, {"--library", "xc7"});
  *std::find(arguments.begin(), arguments.end(), "int_plucker,fp_slabs,int_slabs") = "int_slabs";
  const Outcome outcome = run_hitpipe(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LE(widest_line(outcome.out), 80U) << outcome.out;
  EXPECT_THAT(outcome.out, testing::ContainsRegex(" LUT ms, of box tests alone[ \n]"));
  EXPECT_THAT(outcome.out, HasSubstr("weigh multiplier blocks"));
  const sim::SweepRow chip = sim::read_rows(out).at(0);
  const sim::SweepRow cells = sim::read_rows(whole()).at(2);
  ASSERT_EQ(cells.design, chip.design);
  EXPECT_EQ(chip.library, "xc7");
  EXPECT_TRUE(chip.on_chip());
  EXPECT_EQ(chip.box_tests, cells.box_tests);
  EXPECT_NE(chip.stage_delay_ps, cells.stage_delay_ps);
  // The rows of one library are not continued with another.
  const Outcome other = run_hitpipe(sweep(out));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("library xc7, cost of tests and set-up\", asked for are \""));
}

TEST_F(SweepCommand, RowThatIsNotVerifiedFails) {
  std::vector<sim::SweepRow> rows = sim::read_rows(whole());
  rows[2].different_pixels = 7;
  rows[2].false_misses = 1;
  sim::write_rows(file("rows.csv"), rows);
  const Outcome outcome = run_hitpipe(sweep(file("rows.csv")));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_GT(lines_of(outcome.out).size(), 2 + all_rows);
  EXPECT_EQ(outcome.err,
            "hitpipe: int_slabs 6/6 on comb: 0 RTL mismatches, 0 different triangles, 7 different pixels, 1 "
            "false misses; all must be 0\n");
}

}  // namespace
}  // namespace hitpipe::cli::sweep_command_test
