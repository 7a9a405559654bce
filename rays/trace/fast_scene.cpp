#include "rays/trace/fast_scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "rays/tree/small_leaves.hpp"
#include "rays/tree/wide_nodes.hpp"

namespace hitpipe::ref {

namespace {

constexpr int most_in_pack = TrianglePack::size;

template <int width>
class FastSceneOf final : public FastScene {
 public:
  FastSceneOf(const Bvh& bvh, const std::function<Mesh::Corners(std::uint32_t)>& corners,
              FastTrace<width> its_trace)
      : trace_(its_trace) {
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
    trace_(view_, ray, reach, sink, work);
  }
  [[nodiscard]] std::size_t bytes_per_node() const override { return sizeof(WideFloatNode<width>); }
  [[nodiscard]] std::size_t node_count() const override { return nodes_.size(); }

 private:
  FastTrace<width> trace_;
  std::vector<WideFloatNode<width>> nodes_;
  std::vector<TrianglePack> packs_;
  FastView<width> view_{};
};

}  // namespace

bool has_vectors(VectorWidth width) {
  return width != VectorWidth::eight || fast_trace_of_eight() != nullptr;
}

std::unique_ptr<FastScene> fast_scene(const Bvh& bvh,
                                      const std::function<Mesh::Corners(std::uint32_t)>& corners,
                                      VectorWidth width) {
  if (bvh.nodes.empty()) throw std::invalid_argument("tracer: the hierarchy has no node; build it first");
  if (!has_vectors(width)) throw std::invalid_argument("tracer: this processor has no vectors of eight");
  if (width != VectorWidth::four && has_vectors(VectorWidth::eight))
    return std::make_unique<FastSceneOf<8>>(bvh, corners, fast_trace_of_eight());
  return std::make_unique<FastSceneOf<4>>(bvh, corners, trace_fast<FourLanes, FourLanes, 4>);
}

}  // namespace hitpipe::ref
