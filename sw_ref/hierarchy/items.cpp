#include "sw_ref/hierarchy/items.hpp"

namespace hitpipe::ref {
namespace {

/// Consecutive items on the wrong side of the middle.
struct Run {
  std::size_t first, last;
};

struct Exchange {
  std::size_t low, high, count;
};

/// Pairs the runs of high items below the middle with those of low items above it; there are equally many.
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
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, items.size(), item_block), [&](const auto& block) {
    for (std::size_t i = block.begin(); i < block.end(); ++i) {
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
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    const auto at = [&](std::size_t index) { return items.begin() + static_cast<std::ptrdiff_t>(index); };
    std::swap_ranges(at(pairs[i].low), at(pairs[i].low + pairs[i].count), at(pairs[i].high));
  });
}

}  // namespace hitpipe::ref
