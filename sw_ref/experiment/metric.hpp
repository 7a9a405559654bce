// The metrics of chapter 5's tables, by their names in the data files.
#pragma once

#include <optional>
#include <string>

#include "sw_ref/render/render.hpp"

namespace hitpipe::ref {

/// "ray_tri_tests_", "ray_node_tests_", "tris_loaded_" or "nodes_loaded_" with "primary", "secondary" or
/// "shadow": per ray of that kind; nothing if there is no such ray.
[[nodiscard]] inline std::optional<double> per_ray(const RenderCounts& counts, const std::string& metric) {
  const TraceCounts& kind = metric.ends_with("_primary")     ? counts.primary
                            : metric.ends_with("_secondary") ? counts.secondary
                                                             : counts.shadow;
  if (kind.rays == 0) return std::nullopt;
  const std::uint64_t count = metric.starts_with("ray_tri")    ? kind.triangle_tests
                              : metric.starts_with("ray_node") ? kind.box_tests
                              : metric.starts_with("tris")     ? kind.triangles_loaded
                                                               : kind.nodes_loaded;
  return static_cast<double>(count) / static_cast<double>(kind.rays);
}

}  // namespace hitpipe::ref
