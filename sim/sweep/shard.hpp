// Which part of a sweep one of several processes does, and where it keeps its rows.
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
/// Of this process.
[[nodiscard]] std::optional<std::string> process_environment(const char* name);

/// "2/4", or "mpi": rank and size as OpenMPI, MPICH and its kin, or Slurm tell them to each process they
/// start. No MPI library is needed for that. Throws std::runtime_error, one line.
[[nodiscard]] Shard parse_shard(const std::string& text,
                                const Environment& environment = process_environment);

/// Its points: units are dealt out in turn, the rows of one unit stay together.
[[nodiscard]] std::vector<SweepPoint> part_of(const std::vector<SweepPoint>& points, Shard shard);

/// FILE.csv.2-of-4.
[[nodiscard]] std::filesystem::path shard_file(const std::filesystem::path& file, Shard shard);

/// What is said of the rows, with the shard and the number of rows that it will have when it is done.
[[nodiscard]] std::string about_shard(const std::string& about, Shard shard, std::size_t rows);

/// Joins the finished files of all shards beside `file`. Throws std::runtime_error, one line, when there is
/// none, one is missing or not finished, or they do not belong together.
[[nodiscard]] RowsFile join_shards(const std::filesystem::path& file);

}  // namespace hitpipe::sim
