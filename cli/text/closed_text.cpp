#include "cli/text/closed_text.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

namespace hitpipe::cli {

namespace {

Row truth(bool is, OutputFormat format) {
  return format == OutputFormat::json ? Row(is) : Row(is ? "yes" : "no");
}

std::string corner_text(const glm::dvec3& p) {
  return fmt::format("{:.5g} {:.5g} {:.5g}", p.x, p.y, p.z);
}

Row corner_row(const glm::dvec3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

Row closed_row(const ref::Scene& scene, std::span<const glm::dvec3> vertices, OutputFormat format) {
  const ref::Closedness found = ref::closedness(scene.mesh);
  Row row{{"closed", truth(found.closed(), format)},
          {"oriented", truth(found.oriented(), format)},
          {"edges", found.edges},
          {"odd_edges", found.odd},
          {"open_edges", found.open},
          {"turned_edges", found.turned},
          {"crowded_edges", found.crowded},
          {"t_junctions", found.t_junctions},
          {"first_odd_edges", Row::array()},
          {"first_t_junctions", Row::array()}};
  const std::vector<glm::vec3>& placed = scene.mesh.vertices;
  const auto own = [&](const glm::vec3& p) {
    return vertices[static_cast<std::size_t>(std::find(placed.begin(), placed.end(), p) - placed.begin())];
  };
  const bool json = format == OutputFormat::json;
  for (const ref::OddEdge& edge : found.first_odd) {
    Row& all = row["first_odd_edges"];
    if (json) {
      all.push_back({{"from", corner_row(own(edge.from))},
                     {"to", corner_row(own(edge.to))},
                     {"triangle", edge.triangle}});
    } else {
      all.push_back(fmt::format("of {} from {}", edge.triangle, corner_text(own(edge.from))));
      all.push_back(fmt::format("  to {}", corner_text(own(edge.to))));
    }
  }
  for (const ref::TJunction& each : found.first_junctions) {
    Row& all = row["first_t_junctions"];
    if (json) {
      all.push_back({{"corner", corner_row(own(each.corner))}, {"triangle", each.triangle}});
    } else {
      all.push_back(fmt::format("of {} at {}", each.triangle, corner_text(own(each.corner))));
    }
  }
  return row;
}

Row even_row(const ref::Closedness& found, OutputFormat format) {
  return {{"closed", truth(found.even(), format)}, {"open_edges", found.open}};
}

}  // namespace hitpipe::cli
