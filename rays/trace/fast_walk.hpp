// The loop of the fast tracer, a template so that it is compiled for wider vectors as well. Such a source is
// compiled for other processors than the rest of the program, and a linker keeps one copy of an inline
// function. So all that it calls here either is inlined or lies in another source.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rays/trace/near_first.hpp"
#include "rays/trace/triangle_pack.hpp"
#include "rays/tree/wide_node.hpp"

namespace hitpipe::ref {

/// Nodes and triangles, not owned. The first of a leaf is the number of its pack.
template <int width_>
struct FastView {
  static constexpr std::size_t width = width_;

  const WideFloatNode<width_>* nodes;
  const TrianglePack* packs;

  [[nodiscard]] const WideFloatNode<width_>& node(std::uint32_t number) const { return nodes[number]; }
};

/// The question of a ray: what it wants to know of triangles that it may hit. It lies in a source for any processor.
class FastSink {
 public:
  /// Bit i: the ray may hit triangle i of the pack. At least one bit is set.
  virtual AfterLeaf meets(const TrianglePack& pack, unsigned may_hit) = 0;
  /// Nothing that begins beyond it is of interest any more. It is asked for after AfterLeaf::shorter.
  [[nodiscard]] virtual float length() const = 0;

 protected:
  ~FastSink() = default;
};

struct FastWork {
  std::uint64_t boxes = 0;
  std::uint64_t triangles = 0;
  std::uint64_t nodes = 0;
};

template <class Lanes, int width>
class FastVisitor {
 public:
  FastVisitor(const FastView<width>& view, const Ray& ray, float reach, FastSink& sink, FastWork& work)
      : view_(view), filter_(ray, reach), sink_(sink), work_(work) {}

  void branch(std::uint32_t /*number*/, unsigned children) {
    ++work_.nodes;
    work_.boxes += children;
  }
  AfterLeaf leaf(std::uint32_t first, std::int32_t count) {
    const TrianglePack& pack = view_.packs[first];
    work_.triangles += static_cast<std::uint32_t>(count);
    const unsigned may_hit = filter_.may_hit(pack) & ((1U << count) - 1);
    return may_hit == 0 ? AfterLeaf::same : sink_.meets(pack, may_hit);
  }
  [[nodiscard]] float length() const { return sink_.length(); }

 private:
  const FastView<width>& view_;
  TriangleFilter<Lanes> filter_;
  FastSink& sink_;
  FastWork& work_;
};

/// BoxLanes: vectors of boxes. Triangles go by four. `reach` is that of the filter.
template <class BoxLanes, class TriangleLanes, int width>
void trace_fast(const FastView<width>& view, const Ray& ray, float reach, FastSink& sink, FastWork& work) {
  WideChildren<FastView<width>, BoxLanes, Widening::of_inverses> children(view, ray);
  FastVisitor<TriangleLanes, width> visitor(view, ray, reach, sink, work);
  walk_near_first(children, visitor, ray.length);
}

/// Traces one ray.
template <int width>
using FastTrace = void (*)(const FastView<width>& view, const Ray& ray, float reach, FastSink& sink,
                           FastWork& work);

/// With vectors of eight; null if this program or this processor has none.
FastTrace<8> fast_trace_of_eight();

}  // namespace hitpipe::ref
