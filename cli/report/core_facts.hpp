// What a report tells of the core (docs/core.md): a small picture of the scene, traced cycle by cycle by
// cores of several formats and sizes, with several memories. Every answer is compared with software.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "area_model/core_price.hpp"
#include "cli/text/table.hpp"
#include "hls/world/world_format.hpp"
#include "sim/core/core_trace.hpp"
#include "sw_ref/hierarchy/load_bvh.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::cli {

/// A core and its memory, as options of `hitpipe core trace`.
struct CoreSetting {
  hls::WorldBits world{};
  int triangle_interval = 4;
  int rays = 128;                ///< in flight
  std::string memory = "ideal";  ///< a built-in one of `core trace --memory`
  int latency = 100;             ///< of `ideal`, in cycles
  int cache_kib = 0;

  /// Formats have no comparison of their own.
  friend bool operator==(const CoreSetting& a, const CoreSetting& b);
};

struct CoreResult {
  CoreSetting setting;
  area::CorePartPrice price;
  sim::CoreTrace trace;
};

struct CoreFacts {
  std::string why_not;  ///< one line; empty where the core has traced
  int width = 0, height = 0;
  std::vector<CoreResult> results;                        ///< by setting, each once
  std::vector<std::size_t> rates, busy, cache, memories;  ///< places in `results` that a plot shows
  std::vector<Row> rows;              ///< of the results: setting, figures, price, command
  std::vector<std::string> commands;  ///< that make the rows, with all rays in flight of a core

  /// Answers that are not software's, and results whose reads are not.
  [[nodiscard]] std::uint64_t wrong() const;
  [[nodiscard]] std::uint64_t other_reads() const;
};

struct CoreMeasurement {
  const rtl::Library* library;
  std::string library_option;  ///< " --library xc7", or nothing for the default; for the commands
  std::string scene_options;   ///< as a user writes them, without the picture's size; for the commands
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  int width = 256;  ///< of the report's pictures
  int height = 256;
  int threads = 1;
  std::function<void(double)> progress = [](double) {};
};

/// A scene that the core cannot have in its memory, or a library without a component that it needs, is told
/// in `why_not`.
[[nodiscard]] CoreFacts measure_core(const ref::Scene& scene, const CoreMeasurement& how);

}  // namespace hitpipe::cli
