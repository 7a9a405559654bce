// The experiments of the thesis, by the number of the table that prints them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "thesis/result.hpp"

namespace hitpipe::thesis {

struct ExperimentOptions {
  /// Maps a name of the thesis's scenes ("Bunny") to a mesh or scene file or a built-in scene that replaces
  /// the stand-in. A scene with neither has no figures of ours.
  std::map<std::string, std::string> scenes;
  /// Only these of the table's scenes; empty: all.
  std::vector<std::string> only;
  int width = 256;  ///< the thesis: 2048 x 2048
  int height = 256;
  std::optional<std::uint64_t> triangles;  ///< size of stand-ins that scale; nothing: their default sizes
  int repeats = 6;                         ///< timed runs; with 6 or more times have intervals
  int threads = 1;                         ///< for runs that only count; timed runs have one thread
  /// Called from any thread with the finished share, 0..1.
  std::function<void(double)> progress = [](double) {};
};

struct Experiment {
  std::string_view number;  ///< "3.1"; "text" for the statements that have no table
  ResultTable (*run)(std::string_view number, const ExperimentOptions& options);
};

/// All experiments, in the thesis's order.
[[nodiscard]] std::span<const Experiment> experiments();

/// Those, and what section 8.2 proposes: "adaptive", "grid", "kd". The thesis prints no figures of these.
[[nodiscard]] std::span<const Experiment> experiments_and_proposals();

/// Throws std::runtime_error for an unknown number, with one line that lists the known numbers.
[[nodiscard]] const Experiment& find_experiment(std::string_view number,
                                                std::span<const Experiment> among = experiments());

}  // namespace hitpipe::thesis
