// A sweep that can be stopped at any time and continues where it stopped. Each row is in a file as soon as it
// is finished, and rows in the file are not measured again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/sweep/rows_file.hpp"
#include "sim/sweep/sweep.hpp"

namespace hitpipe::sim {

struct ResumableSweep {
  const ref::Scene* scene;
  const ref::Bvh* bvh;
  std::vector<SweepPoint> points;  ///< of the whole sweep
  SweepOptions options;
  std::filesystem::path file;
  std::vector<std::filesystem::path> more;  ///< files of rows that were measured elsewhere
  std::string notes{};                      ///< about the file; written beside it, if there are any
  std::filesystem::path notes_file{};
};

/// Takes the rows of `more` files into the file, measures those that it does not hold yet, and returns all
/// rows of the file. A last line that was cut short counts as missing. Throws what run_sweep(), read_rows()
/// and write_rows() throw, and std::runtime_error, one line, when a file holds rows of another scene or other
/// options.
[[nodiscard]] std::vector<SweepRow> resume(const ResumableSweep& sweep);

/// Takes these rows, which are of one sweep, into the file, as resume() does with the rows of a file. Returns
/// all rows of the file.
[[nodiscard]] std::vector<SweepRow> join_rows(const std::filesystem::path& file,
                                              const std::vector<SweepRow>& rows);

/// Throws what read_rows() throws, and std::runtime_error, one line, when the rows are of something else.
[[nodiscard]] std::vector<SweepRow> read_rows_of(const std::filesystem::path& file,
                                                 const SweepSubject& subject);

}  // namespace hitpipe::sim
