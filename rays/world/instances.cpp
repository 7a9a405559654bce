#include "rays/world/instances.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "rays/world/int_boxes.hpp"

namespace hitpipe::ref {

namespace {

/// Corners as they are, in binary32, which holds them: a hierarchy does not depend on units.
Mesh as_mesh(std::span<const IntTriangle> triangles) {
  Mesh mesh;
  mesh.vertices.reserve(3 * triangles.size());
  mesh.triangles.reserve(triangles.size());
  for (const IntTriangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, y, z] : triangle.corners) mesh.vertices.emplace_back(x, y, z);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

BuildOptions exact(BuildOptions options) {
  options.padding = 0.0F;
  options.min_split = 0.0F;
  options.grid_bits = 0;
  return options;
}

/// A hierarchy over boxes: each is that of a triangle from its least corner to its greatest.
Bvh over_boxes(std::span<const IntBox> boxes, BuildOptions options) {
  std::vector<IntTriangle> triangles;
  triangles.reserve(boxes.size());
  for (const IntBox& box : boxes) triangles.push_back({{box.min, box.max, box.min}});
  options.max_triangles = 1;
  return build_bvh(as_mesh(triangles), exact(options));
}

/// Calls visit(triangle) for what is below the node.
template <class Visit>
void each_below(const Bvh& bvh, std::uint32_t node, const Visit& visit) {
  std::vector<std::uint32_t> waiting{node};
  while (!waiting.empty()) {
    const BvhNode& at = bvh.nodes[waiting.back()];
    waiting.pop_back();
    if (at.is_leaf()) {
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(at.count); ++i) visit(bvh.order[at.first + i]);
    } else {
      waiting.insert(waiting.end(), {at.first, at.first + 1});
    }
  }
}

/// Throws std::out_of_range if a corner below the node leaves the grid.
void check_corners(const IntObject& mesh, std::uint32_t node, const GridMap& map, std::int64_t largest) {
  each_below(mesh.bvh(), node, [&](std::uint32_t triangle) {
    for (const IntTriangle::Corner& corner : mesh.triangles()[triangle].corners) {
      const GridMap::Place place = map.place(corner);
      for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(place[k]) > largest)
          throw std::out_of_range(
              fmt::format("triangle {} has a corner at {} = {} of the grid; allowed is -{} to {}", triangle,
                          "xyz"[k], place[k], largest, largest));
    }
  });
}

/// Work on one is short.
constexpr std::size_t instances_at_once = 256;
constexpr std::size_t nodes_at_once = 4096;

/// An entry is opened if its box has so many times the area of the usual one. Smaller ones would gain less than their
/// own blocks cost.
constexpr double large_area = 4;

std::size_t most_entries(std::size_t instances) {
  return instances + std::max<std::size_t>(instances / 4, 64);
}

double half_area(const IntBox& box) {
  std::array<double, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) side[k] = static_cast<double>(box.max[k]) - box.min[k];
  return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

}  // namespace

IntObject::IntObject(std::vector<IntTriangle> triangles, const BuildOptions& options)
    : triangles_(std::move(triangles)), bvh_(build_bvh(as_mesh(triangles_), exact(options))) {
  boxes_ = int_boxes(triangles_, bvh_);
  for (std::size_t k = 0; k < 3; ++k)
    most_[k] = std::max(std::abs(boxes_[0].min[k]), std::abs(boxes_[0].max[k]));
  cover_ = cover(0);
}

BoxCover IntObject::cover(std::uint32_t node) const {
  std::vector<std::uint32_t> nodes{node};
  const auto area = [&](std::uint32_t i) { return bvh_.nodes[i].is_leaf() ? -1.0 : half_area(boxes_[i]); };
  while (nodes.size() < BoxCover::most) {  // the largest are opened first
    const auto largest = std::max_element(
        nodes.begin(), nodes.end(), [&](std::uint32_t a, std::uint32_t b) { return area(a) < area(b); });
    const BvhNode& branch = bvh_.nodes[*largest];
    if (branch.is_leaf()) break;
    *largest = branch.first;
    nodes.push_back(branch.first + 1);
  }
  std::vector<IntBox> boxes;
  for (const std::uint32_t i : nodes) boxes.push_back(boxes_[i]);
  return BoxCover(boxes);
}

