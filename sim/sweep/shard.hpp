// The part of a sweep that one of several processes does, and the file where it keeps its rows.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/plan.hpp"
#include "sim/sweep/rows_file.hpp"

namespace hitpipe::sim {

struct Shard {
  static constexpr int most = 100'000;

  int index = 1;  ///< 1..count
  int count = 1;

  friend bool operator==(const Shard&, const Shard&) = default;
};

using Environment = std::function<std::optional<std::string>(const char* name)>;
/// The shard of this process.
[[nodiscard]] std::optional<std::string> process_environment(const char* name);

/// "2/4", or "mpi": the rank and size that OpenMPI, MPICH and its relatives, or Slurm give to each process
/// that they start. This needs no MPI library. Throws std::runtime_error, one line.
[[nodiscard]] Shard parse_shard(const std::string& text,
                                const Environment& environment = process_environment);

/// The points of the shard. Units are dealt out in turn; the rows of one unit stay together.
[[nodiscard]] std::vector<SweepPoint> part_of(const std::vector<SweepPoint>& points, Shard shard);

/// FILE.csv.2-of-4.
[[nodiscard]] std::filesystem::path shard_file(const std::filesystem::path& file, Shard shard);

/// What the first line of the shard's file says: what was measured, the shard, and the number of rows of the
/// finished file.
[[nodiscard]] std::string about_shard(const std::string& about, Shard shard, std::size_t rows);

/// Joins the finished files of all shards beside `file`. Throws std::runtime_error, one line, when there are
/// none, when one is missing or not finished, or when they do not belong together.
[[nodiscard]] RowsFile join_shards(const std::filesystem::path& file);

}  // namespace hitpipe::sim
