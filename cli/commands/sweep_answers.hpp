// --answers of a sweep: the triangles that each unit found, written when all are known.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/text/answers_file.hpp"
#include "sim/sweep/sweep.hpp"

namespace hitpipe::cli {

class SweepAnswers {
 public:
  /// Does nothing if the file has no name. Otherwise the sweep tells it the triangles that each unit found, so it
  /// must outlive the sweep.
  SweepAnswers(const std::string& file, sim::SweepOptions& options);

  [[nodiscard]] bool wanted() const { return file_.wanted(); }
  /// In the order of the sweep's rows.
  void write(const ref::Scene& scene, const ref::Bvh& bvh, const sim::SweepOptions& options,
             const Row& notes);

 private:
  AnswersFile file_;
  /// Rows are measured in an order of their own.
  std::map<sim::RowKey, std::pair<sim::SweepPoint, std::vector<std::uint32_t>>> found_;
};

}  // namespace hitpipe::cli
