#include "sw_ref/trace/near_first_tracer.hpp"

#include "rays/trace/near_first.hpp"
#include "rays/tree/wide_nodes.hpp"
#include "sw_ref/hierarchy/compact_pairs.hpp"
#include "sw_ref/trace/counting_visitor.hpp"

namespace hitpipe::ref {
namespace {

template <class Store>
using ChildrenOf = std::conditional_t<Store::width == 2, PairChildren<Store>, WideChildren<Store>>;

template <NearFirstStore Store>
class NearFirstTracer final : public Tracer {
 public:
  NearFirstTracer(ChildOrder order, const Mesh& mesh, const Bvh& bvh, TriangleTest test)
      : store_(bvh), leaves_(mesh, bvh, test), order_(order) {
    leaves_.order = store_.order();
  }

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      const Ray& ray = job.rays[i];
      const unsigned axis_class = order_ == ChildOrder::fixed ? 0 : direction_class(ray.direction);
      ChildrenOf<Store> children(store_, ray);
      CountingVisitor visitor(leaves_, ray, job.query, Loads{job.loads});
      walk_near_first(children, visitor, ray.length,
                      order_ == ChildOrder::by_distance ? nullptr : &axis_class);
      job.triangles[i] = visitor.hit().triangle;
      if (!job.work.empty()) job.work[i] = visitor.counts();
      counts += visitor.counts();
    }
  }

  [[nodiscard]] std::size_t bytes_per_node() const override { return Store::bytes_per_node; }
  [[nodiscard]] std::size_t node_count() const override { return store_.size(); }
  [[nodiscard]] MemoryOrder memory_order() const override {
    return {store_.order(), store_.triangles_before()};
  }

 private:
  Store store_;
  Leaves leaves_;
  ChildOrder order_;
};

struct Kind {
  std::size_t boxes = 0;
  std::unique_ptr<Tracer> (*make)(ChildOrder order, const Mesh& mesh, const Bvh& bvh,
                                  TriangleTest test) = nullptr;
};

template <NearFirstStore Store>
Kind kind() {
  return {
      Store::width,
      [](ChildOrder order, const Mesh& mesh, const Bvh& bvh, TriangleTest test) -> std::unique_ptr<Tracer> {
        return std::make_unique<NearFirstTracer<Store>>(order, mesh, bvh, test);
      }};
}

Kind kind_of(Encoding encoding) {
  switch (encoding) {
    case Encoding::wide4:
      return kind<WideNodes<WideNode<4>>>();
    case Encoding::wide8:
      return kind<WideNodes<WideNode<8>>>();
    case Encoding::wide4_float:
      return kind<WideNodes<WideFloatNode<4>>>();
    case Encoding::wide8_float:
      return kind<WideNodes<WideFloatNode<8>>>();
    case Encoding::pair6:
      return kind<CompactPairs<8>>();
    case Encoding::pair8:
      return kind<CompactPairs<13>>();
    case Encoding::pair10:
      return kind<CompactPairs<18>>();
    default:
      return {};
  }
}

}  // namespace

std::size_t boxes_in_node(Encoding encoding) {
  return kind_of(encoding).boxes;
}

std::unique_ptr<Tracer> near_first_tracer(Encoding encoding, ChildOrder order, const Mesh& mesh,
                                          const Bvh& bvh, TriangleTest triangle_test) {
  return kind_of(encoding).make(order, mesh, bvh, triangle_test);
}

}  // namespace hitpipe::ref
