#include "rays/tree/split.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

namespace {

/// Consecutive items on the wrong side of the middle.
struct Run {
  std::size_t first, last;
};

struct Exchange {
  std::size_t low, high, count;
};

/// Pairs the runs of high items below the middle with the runs of low items above it. Both hold equally many
/// items.
std::vector<Exchange> pair_up(std::vector<Run> highs, std::vector<Run> lows) {
  std::vector<Exchange> pairs;
  for (std::size_t h = 0, l = 0; h < highs.size() && l < lows.size();) {
    const std::size_t count = std::min(highs[h].last - highs[h].first, lows[l].last - lows[l].first);
    pairs.push_back({lows[l].first, highs[h].first, count});
    highs[h].first += count;
    lows[l].first += count;
    if (highs[h].first == highs[h].last) ++h;
    if (lows[l].first == lows[l].last) ++l;
  }
  return pairs;
}

}  // namespace

std::vector<Item> make_items(const Mesh& mesh) {
  std::vector<Item> items(mesh.triangles.size());
  host::for_each_block(0, items.size(), item_block, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      items[i].triangle = static_cast<std::uint32_t>(i);
      const Mesh::Corners corners = mesh.corners(items[i].triangle);
      items[i].box.grow(corners.a);
      items[i].box.grow(corners.b);
      items[i].box.grow(corners.c);
    }
  });
  return items;
}

Aabb bounds_of(std::span<const Item> items) {
  return over_items(
      items, Aabb{}, [](Aabb& bounds, const Item& item) { bounds.grow(item.box); },
      [](Aabb& bounds, const Aabb& other) { bounds.grow(other); });
}

void join_blocks(std::span<Item> items, const std::vector<std::size_t>& lows, std::size_t middle) {
  std::vector<Run> highs_below;
  std::vector<Run> lows_above;
  for (std::size_t i = 0; i < lows.size(); ++i) {
    const std::size_t first = i * item_block;
    const std::size_t last = std::min(first + item_block, items.size());
    const Run high{first + lows[i], std::min(last, middle)};
    const Run low{std::max(first, middle), first + lows[i]};
    if (high.first < high.last) highs_below.push_back(high);
    if (low.first < low.last) lows_above.push_back(low);
  }
  const std::vector<Exchange> pairs = pair_up(std::move(highs_below), std::move(lows_above));
  host::for_each_index(pairs.size(), [&](std::size_t i) {
    const auto at = [&](std::size_t index) { return items.begin() + static_cast<std::ptrdiff_t>(index); };
    std::swap_ranges(at(pairs[i].low), at(pairs[i].low + pairs[i].count), at(pairs[i].high));
  });
}

Split split_at_middle(const Splittable& node) {
  const glm::vec3 low = node.bounds.min;
  const glm::vec3 extent = node.bounds.max - low;
  for (int tried = 0; tried < 3; ++tried) {
    const int axis = (node.axis + tried) % 3;
    if (node.is_narrow(axis)) continue;
    const float pivot = low[axis] + extent[axis] * 0.5F;
    const std::size_t middle =
        partition(node.items, [=](const Item& item) { return item.centre(axis) < pivot; });
    if (middle != 0 && middle != node.items.size()) return {middle, axis};
  }
  return {node.items.size() / 2, node.axis};
}

namespace {

constexpr std::size_t most_bins = 32;

/// Few triangles need only few bins.
std::size_t bins_for(std::size_t items) {
  return std::min(items + 2, most_bins);
}

struct Bin {
  Aabb box;
  std::uint32_t items = 0;

  void add(const Bin& other) {
    box.grow(other.box);
    items += other.items;
  }
  [[nodiscard]] float cost() const { return half_area(box) * static_cast<float>(items) * intersection_cost; }
};
using Bins = std::array<Bin, most_bins>;

/// The centres' range along an axis, cut into bins of equal width.
struct Scale {
  float low = 0;
  float bins_per_unit = 0;
  std::size_t last_bin = 0;

