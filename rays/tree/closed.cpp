#include "rays/tree/closed.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <utility>

#include "rays/exact/exact_triangle.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

namespace {

/// Numbers of positions in the order of their coordinates. So positions on a line have ascending numbers along
/// it, and a direction: from the lower number to the higher.
struct Places {
  std::vector<glm::vec3> at;
  std::vector<std::uint32_t> of_vertex;
};

auto coordinates(const glm::vec3& p) {
  return std::tie(p.x, p.y, p.z);
}

Places places_of(const std::vector<glm::vec3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return coordinates(vertices[i]) < coordinates(vertices[j]);
  });
  Places made;
  made.of_vertex.resize(vertices.size());
  for (const std::uint32_t vertex : order) {
    // -0 is equal to 0.
    if (made.at.empty() || made.at.back() != vertices[vertex]) made.at.push_back(vertices[vertex]);
    made.of_vertex[vertex] = static_cast<std::uint32_t>(made.at.size() - 1);
  }
  return made;
}

/// A part of a line between two places, how often triangles have it, and how often more from low to high than
/// back.
struct Stretch {
  std::uint32_t low = 0, high = 0;
  std::int32_t times = 0;
  std::int32_t ways = 0;
  std::uint32_t triangle = 0;  ///< the lowest that has it

  [[nodiscard]] bool odd() const { return times % 2 != 0; }
};

/// Equal ones become one. They are in the order of their ends.
void join_equal(std::vector<Stretch>& all) {
  std::sort(all.begin(), all.end(), [](const Stretch& a, const Stretch& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept > 0 && all[kept - 1].low == all[i].low && all[kept - 1].high == all[i].high) {
      all[kept - 1].times += all[i].times;
      all[kept - 1].ways += all[i].ways;
    } else {
      all[kept++] = all[i];
    }
  }
  all.resize(kept);
}

/// The edges of all triangles, each once.
std::vector<Stretch> edges_of(const Mesh& mesh, const Places& places) {
  std::vector<Stretch> edges;
  edges.reserve(3 * (mesh.triangles.size() + mesh.dropped_corners.size()));
  const auto add = [&](const glm::uvec3& triangle, std::uint32_t number) {
    std::array<std::uint32_t, 3> c{};
    for (int i = 0; i < 3; ++i) c[static_cast<std::size_t>(i)] = places.of_vertex[triangle[i]];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(c[i], c[(i + 1) % 3]);
      edges.push_back({low, high, 1, low == c[i] ? 1 : -1, number});
    }
  };
  const TriangleNumbers numbers(mesh);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) add(mesh.triangles[i], numbers.of_source(i));
  for (std::size_t i = 0; i < mesh.dropped_corners.size(); ++i) add(mesh.dropped_corners[i], mesh.dropped[i]);
  join_equal(edges);
  return edges;
}

/// A corner on an edge, between its ends.
struct OnEdge {
  std::size_t edge;
  std::uint32_t corner;
};

bool holds(const Aabb& box, const glm::vec3& p) {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < box.min[axis] || p[axis] > box.max[axis]) return false;
  return true;
}

bool is_between(const Places& places, const Stretch& edge, std::uint32_t corner) {
  if (corner <= edge.low || corner >= edge.high) return false;
  const glm::vec3& a = places.at[edge.low];
  const glm::vec3& b = places.at[edge.high];
  const glm::vec3& p = places.at[corner];
  // On the line, and between the ends in the order of coordinates.
  return !has_area(Mesh::Corners{a, b, p});
}

