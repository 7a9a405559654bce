// The file of --answers: a line for each ray of --rays, in CSV, with the metadata of all tables beside it
// (csv_metadata.hpp). This is the one place that knows its columns.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "sim/operands/answer.hpp"

namespace hitpipe::cli {

class AnswersFile {
 public:
  /// Makes the file beside its place. `unit_columns` come first; they tell apart what answered. A file without
  /// a name is not written. Throws as host::PendingFile does.
  explicit AnswersFile(const std::string& file, std::vector<std::string> unit_columns = {});

  [[nodiscard]] bool wanted() const { return pending_ != nullptr; }
  /// Adds a line for each ray, in order, if the file is wanted. `unit` has a cell for each unit column.
  void add(std::span<const std::string> unit, std::span<const sim::AskedRay> rays,
           const std::function<sim::Answer(std::size_t ray)>& answer);
  /// The file and its metadata take their places.
  void finish(const Row& notes);

 private:
  std::filesystem::path file_;
  std::string header_;
  std::unique_ptr<host::PendingFile> pending_;  ///< null: not wanted
};

}  // namespace hitpipe::cli
