// The metrics of chapter 5's tables, by their names in the data files.
#pragma once

#include <optional>
#include <string>

#include "sw_ref/render/recording.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// "ray_tri_tests_", "ray_node_tests_", "tris_loaded_" or "nodes_loaded_" with "primary", "secondary" or
/// "shadow".
[[nodiscard]] inline RayKind kind_of(const std::string& metric) {
  if (metric.ends_with("_primary")) return RayKind::primary;
  return metric.ends_with("_secondary") ? RayKind::secondary : RayKind::shadow;
}

[[nodiscard]] inline Count count_of(const std::string& metric) {
  if (metric.starts_with("ray_tri")) return &TraceCounts::triangle_tests;
  if (metric.starts_with("ray_node")) return &TraceCounts::box_tests;
  return metric.starts_with("tris") ? &TraceCounts::triangles_loaded : &TraceCounts::nodes_loaded;
}

/// Per ray of the metric's kind; nothing if there is no such ray.
[[nodiscard]] inline std::optional<double> per_ray(RenderCounts counts, const std::string& metric) {
  const TraceCounts& kind = counts.of(kind_of(metric));
  if (kind.rays == 0) return std::nullopt;
  return static_cast<double>(kind.*count_of(metric)) / static_cast<double>(kind.rays);
}

}  // namespace hitpipe::thesis