  /// Rounding is monotone: an item's bin does not fall as its centre rises. The lowest centre is in the first
  /// bin, the highest in the last.
  [[nodiscard]] std::size_t bin(float centre) const {
    return std::min(static_cast<std::size_t>((centre - low) * bins_per_unit), last_bin);
  }
};

/// The scale is 0 along an axis that cannot be split: a narrow one, or one along which all centres are equal.
std::array<Scale, 3> scales_of(const Splittable& node) {
  const Aabb centres = over_items(
      std::span<const Item>(node.items), Aabb{},
      [](Aabb& bounds, const Item& item) {
        bounds.grow(glm::vec3(item.centre(0), item.centre(1), item.centre(2)));
      },
      [](Aabb& bounds, const Aabb& other) { bounds.grow(other); });
  const std::size_t bins = bins_for(node.items.size());
  std::array<Scale, 3> scales;
  for (int axis = 0; axis < 3; ++axis) {
    const float bins_per_unit = static_cast<float>(bins) / (centres.max[axis] - centres.min[axis]);
    if (node.is_narrow(axis) || !std::isfinite(bins_per_unit)) continue;
    scales[static_cast<std::size_t>(axis)] = {centres.min[axis], bins_per_unit, bins - 1};
  }
  return scales;
}

std::array<Bins, 3> fill_bins(std::span<const Item> items, const std::array<Scale, 3>& scales) {
  return over_items(
      items, std::array<Bins, 3>{},
      [&](std::array<Bins, 3>& bins, const Item& item) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          Bin& bin = bins[axis][scales[axis].bin(item.centre(static_cast<int>(axis)))];
          bin.box.grow(item.box);
          ++bin.items;
        }
      },
      [](std::array<Bins, 3>& bins, const std::array<Bins, 3>& other) {
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (std::size_t i = 0; i < most_bins; ++i) bins[axis][i].add(other[axis][i]);
      });
}

/// The bins below `bin` become child 0.
struct Candidate {
  float cost = std::numeric_limits<float>::infinity();  ///< cost of both children's triangles, times the area
  std::size_t axis = 0;
  std::size_t bin = 0;
};

/// Keeps the cheapest; among equals the first.
void try_boundaries(const Bins& bins, std::size_t count, std::size_t axis, Candidate& best) {
  std::array<float, most_bins> above{};
  Bin high;
  for (std::size_t i = count - 1; i > 0; --i) {
    high.add(bins[i]);
    above[i] = high.items == 0 ? std::numeric_limits<float>::infinity() : high.cost();
  }
  Bin low;
  for (std::size_t i = 1; i < count; ++i) {
    low.add(bins[i - 1]);
    if (low.items == 0) continue;
    const float cost = low.cost() + above[i];
    if (cost < best.cost) best = {cost, axis, i};
  }
}

int widest_axis(const Aabb& box) {
  const glm::vec3 extent = box.max - box.min;
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

}  // namespace

std::optional<Split> split_by_cost(const Splittable& node, int max_triangles) {
  const std::array<Scale, 3> scales = scales_of(node);
  const std::array<Bins, 3> bins = fill_bins(node.items, scales);
  Candidate best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (scales[axis].bins_per_unit > 0) try_boundaries(bins[axis], scales[axis].last_bin + 1, axis, best);
  }
  const float area = half_area(node.bounds);
  const float leaf = area * static_cast<float>(node.items.size()) * intersection_cost;
  const bool may_be_leaf = node.items.size() <= static_cast<std::size_t>(max_triangles);
  if (may_be_leaf && leaf <= area * traversal_cost + best.cost) return std::nullopt;
  if (best.bin == 0) return Split{node.items.size() / 2, widest_axis(node.bounds)};
  const Scale scale = scales[best.axis];
  const int axis = static_cast<int>(best.axis);
  return Split{
      partition(node.items, [=](const Item& item) { return scale.bin(item.centre(axis)) < best.bin; }), axis};
}

}  // namespace hitpipe::ref
