#include "rays/files/gltf_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace hitpipe::ref {
namespace {

constexpr std::uint32_t no_gltf_node = std::numeric_limits<std::uint32_t>::max();

glm::dmat4 gltf_matrix(const Place& place) {
  const std::vector<double> numbers = place.numbers(16);
  if (numbers[3] != 0 || numbers[7] != 0 || numbers[11] != 0 || numbers[15] != 1)
    place.fail("has no 0, 0, 0, 1 in its last row; allowed are matrices without perspective");
  glm::dmat4 matrix;
  std::size_t next = 0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) matrix[column][row] = numbers[next++];
  }
  return matrix;
}

/// A rotation has the length 1 but for rounding, which is taken out.
std::array<double, 4> gltf_quaternion(const Place& place) {
  const std::vector<double> numbers = place.numbers(4);
  const std::array<double, 4> q{numbers[0], numbers[1], numbers[2], numbers[3]};
  constexpr double rounding = 0.01;
  if (const double length = gltf_length(q); !(std::abs(length - 1) <= rounding))
    place.fail(fmt::format("has the length {}; a quaternion must have the length 1", length));
  return q;
}

glm::dmat4 gltf_rotation(const std::array<double, 4>& q) {
  const double length = gltf_length(q);
  const double x = q[0] / length;
  const double y = q[1] / length;
  const double z = q[2] / length;
  const double w = q[3] / length;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0},
          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0},
          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0},
          {0, 0, 0, 1}};
}

GltfTransform gltf_transform(const Place& node) {
  if (node.has("matrix")) {
    if (node.has("translation") || node.has("rotation") || node.has("scale"))
      node.fail("has a matrix, and also translation, rotation or scale; only one of both is allowed");
    return gltf_signed(gltf_matrix(node.at("matrix")));
  }
  GltfParts parts;
  if (node.has("rotation")) parts.rotation = gltf_quaternion(node.at("rotation"));
  if (node.has("scale")) parts.scale = node.at("scale").vector();
  if (node.has("translation")) parts.translation = node.at("translation").vector();
  return gltf_transform(parts);
}

}  // namespace

double gltf_length(const std::array<double, 4>& q) {
  return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

GltfTransform gltf_transform(const GltfParts& parts) {
  GltfTransform transform;
  if (parts.rotation) transform.matrix = gltf_rotation(*parts.rotation);
  for (int k = 0; parts.scale && k < 3; ++k) {
    const double scale = (*parts.scale)[k];
    transform.matrix[k] *= scale;
    transform.sign *= (scale > 0) - (scale < 0);
  }
  if (parts.translation) transform.matrix[3] = glm::dvec4(*parts.translation, 1.0);
  return transform;
}

GltfTransform gltf_signed(const glm::dmat4& matrix) {
  std::array<glm::dvec3, 3> columns;
  for (int k = 0; k < 3; ++k) {
    // Columns are scaled, so that no product leaves the range of a double.
    const glm::dvec3 column(matrix[k]);
    const double largest = std::max({std::abs(column.x), std::abs(column.y), std::abs(column.z)});
    columns[static_cast<std::size_t>(k)] = largest > 0 ? column / largest : column;
  }
  const double determinant = glm::dot(glm::cross(columns[0], columns[1]), columns[2]);
  constexpr double rounding = 0x1p-48;
  return {matrix, determinant > rounding ? 1 : determinant < -rounding ? -1 : 0};
}

GltfNodes::GltfNodes(const GltfDocument& document) : document_(document) {
  read_parents();
  check_cycles();
  read_roots();
}

void GltfNodes::read_parents() {
  parents_.assign(document_.size("nodes"), no_gltf_node);
  for (std::uint32_t n = 0; n < parents_.size(); ++n) {
    const Place node = document_.item("nodes", n);
    if (!node.has("children")) continue;
    for (const Place& child : node.at("children").elements()) {
      std::uint32_t& parent = parents_[document_.index("nodes", child)];
      if (parent != no_gltf_node)
        child.fail(fmt::format("node {} is a child of node {} too; a node has one parent",
                               child.count(no_gltf_node), parent));
      parent = n;
    }
  }
}

/// A node is below itself if going up never ends.
void GltfNodes::check_cycles() const {
  std::vector<bool> ends(parents_.size(), false);
  std::vector<std::uint32_t> way;
  for (std::uint32_t n = 0; n < parents_.size(); ++n) {
    way.clear();
    std::uint32_t above = n;
    for (; above != no_gltf_node && !ends[above] && way.size() <= parents_.size(); above = parents_[above])
      way.push_back(above);
    if (way.size() > parents_.size())
      document_.item("nodes", std::size_t{above}).fail("is below itself; nodes must be trees");
    for (const std::uint32_t node : way) ends[node] = true;
  }
}

void GltfNodes::read_roots() {
  if (document_.size("scenes") == 0) {
    if (document_.top().has("scene"))
      static_cast<void>(document_.index("scenes", document_.top().at("scene")));
    for (std::uint32_t n = 0; n < parents_.size(); ++n) {
      if (parents_[n] == no_gltf_node) roots_.push_back(n);
    }
    return;
  }
  const Place scene = document_.top().has("scene") ? document_.item("scenes", document_.top().at("scene"))
                                                   : document_.item("scenes", std::size_t{0});
  if (!scene.has("nodes")) return;
  std::vector<bool> listed(parents_.size(), false);
  for (const Place& number : scene.at("nodes").elements()) {
    const auto node = static_cast<std::uint32_t>(document_.index("nodes", number));
    if (parents_[node] != no_gltf_node)
      number.fail(fmt::format("node {} is a child of node {}; a scene has nodes without parent", node,
                              parents_[node]));
    if (listed[node]) number.fail(fmt::format("node {} is in the scene twice; it may be once", node));
    listed[node] = true;
    roots_.push_back(node);
  }
}

void GltfNodes::visit(
    const std::function<void(const Place&, std::size_t, const GltfTransform&)>& call) const {
  struct Level {
    std::uint32_t node;
    GltfTransform transform;
    std::size_t next_child;
  };
  std::vector<Level> levels;
  const auto enter = [&](std::uint32_t n) {
    const Place node = document_.item("nodes", std::size_t{n});
    const GltfTransform own = gltf_transform(node);
    levels.push_back({n, levels.empty() ? own : levels.back().transform * own, 0});
    call(node, n, levels.back().transform);
  };
  for (const std::uint32_t root : roots_) {
    enter(root);
    while (!levels.empty()) {
      Level& level = levels.back();
      const Place node = document_.item("nodes", std::size_t{level.node});
      if (!node.has("children") || level.next_child == node.at("children").size())
        levels.pop_back();
      else
        enter(static_cast<std::uint32_t>(
            document_.index("nodes", node.at("children").element(level.next_child++))));
    }
  }
}

}  // namespace hitpipe::ref
