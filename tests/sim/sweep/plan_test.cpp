// The plan of a sweep: its formats, its order, and its division into shards.
#include "sim/sweep/plan.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/sweep/rows_file.hpp"
#include "sim/sweep/shard.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/sweep/sample_rows.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::plan_test {
namespace {

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
    EXPECT_EQ(message_of<std::runtime_error>([&] { return parse_shard(text, with({})); }),
              "--shard " + text + ": allowed is I/N with I in 1..N and N in 1..100000, or mpi");
  }
  EXPECT_EQ(message_of<std::runtime_error>([] {
              return parse_shard("mpi", with({{"PMI_RANK", "0"}}));
            }),
            "--shard mpi: no rank in the environment; start it with mpirun, mpiexec or srun");
  EXPECT_EQ(message_of<std::runtime_error>([] {
              return parse_shard("mpi", with({{"PMI_RANK", "2"}, {"PMI_SIZE", "2"}}));
            }),
            "--shard mpi: PMI_RANK=2 and PMI_SIZE=2 are not a rank and a size");
}

TEST(Shards, ThatAreNotAllThereAreNotJoined) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "rows.csv";
  const std::string name = file.string();
  const auto refused = [&] { return message_of<std::runtime_error>([&] { return join_shards(file); }); };
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
  SweepRow costly = other;
  costly.triangle.delay_ps += 1;
  write_rows(shard_file(file, {1, 2}), {about_shard("a sweep", {1, 2}, 1), {costly}});
  EXPECT_EQ(refused(), name +
                           ".2-of-2: counts triangle tests at another cost than the shards before; run it "
                           "again with the same options");
  write_rows(shard_file(file, {1, 2}), {"a sweep", {other}});
  EXPECT_EQ(refused(), name + ".1-of-2: line 1 does not say that it is this shard");
  write_rows(shard_file(file, {1, 2}), {about_shard("a sweep", {1, 2}, 1), {other}});
  const RowsFile joined = join_shards(file);
  EXPECT_EQ(joined.about, "a sweep");
  EXPECT_EQ(joined.rows, (std::vector<SweepRow>{a_row(), other}));  // sorted
  write_rows(shard_file(file, {1, 3}), {about_shard("a sweep", {1, 3}, 0), {}});
  EXPECT_EQ(refused(), name + ": shards of 2 and of 3 beside it; remove those of another run");
}

}  // namespace
}  // namespace hitpipe::sim::plan_test
