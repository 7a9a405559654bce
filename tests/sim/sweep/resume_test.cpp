// A sweep continues where its file ends, whoever calls it.
#include "sim/sweep/resume.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::resume_test {
namespace {

class Resume : public testing::Test {
 protected:
  /// Two rows of one unit.
  [[nodiscard]] ResumableSweep sweep() const {
    const std::vector<DesignFormats> designs{{&rtl::find_design("int_slabs"), {hls::IntBits{6, 6}}}};
    return {.scene = &scene_,
            .bvh = &bvh_,
            .points = plan_sweep(designs, std::vector<int>{1, 8}),
            .options = {.width = 12, .height = 8, .program = "a test 1"},
            .file = folder_.path() / "rows.csv",
            .more = {}};
  }
  [[nodiscard]] std::string text() const { return host::read_file(folder_.path() / "rows.csv"); }

  const TemporaryFolder folder_;

 private:
  const ref::Scene scene_ = hills();
  const ref::Bvh bvh_ = ref::build_bvh(scene_.mesh);
};

TEST_F(Resume, ReturnsWhatTheFileHolds) {
  const std::vector<SweepRow> rows = resume(sweep());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].program, "a test 1");
  EXPECT_EQ(rows[0].rays_in_flight, 1);
  EXPECT_EQ(rows[1].rays_in_flight, 8);
  EXPECT_EQ(to_csv(rows), text());
}

TEST_F(Resume, MeasuresOnlyWhatIsMissing) {
  std::vector<SweepRow> rows = resume(sweep());
  const std::vector<SweepRow> whole = rows;
  // Without Verilator no row can be measured, and none is missing.
  {
    const EnvironmentValue none("VERILATOR", "/nonexistent/verilator");
    EXPECT_EQ(to_csv(resume(sweep())), to_csv(whole));
    rows.pop_back();
    write_rows(sweep().file, rows);
    EXPECT_THROW((void)resume(sweep()), std::runtime_error);
  }
  const std::vector<SweepRow> again = resume(sweep());
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0], whole[0]);
  EXPECT_EQ(again[1].cycles, whole[1].cycles);
}

/// A row at one interval is none at another.
TEST_F(Resume, TellsIntervalsApart) {
  ResumableSweep at_one = sweep();
  at_one.points.pop_back();
  ResumableSweep both = at_one;
  both.points.push_back(both.points.front());
  both.points.back().interval = 3;
  const std::vector<SweepRow> first = resume(at_one);
  const std::string without = text();
  {
    const EnvironmentValue none("VERILATOR", "/nonexistent/verilator");
    EXPECT_THROW((void)resume(both), std::runtime_error);
    EXPECT_EQ(text(), without);
  }
  const std::vector<SweepRow> rows = resume(both);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0], first[0]);
  EXPECT_EQ(rows[1].interval, 3);
  EXPECT_EQ(rows[1].hits, rows[0].hits);
  EXPECT_EQ(rows[1].rtl_mismatches, 0U);
  EXPECT_GT(rows[1].cycles, rows[0].cycles);
  EXPECT_LT(rows[1].area_um2, rows[0].area_um2);
  const EnvironmentValue none("VERILATOR", "/nonexistent/verilator");
  EXPECT_EQ(to_csv(resume(both)), text());
  ResumableSweep joined = both;
  joined.file = folder_.path() / "joined.csv";
  joined.more = {both.file};
  EXPECT_EQ(to_csv(resume(joined)), text());
  // Cut within the header: nothing is there yet.
  host::write_file(joined.file, text().substr(0, text().find(",ii,") + 4));
  EXPECT_EQ(to_csv(resume(joined)), text());
}

