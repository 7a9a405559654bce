// The loop of the fast tracer, a template so that it is compiled for wider vectors as well. Such a source is
// compiled for other processors than the rest of the program, and a linker keeps one copy of an inline
// function. So all that it calls here either is inlined or lies in another source.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rays/trace/corner_map.hpp"
#include "rays/trace/near_first.hpp"
#include "rays/trace/triangle_pack.hpp"
#include "rays/tree/wide_node.hpp"

namespace hitpipe::ref {

/// Nodes and what their leaves have, not owned.
template <int width_, class Leaf>
struct FastViewOf {
  static constexpr std::size_t width = width_;

  const WideFloatNode<width_>* nodes;
  const Leaf* leaves;

  [[nodiscard]] const WideFloatNode<width_>& node(std::uint32_t number) const { return nodes[number]; }
};
/// The first of a leaf is the number of its pack.
template <int width>
using FastView = FastViewOf<width, TrianglePack>;
/// The first of a leaf is the place of its first number.
template <int width>
using FastBoxView = FastViewOf<width, std::uint32_t>;

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

/// What a walk over boxes alone does at a leaf, for each number that it has.
class FastBoxSink {
 public:
  virtual AfterLeaf enters(std::uint32_t number) = 0;
  [[nodiscard]] virtual float length() const = 0;

 protected:
  ~FastBoxSink() = default;
};

/// A mesh somewhere in the world. Triangles are moved there before they are tested.
struct PlacedRay {
  const Ray& world;
  float reach;  ///< of the filter in the world
  const SlackRay& object;
  const CornerMap& map;
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
    const TrianglePack& pack = view_.leaves[first];
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

template <class Lanes, int width>
class PlacedVisitor {
 public:
  PlacedVisitor(const FastView<width>& view, const PlacedRay& ray, FastSink& sink)
      : view_(view), map_(ray.map), filter_(ray.world, ray.reach), sink_(sink) {}

  void branch(std::uint32_t /*number*/, unsigned /*children*/) {}
  AfterLeaf leaf(std::uint32_t first, std::int32_t count) {
    TrianglePack placed;
    map_.place<Lanes>(view_.leaves[first], placed);
    const unsigned may_hit = filter_.may_hit(placed) & ((1U << count) - 1);
    return may_hit == 0 ? AfterLeaf::same : sink_.meets(placed, may_hit);
  }
  [[nodiscard]] float length() const { return sink_.length(); }

 private:
  const FastView<width>& view_;
  const CornerMap& map_;
  TriangleFilter<Lanes> filter_;
  FastSink& sink_;
};

/// sink.length() is in the object.
template <class BoxLanes, class TriangleLanes, int width>
void trace_placed(const FastView<width>& view, const PlacedRay& ray, FastSink& sink) {
  WideChildren<FastView<width>, BoxLanes, Widening::of_inverses, SlackRay> children(view, ray.object);
  PlacedVisitor<TriangleLanes, width> visitor(view, ray, sink);
  walk_near_first(children, visitor, ray.object.length);
}

template <class Lanes, int width>
class BoxVisitor {
 public:
  BoxVisitor(const FastBoxView<width>& view, FastBoxSink& sink) : view_(view), sink_(sink) {}

  void branch(std::uint32_t /*number*/, unsigned /*children*/) {}
  AfterLeaf leaf(std::uint32_t first, std::int32_t count) {
    AfterLeaf after = AfterLeaf::same;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
      const AfterLeaf one = sink_.enters(view_.leaves[first + i]);
      if (one == AfterLeaf::stop) return one;
      if (one == AfterLeaf::shorter) after = one;
    }
    return after;
  }
  [[nodiscard]] float length() const { return sink_.length(); }

 private:
  const FastBoxView<width>& view_;
  FastBoxSink& sink_;
};

template <class BoxLanes, int width>
void trace_boxes(const FastBoxView<width>& view, const Ray& ray, FastBoxSink& sink) {
  WideChildren<FastBoxView<width>, BoxLanes, Widening::of_inverses> children(view, ray);
  BoxVisitor<BoxLanes, width> visitor(view, sink);
  walk_near_first(children, visitor, ray.length);
}

/// Each traces one ray.
template <int width>
struct FastTraces {
  void (*mesh)(const FastView<width>& view, const Ray& ray, float reach, FastSink& sink, FastWork& work);
  void (*placed)(const FastView<width>& view, const PlacedRay& ray, FastSink& sink);
  void (*boxes)(const FastBoxView<width>& view, const Ray& ray, FastBoxSink& sink);
};
template <class BoxLanes, class TriangleLanes, int width>
inline constexpr FastTraces<width> fast_traces{trace_fast<BoxLanes, TriangleLanes, width>,
                                               trace_placed<BoxLanes, TriangleLanes, width>,
                                               trace_boxes<BoxLanes, width>};

/// With vectors of eight; null if this program or this processor has none.
const FastTraces<8>* fast_traces_of_eight();

}  // namespace hitpipe::ref
