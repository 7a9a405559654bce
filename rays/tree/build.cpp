// Top-down construction. All threads together split a large node. One thread builds each subtree of at most
// `alone` triangles, with a list of pending nodes instead of recursion. The subtrees are then joined in
// depth-first order. Every pending node is the second child of a branch on the path to the current node, so
// the list is never longer than the tree is deep.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "rays/exact/grid.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/tree/split.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::uint32_t alone = 1U << 14U;

void check(const Mesh& mesh, const BuildOptions& options) {
  const auto require = [](bool good, const std::string& reason) {
    if (!good) throw std::invalid_argument("BVH: " + reason);
  };
  require(!mesh.triangles.empty(), "the mesh has no triangle; at least 1 is needed");
  require(mesh.triangles.size() <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()),
          fmt::format("the mesh has {} triangles; at most 2147483647 are allowed", mesh.triangles.size()));
  require(options.max_triangles >= 1,
          fmt::format("{} triangles per leaf; at least 1 is needed", options.max_triangles));
  require(options.max_depth >= 1 && options.max_depth <= BuildOptions::deepest,
          fmt::format("a depth of {} levels; allowed are 1 to 60", options.max_depth));
  require(options.padding >= 0.0F && std::isfinite(options.padding) && options.min_split >= 0.0F,
          "padding and smallest split width must be numbers that are not negative");
  require(options.grid_bits == 0 || (options.grid_bits >= 6 && options.grid_bits <= 32),
          fmt::format("a grid of {} bits; allowed are 6 to 32, or 0 for none", options.grid_bits));
  require(options.threads >= 0,
          fmt::format("{} threads; at least 1 is needed, or 0 for one a core", options.threads));
}

/// The smallest float that is no less than a grid unit, and no less than min_split.
float least_width(const BuildOptions& options) {
  if (options.grid_bits == 0) return options.min_split;
  const double unit = 1.0 / static_cast<double>(grid_scale(options.grid_bits));
  auto width = static_cast<float>(unit);
  if (static_cast<double>(width) < unit) width = std::nextafter(width, 1.0F);
  return std::max(width, options.min_split);
}

/// Rounding is monotone and p - padding <= p <= p + padding, so each rounded sum is still on the outer side
/// of p. The result contains `box` for any padding.
Aabb padded(const Aabb& box, float padding) {
  return {box.min - padding, box.max + padding};
}

struct Pending {
  std::uint32_t first, last;  ///< its items: first <= i < last
  int depth;                  ///< level of the node; the root is 1
  int axis;                   ///< the axis whose turn it is
  std::uint32_t node = 0;     ///< its index in the result
};

/// A node and all nodes below it: either built by one thread, or two subtrees.
struct Subtree {
  BvhNode root;
  std::vector<BvhNode> below;  ///< pairs of children in depth-first order; indices count from the first
  std::array<std::unique_ptr<Subtree>, 2> children;
  int depth = 0;

  [[nodiscard]] std::size_t size() const {
    return children[0] ? 2 + children[0]->size() + children[1]->size() : below.size();
  }
};

class Growth {
 public:
  Growth(std::span<Item> items, const BuildOptions& options)
      : items_(items), options_(options), least_width_(least_width(options)) {}

  [[nodiscard]] Subtree grow(const Pending& at) const {
    if (at.last - at.first <= alone) return grow_alone(at);
    Subtree tree;
    const auto children = split(at, tree.root);
    tree.depth = at.depth;
    if (!children) return tree;
    host::for_each_index(
        2, [&](std::size_t i) { tree.children[i] = std::make_unique<Subtree>(grow((*children)[i])); });
    tree.depth = std::max(tree.children[0]->depth, tree.children[1]->depth);
    return tree;
  }

 private:
  using Children = std::array<Pending, 2>;

