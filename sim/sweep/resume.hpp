// A sweep that can be stopped at any time and goes on where it stopped. Its rows are in a file, each as soon
// as it is finished, and what the file holds is not measured again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/rows_file.hpp"
#include "sim/sweep/shard.hpp"
#include "sim/sweep/sweep.hpp"

namespace hitpipe::sim {

struct ResumableSweep {
  const ref::Scene* scene;
  const ref::Bvh* bvh;
  std::vector<SweepPoint> points;  ///< of the whole sweep
  SweepOptions options;
  std::string program;  ///< the caller's name and version, as the file tells them
  std::filesystem::path file;
  std::optional<Shard> shard;  ///< only this part is measured, into shard_file(file, *shard)
};

/// Measures what the file does not hold yet, and returns all rows of the file. Throws as run_sweep(),
/// read_rows() and write_rows() do, and std::runtime_error, one line, when the file holds rows of something
/// else.
[[nodiscard]] RowsFile resume(const ResumableSweep& sweep);

/// Throws as read_rows() does, and std::runtime_error, one line, when the rows are not `about` this.
[[nodiscard]] RowsFile read_rows_about(const std::filesystem::path& file, const std::string& about);

}  // namespace hitpipe::sim
