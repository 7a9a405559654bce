#include "sw_ref/trace/near_first_tracer.hpp"

#include "sw_ref/hierarchy/compact_pairs.hpp"
#include "sw_ref/hierarchy/wide_nodes.hpp"
#include "sw_ref/trace/near_first.hpp"

namespace hitpipe::ref {
namespace {

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
      Hit hit;
      const TraceCounts work =
          trace_near_first(store_, leaves_, order_, job.rays[i], job.query, hit, Loads{job.loads});
      job.triangles[i] = hit.triangle;
      if (!job.work.empty()) job.work[i] = work;
      counts += work;
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