ObjectSpace IntInstances::space_of(std::uint32_t instance, std::uint32_t node, const GridMap& map) const {
  const IntObject& mesh = mesh_of(instance);
  const auto largest = static_cast<std::int32_t>(bits_.largest_corner());
  try {
    const auto [least, most] = node == 0 ? mesh.cover().places(map) : mesh.cover(node).places(map);
    IntBox box;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      inside = inside && least[k] >= -largest && most[k] <= largest;
      // What is beyond the grid has no corner, as is checked below.
      box.min[k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(least[k], -largest, largest));
      box.max[k] = static_cast<std::int32_t>(std::clamp<std::int64_t>(most[k], -largest, largest));
    }
    if (!inside) check_corners(mesh, node, map, largest);
    return object_space(map, mesh.most(), box, bits_);
  } catch (const std::out_of_range& why) {
    throw std::out_of_range(fmt::format("instance {}: {}", instance, why.what()));
  }
}

IntInstances::IntInstances(std::vector<IntObject> meshes, std::vector<IntInstance> instances,
                           const hls::WorldBits& bits, const BuildOptions& options)
    : bits_(bits), meshes_(std::move(meshes)), instances_(std::move(instances)) {
  std::uint64_t count = 0;
  for (std::uint32_t i = 0; i < instances_.size(); ++i) {
    const IntInstance& instance = instances_[i];
    if (instance.mesh >= meshes_.size())
      throw std::invalid_argument(
          fmt::format("instance {}: mesh {}; there are {}", i, instance.mesh, meshes_.size()));
    bases_.push_back(static_cast<std::uint32_t>(count));
    mirrors_.push_back(instance.map.mirrors() ? 1 : 0);
    count += mesh_of(i).triangles().size();
    if (count >= std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument(fmt::format("instance {}: {} triangles with it; allowed are up to {}", i,
                                              count, std::numeric_limits<std::uint32_t>::max() - 1));
  }
  bases_.push_back(static_cast<std::uint32_t>(count));
  if (instances_.empty()) return;
  entries_.resize(instances_.size());
  for (std::uint32_t i = 0; i < entries_.size(); ++i) entries_[i].instance = i;
  make_spaces(0, entries_.size());
  open_large();
  std::vector<IntBox> boxes;
  boxes.reserve(entries_.size());
  for (const Entry& entry : entries_) boxes.push_back(entry.space.box);
  top_ = over_boxes(boxes, options);
  parents_.resize(top_.nodes.size());
  leaves_.resize(entries_.size());
  for (std::uint32_t i = 0; i < top_.nodes.size(); ++i) {
    const BvhNode& node = top_.nodes[i];
    if (!node.is_leaf()) {
      parents_[node.first] = parents_[node.first + 1] = i;
      continue;
    }
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(node.count); ++k)
      leaves_[top_.order[node.first + k]] = i;
  }
  top_boxes_.resize(top_.nodes.size());
  make_top_boxes();
}

/// Opens entries, the largest first, as long as one is larger than most: a ground below a thousand trees would overlap all.
void IntInstances::open_large() {
  std::vector<double> areas;
  for (const Entry& entry : entries_) areas.push_back(half_area(entry.space.box));
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  const double large_from = large_area * *middle;
  const auto smaller = [&](std::uint32_t a, std::uint32_t b) {
    return half_area(entries_[a].space.box) < half_area(entries_[b].space.box);
  };
  std::vector<std::uint32_t> large;
  for (std::uint32_t i = 0; i < entries_.size(); ++i)
    if (half_area(entries_[i].space.box) > large_from) large.push_back(i);
  std::make_heap(large.begin(), large.end(), smaller);
  const std::size_t most = most_entries(entries_.size());
  while (!large.empty() && entries_.size() < most) {
    std::pop_heap(large.begin(), large.end(), smaller);
    const std::uint32_t at = large.back();
    large.pop_back();
    const auto [instance, node, space] = entries_[at];
    const BvhNode& branch = mesh_of(instance).bvh().nodes[node];
    if (branch.is_leaf()) continue;
    const GridMap& map = instances_[instance].map;
    entries_[at] = {instance, branch.first, space_of(instance, branch.first, map)};
    entries_.push_back({instance, branch.first + 1, space_of(instance, branch.first + 1, map)});
    for (const std::uint32_t part : {at, static_cast<std::uint32_t>(entries_.size() - 1)}) {
      if (half_area(entries_[part].space.box) <= large_from) continue;
      large.push_back(part);
      std::push_heap(large.begin(), large.end(), smaller);
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.instance != b.instance ? a.instance < b.instance : a.node < b.node;
  });
}

