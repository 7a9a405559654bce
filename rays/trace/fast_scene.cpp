#include "rays/trace/fast_scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "host/parallel.hpp"
#include "rays/tree/small_leaves.hpp"
#include "rays/tree/wide_nodes.hpp"

namespace hitpipe::ref {

namespace {

constexpr int most_in_pack = TrianglePack::size;

template <int width>
class FastSceneOf final : public FastScene {
 public:
  FastSceneOf(const Bvh& bvh, const std::function<Mesh::Corners(std::uint32_t)>& corners,
              const FastTraces<width>& traces)
      : traces_(traces) {
    const WideNodes<WideFloatNode<width>> wide(joined_leaves(bvh, most_in_pack), most_in_pack);
    nodes_.reserve(wide.size());
    for (std::uint32_t number = 0; number < wide.size(); ++number) {
      WideFloatNode<width> node = wide.node(number);
      for (std::size_t i = 0; i < node.children(); ++i) {
        const NodeRef child = node.child(i);
        if (child.is_branch()) continue;
        node.first[i] = static_cast<std::uint32_t>(packs_.size());
        TrianglePack& pack = packs_.emplace_back();
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(child.count); ++lane) {
          const std::uint32_t triangle = wide.order()[child.first + lane];
          pack.set(lane, triangle, corners(triangle));
          for (const auto& row : pack.corners)
            largest_corner_ = std::max(largest_corner_, std::fabs(row[lane]));
        }
      }
      nodes_.push_back(node);
    }
    view_ = {nodes_.data(), packs_.data()};
  }

  void walk(const Ray& ray, float reach, FastSink& sink, FastWork& work) const override {
    traces_.mesh(view_, ray, reach, sink, work);
  }
  void walk(const PlacedRay& ray, FastSink& sink) const override { traces_.placed(view_, ray, sink); }
  [[nodiscard]] std::size_t bytes_per_node() const override { return sizeof(WideFloatNode<width>); }
  [[nodiscard]] std::size_t node_count() const override { return nodes_.size(); }

 private:
  const FastTraces<width>& traces_;
  std::vector<WideFloatNode<width>> nodes_;
  std::vector<TrianglePack> packs_;
  FastView<width> view_{};
};

template <int width>
class FastBoxesOf final : public FastBoxes {
 public:
  FastBoxesOf(const Bvh& bvh, const FastTraces<width>& traces) : traces_(traces) {
    const WideNodes<WideFloatNode<width>> wide(bvh, most_in_pack);
    order_.assign(wide.order().begin(), wide.order().end());
    parents_.resize(wide.size());
    leaves_.resize(order_.size());
    for (std::uint32_t number = 0; number < wide.size(); ++number) {
      const WideFloatNode<width>& node = nodes_.emplace_back(wide.node(number));
      for (std::uint8_t i = 0; i < node.children_count; ++i) {
        const NodeRef child = node.child(i);
        if (child.is_branch()) parents_[child.first] = {number, i};
        for (std::uint32_t k = 0; !child.is_branch() && k < static_cast<std::uint32_t>(child.count); ++k)
          leaves_[order_[child.first + k]] = {number, i};
      }
    }
    view_ = {nodes_.data(), order_.data()};
  }

  void walk(const Ray& ray, FastBoxSink& sink) const override { traces_.boxes(view_, ray, sink); }

  void refit(std::span<const std::uint32_t> entries, const std::function<Aabb(std::uint32_t)>& box) override {
    // Of many, each node once is less than each path to the root. Leaves come first, by all threads.
    if (entries.size() > order_.size() / 16) {
      host::for_each_block(0, nodes_.size(), 1024, [&](std::size_t first, std::size_t last) {
        for (auto number = static_cast<std::uint32_t>(first); number < last; ++number)
          for_children(number, false, [&](const Place& leaf) { set(leaf, box); });
      });
      for (auto number = static_cast<std::uint32_t>(nodes_.size()); number-- > 0;)
        for_children(number, true, [&](const Place& branch) { set(branch, box); });
      return;
    }
    for (const std::uint32_t entry : entries) {
      Place place = leaves_[entry];
      for (set(place, box); place.node != 0; set(place, box)) place = parents_[place.node];
    }
  }

 private:
  /// A child of a node.
  struct Place {
    std::uint32_t node = 0;
    std::uint8_t child = 0;
  };

  /// Calls for those children of the node that are branches, or leaves.
  template <class Call>
  void for_children(std::uint32_t number, bool branches, const Call& call) const {
    for (std::uint8_t i = 0; i < nodes_[number].children_count; ++i)
      if (nodes_[number].child(i).is_branch() == branches) call({number, i});
  }
  /// Makes the child's box from what is in it.
  void set(const Place& place, const std::function<Aabb(std::uint32_t)>& box) {
    WideFloatNode<width>& node = nodes_[place.node];
    const NodeRef child = node.child(place.child);
    Aabb all;
    if (child.is_branch()) {
      const WideFloatNode<width>& below = nodes_[child.first];
      for (std::size_t i = 0; i < below.children_count; ++i)
        all.grow(Aabb{{below.planes[0][i], below.planes[1][i], below.planes[2][i]},
                      {below.planes[3][i], below.planes[4][i], below.planes[5][i]}});
    } else {
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(child.count); ++k)
        all.grow(box(order_[child.first + k]));
    }
    for (unsigned plane = 0; plane < 6; ++plane) node.planes[plane][place.child] = all.plane(plane);
  }

  const FastTraces<width>& traces_;
  std::vector<WideFloatNode<width>> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<Place> parents_;  ///< by node; the root has none
  std::vector<Place> leaves_;   ///< by entry
  FastBoxView<width> view_{};
};

/// Throws as fast_tracer().
template <class Made, template <int> class Of, class... Parts>
std::unique_ptr<Made> of_width(VectorWidth width, const Bvh& bvh, const Parts&... parts) {
  if (bvh.nodes.empty()) throw std::invalid_argument("tracer: the hierarchy has no node; build it first");
  if (!has_vectors(width)) throw std::invalid_argument("tracer: this processor has no vectors of eight");
  if (width != VectorWidth::four && has_vectors(VectorWidth::eight))
    return std::make_unique<Of<8>>(bvh, parts..., *fast_traces_of_eight());
  return std::make_unique<Of<4>>(bvh, parts..., fast_traces<FourLanes, FourLanes, 4>);
}

}  // namespace

bool has_vectors(VectorWidth width) {
  return width != VectorWidth::eight || fast_traces_of_eight() != nullptr;
}

std::unique_ptr<FastScene> fast_scene(const Bvh& bvh,
                                      const std::function<Mesh::Corners(std::uint32_t)>& corners,
                                      VectorWidth width) {
  return of_width<FastScene, FastSceneOf>(width, bvh, corners);
}

std::unique_ptr<FastBoxes> fast_boxes(const Bvh& bvh, VectorWidth width) {
  return of_width<FastBoxes, FastBoxesOf>(width, bvh);
}

}  // namespace hitpipe::ref