/// By edge, and along each.
std::vector<OnEdge> corners_on_edges(const std::vector<Stretch>& edges, const Places& places) {
  if (edges.empty()) return {};
  Mesh as_mesh;  // a triangle with two equal corners for each edge: its box is the edge's
  as_mesh.vertices = places.at;
  std::vector<std::uint32_t> ends;
  for (const Stretch& edge : edges) {
    as_mesh.triangles.emplace_back(edge.low, edge.high, edge.high);
    ends.insert(ends.end(), {edge.low, edge.high});
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const Bvh bvh = build_bvh(as_mesh, {.max_triangles = 2, .padding = 0.0F, .min_split = 0.0F});
  std::vector<OnEdge> found;
  std::vector<std::uint32_t> waiting;
  for (const std::uint32_t corner : ends) {
    waiting.push_back(0);
    while (!waiting.empty()) {
      const BvhNode& node = bvh.nodes[waiting.back()];
      waiting.pop_back();
      if (!holds(node.box, places.at[corner])) continue;
      if (!node.is_leaf()) {
        waiting.insert(waiting.end(), {node.first, node.first + 1});
        continue;
      }
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(node.count); ++i) {
        const std::uint32_t edge = bvh.order[node.first + i];
        if (is_between(places, edges[edge], corner)) found.push_back({edge, corner});
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const OnEdge& a, const OnEdge& b) {
    return std::tie(a.edge, a.corner) < std::tie(b.edge, b.corner);
  });
  return found;
}

/// The edges, cut where corners lie on them.
std::vector<Stretch> parts_of(const std::vector<Stretch>& edges, const std::vector<OnEdge>& corners) {
  std::vector<Stretch> parts;
  auto next = corners.begin();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Stretch rest = edges[i];
    for (; next != corners.end() && next->edge == i; ++next) {
      Stretch part = rest;
      part.high = rest.low = next->corner;
      parts.push_back(part);
    }
    parts.push_back(rest);
  }
  join_equal(parts);
  return parts;
}

/// The first of them, in this order.
template <class Element, class Before>
void keep_first(std::vector<Element>& all, Before before) {
  const std::size_t most = std::min(all.size(), Closedness::most_places);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most), all.end(), before);
  all.resize(most);
}

void add_first_odd(std::vector<Stretch> edges, const Places& places, Closedness& found) {
  std::erase_if(edges, [](const Stretch& edge) { return !edge.odd(); });
  keep_first(edges, [](const Stretch& a, const Stretch& b) {
    return std::tie(a.triangle, a.low, a.high) < std::tie(b.triangle, b.low, b.high);
  });
  for (const Stretch& edge : edges)
    found.first_odd.push_back({places.at[edge.low], places.at[edge.high], edge.triangle});
}

void add_t_junctions(const std::vector<Stretch>& edges, std::vector<OnEdge> corners, const Places& places,
                     Closedness& found) {
  std::erase_if(corners, [&](const OnEdge& each) { return !edges[each.edge].odd(); });
  // Each corner once, with the lowest triangle.
  const auto triangle = [&](const OnEdge& each) { return edges[each.edge].triangle; };
  std::sort(corners.begin(), corners.end(), [&](const OnEdge& a, const OnEdge& b) {
    return std::pair(a.corner, triangle(a)) < std::pair(b.corner, triangle(b));
  });
  corners.erase(std::unique(corners.begin(), corners.end(),
                            [](const OnEdge& a, const OnEdge& b) { return a.corner == b.corner; }),
                corners.end());
  found.t_junctions = corners.size();
  keep_first(corners, [&](const OnEdge& a, const OnEdge& b) {
    return std::pair(triangle(a), a.corner) < std::pair(triangle(b), b.corner);
  });
  for (const OnEdge& each : corners)
    found.first_junctions.push_back({places.at[each.corner], triangle(each)});
}

}  // namespace

Closedness closedness(const Mesh& mesh) {
  const Places places = places_of(mesh.vertices);
  std::vector<Stretch> edges = edges_of(mesh, places);
  Closedness found;
  found.edges = edges.size();
  for (const Stretch& edge : edges) {
    found.odd += edge.odd() ? 1 : 0;
    found.turned += edge.ways != 0 ? 1 : 0;
    found.crowded += edge.times > 2 ? 1 : 0;
  }
  // An odd edge is turned, too.
  std::erase_if(edges, [](const Stretch& edge) { return edge.ways == 0; });
  const std::vector<OnEdge> corners = corners_on_edges(edges, places);
  for (const Stretch& part : parts_of(edges, corners)) {
    found.open += part.odd() ? 1 : 0;
    found.open_turned += part.ways != 0 ? 1 : 0;
  }
  add_first_odd(edges, places, found);
  add_t_junctions(edges, corners, places, found);
  return found;
}

}  // namespace hitpipe::ref