IntBox IntInstances::box_of(std::uint32_t node) const {
  const BvhNode& its = top_.nodes[node];
  if (!its.is_leaf()) return union_of(top_boxes_[its.first], top_boxes_[its.first + 1]);
  IntBox box = entries_[top_.order[its.first]].space.box;
  for (std::uint32_t k = 1; k < static_cast<std::uint32_t>(its.count); ++k)
    box = union_of(box, entries_[top_.order[its.first + k]].space.box);
  return box;
}

void IntInstances::make_top_boxes() {
  // Leaves first, by all threads. Children are behind their branches.
  host::for_each_block(0, top_.nodes.size(), nodes_at_once, [&](std::size_t first, std::size_t last) {
    for (auto i = static_cast<std::uint32_t>(first); i < last; ++i)
      if (top_.nodes[i].is_leaf()) top_boxes_[i] = box_of(i);
  });
  for (auto i = static_cast<std::uint32_t>(top_.nodes.size()); i-- > 0;)
    if (!top_.nodes[i].is_leaf()) top_boxes_[i] = box_of(i);
}

void IntInstances::make_spaces(std::size_t first, std::size_t last) {
  host::for_each_block(first, last, instances_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Entry& entry = entries_[i];
      entry.space = space_of(entry.instance, entry.node, instances_[entry.instance].map);
    }
  });
}

void IntInstances::place(std::uint32_t first, std::vector<GridMap> maps, std::vector<std::uint32_t>& moved) {
  const auto before = [](const Entry& entry, std::uint32_t instance) { return entry.instance < instance; };
  const auto at = [&](std::uint32_t instance) {
    return static_cast<std::uint32_t>(std::lower_bound(entries_.begin(), entries_.end(), instance, before) -
                                      entries_.begin());
  };
  const std::uint32_t from = at(first), to = at(first + static_cast<std::uint32_t>(maps.size()));
  const auto exchange = [&] {
    host::for_each_block(0, maps.size(), instances_at_once, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::swap(instances_[first + i].map, maps[i]);
        mirrors_[first + i] = instances_[first + i].map.mirrors() ? 1 : 0;
      }
    });
  };
  exchange();
  try {
    make_spaces(from, to);
  } catch (...) {
    exchange();
    make_spaces(from, to);  // those from before: a second set of all would cost more than moving does
    throw;
  }
  for (std::uint32_t i = from; i < to; ++i) moved.push_back(i);
  // Of many, each node's box once is less than each path to the root.
  if (to - from > entries_.size() / 16) {
    make_top_boxes();
    return;
  }
  for (std::uint32_t i = from; i < to; ++i) {
    std::uint32_t node = leaves_[i];
    for (;; node = parents_[node]) {
      const IntBox box = box_of(node);
      if (box == top_boxes_[node] && node != leaves_[i]) break;
      top_boxes_[node] = box;
      if (node == 0) break;
    }
  }
}

IntInstances::Part IntInstances::part(std::uint32_t number) const {
  const auto behind = std::upper_bound(bases_.begin(), bases_.end(), number);
  const auto instance = static_cast<std::uint32_t>(behind - bases_.begin() - 1);
  return {instance, number - bases_[instance]};
}

IntTriangle IntInstances::triangle(std::uint32_t instance, std::uint32_t triangle) const {
  const IntInstance& its = instances_[instance];
  const auto& corners = meshes_[its.mesh].triangles()[triangle].corners;
  const bool mirrors = mirrors_[instance] != 0;
  return {{its.map(corners[0]), its.map(corners[mirrors ? 2 : 1]), its.map(corners[mirrors ? 1 : 2])}};
}

std::vector<IntTriangle> flattened(const IntInstances& world) {
  std::vector<IntTriangle> triangles;
  triangles.reserve(world.triangle_count());
  for (std::uint32_t i = 0; i < world.instances().size(); ++i)
    for (std::uint32_t k = 0; k < world.mesh_of(i).triangles().size(); ++k)
      triangles.push_back(world.triangle(i, k));
  return triangles;
}

}  // namespace hitpipe::ref