  [[nodiscard]] Subtree grow_alone(const Pending& root) const {
    Subtree tree;
    std::vector<Pending> pending;
    const auto visit = [&](const Pending& at, BvhNode& node) {
      const auto children = split(at, node);
      tree.depth = std::max(tree.depth, at.depth);
      if (!children) return;
      node.first = static_cast<std::uint32_t>(tree.below.size());
      tree.below.resize(tree.below.size() + 2);
      for (const std::uint32_t i : {1U, 0U}) {
        pending.push_back((*children)[i]);
        pending.back().node = node.first + i;
      }
    };
    visit(root, tree.root);
    while (!pending.empty()) {
      const Pending at = pending.back();
      pending.pop_back();
      BvhNode node;
      visit(at, node);
      tree.below[at.node] = node;
    }
    tree.below.shrink_to_fit();
    return tree;
  }

  /// Sets the node's box. Completes a leaf; for a branch it sets all but the index of the children, and
  /// returns the children.
  [[nodiscard]] std::optional<Children> split(const Pending& at, BvhNode& node) const {
    const std::uint32_t count = at.last - at.first;
    const Splittable parts{items_.subspan(at.first, count), bounds_of(items_.subspan(at.first, count)),
                           at.axis, least_width_};
    node.box = padded(parts.bounds, options_.padding);
    const std::optional<Split> chosen = choose(parts, at.depth);
    if (!chosen) {
      node.count = static_cast<std::int32_t>(count);
      node.first = at.first;
      return std::nullopt;
    }
    node.count = -1 - chosen->axis;
    node.first = 0;
    const std::uint32_t middle = at.first + static_cast<std::uint32_t>(chosen->middle);
    const int next_axis = (chosen->axis + 1) % 3;
    return Children{
        {{at.first, middle, at.depth + 1, next_axis}, {middle, at.last, at.depth + 1, next_axis}}};
  }

  /// Returns nothing for a leaf.
  [[nodiscard]] std::optional<Split> choose(const Splittable& parts, int depth) const {
    const bool narrow = parts.is_narrow(0) && parts.is_narrow(1) && parts.is_narrow(2);
    if (narrow || parts.items.size() == 1 || depth == options_.max_depth) return std::nullopt;
    if (options_.builder == Builder::sah) return split_by_cost(parts, options_.max_triangles);
    if (parts.items.size() <= static_cast<std::size_t>(options_.max_triangles)) return std::nullopt;
    return split_at_middle(parts);
  }

  std::span<Item> items_;
  const BuildOptions& options_;
  float least_width_;
};

/// Puts the subtree's root at nodes[place] and all nodes below it at the end. Frees the subtree piece by
/// piece.
void append(Subtree& tree, std::size_t place, std::vector<BvhNode>& nodes) {
  const auto base = static_cast<std::uint32_t>(nodes.size());
  const auto moved = [base](BvhNode node) {
    if (!node.is_leaf()) node.first += base;
    return node;
  };
  nodes[place] = moved(tree.root);
  if (!tree.children[0]) {
    for (const BvhNode& node : tree.below) nodes.push_back(moved(node));
    return;
  }
  nodes.resize(nodes.size() + 2);
  for (const std::size_t i : {0U, 1U}) {
    append(*tree.children[i], base + i, nodes);
    tree.children[i].reset();
  }
}

}  // namespace

std::string_view builder_name(Builder builder) {
  return builder == Builder::sah ? "sah" : "median";
}

Bvh build_bvh(const Mesh& mesh, const BuildOptions& options) {
  check(mesh, options);
  Bvh bvh;
  Subtree tree;
  host::with_threads(options.threads, [&] {
    std::vector<Item> items = make_items(mesh);
    tree = Growth(items, options).grow({0, static_cast<std::uint32_t>(items.size()), 1, 0});
    bvh.order.reserve(items.size());
    for (const Item& item : items) bvh.order.push_back(item.triangle);
  });
  bvh.depth = tree.depth;
  bvh.nodes.reserve(1 + tree.size());
  bvh.nodes.emplace_back();
  append(tree, 0, bvh.nodes);
  return bvh;
}

}  // namespace hitpipe::ref