/// A row with its place at the end does not write the others again; any other row moves them.
TEST_F(Resume, AppendsARow) {
  const std::filesystem::path first = folder_.path() / "first.csv";
  ResumableSweep long_run = sweep();
  long_run.options.progress = [&](double) {
    std::error_code there_already;
    std::filesystem::create_hard_link(long_run.file, first, there_already);
  };
  const std::vector<SweepRow> whole = resume(long_run);
  ASSERT_EQ(whole.size(), 2U);
  EXPECT_EQ(read_rows(first).size(), 2U) << "it is still the file of the beginning";
  EXPECT_TRUE(std::filesystem::equivalent(first, long_run.file));
  EXPECT_EQ(to_csv(whole), text());

  // Somebody else has written to it meanwhile.
  std::filesystem::remove(long_run.file);
  long_run.options.progress = [&](double share) {
    if (share < 1.0) host::write_file(long_run.file, "gone");
  };
  EXPECT_EQ(resume(long_run).size(), 2U);
  EXPECT_EQ(parse_rows(text(), "").size(), 2U);

  std::vector<SweepRow> gap = whole;
  gap.erase(gap.begin());
  write_rows(long_run.file, gap);
  const std::vector<SweepRow> filled = resume(sweep());
  EXPECT_EQ(filled.size(), 2U);
  EXPECT_EQ(to_csv(filled), host::read_file(long_run.file));
}

/// Two sweeps, perhaps on two machines, and one that joins their files and measures nothing.
TEST_F(Resume, TakesRowsThatWereMeasuredElsewhere) {
  ResumableSweep one = sweep();
  ResumableSweep other = sweep();
  one.points.pop_back();
  one.file = folder_.path() / "one.csv";
  other.points.erase(other.points.begin());
  other.file = folder_.path() / "other.csv";
  const std::vector<SweepRow> here = resume(one);
  const std::vector<SweepRow> there = resume(other);
  const EnvironmentValue none("VERILATOR", "/nonexistent/verilator");
  ResumableSweep joined = sweep();
  joined.more = {other.file, one.file};
  const std::vector<SweepRow> rows = resume(joined);
  EXPECT_EQ(rows, (std::vector{here.at(0), there.at(0)}));
  EXPECT_EQ(to_csv(rows), text());
  SweepRow of_another = here.at(0);
  of_another.bounces = 7;
  write_rows(one.file, {&of_another, 1});
  joined.file = folder_.path() / "refused.csv";
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)resume(joined); }),
            one.file.string() + ": holds rows of \"" + of_another.text() + "\", asked for are \"" +
                here.at(0).text() + "\"; give another file or remove it");
  EXPECT_FALSE(std::filesystem::exists(joined.file));
}

/// As a copy that broke off leaves it: within its last row, without a row, within the header, or empty.
TEST_F(Resume, MeasuresARowThatIsCutShortAgain) {
  (void)resume(sweep());
  const std::string whole = text();
  const std::size_t rows = whole.find('\n', whole.find('\n') + 1) + 1;
  for (const std::size_t length :
       {whole.size() - 1, rows + 5, rows, rows - 5, std::size_t{10}, std::size_t{0}}) {
    folder_.write("rows.csv", whole.substr(0, length));
    const std::vector<SweepRow> again = resume(sweep());
    ASSERT_EQ(again.size(), 2U) << length;
    EXPECT_EQ(again[1].cycles, parse_rows(whole, "")[1].cycles);
    EXPECT_EQ(to_csv(again), text());
  }
  folder_.write("rows.csv", "no rows");
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)resume(sweep()); }),
            (folder_.path() / "rows.csv").string() +
                ": the last line is cut short; give a file that hitpipe sweep wrote");
}

TEST_F(Resume, RowsOfSomethingElseAreRefusedAndKept) {
  (void)resume(sweep());
  const std::string before = text();
  ResumableSweep other = sweep();
  other.options.width = 13;
  EXPECT_THAT(message_of([&] { (void)resume(other); }),
              testing::AllOf(testing::StartsWith(other.file.string() + ": holds rows of \"a test 1: "),
                             testing::EndsWith("\"; give another file or remove it")));
  EXPECT_EQ(text(), before);
}

/// Refused before anything is measured.
TEST_F(Resume, FileThatCannotBeWrittenIsRefusedAtOnce) {
  const EnvironmentValue none("VERILATOR", "/nonexistent/verilator");
  ResumableSweep nowhere = sweep();
  nowhere.file = folder_.write("file", "") / "rows.csv";
  EXPECT_THAT(message_of([&] { (void)resume(nowhere); }), testing::HasSubstr("cannot create the folder"));
}

}  // namespace
}  // namespace hitpipe::sim::resume_test
