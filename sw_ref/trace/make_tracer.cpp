// The tracers of the thesis: each store of nodes with each box test that goes over it.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "rays/trace/near_first.hpp"
#include "rays/trace/slabs.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/tree/wide_nodes.hpp"
#include "rays/world/ray_check.hpp"
#include "sw_ref/hierarchy/compact_pairs.hpp"
#include "sw_ref/hierarchy/double_nodes.hpp"
#include "sw_ref/hierarchy/hierarchical_nodes.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/trace/counting_visitor.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "sw_ref/trace/plucker.hpp"
#include "sw_ref/trace/store_tracer.hpp"
#include "sw_ref/trace/trace_batch.hpp"

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

/// How many children a node of the encoding holds the boxes of; 0: its nodes have one box, their own.
std::size_t boxes_in_node(Encoding encoding) {
  return kind_of(encoding).boxes;
}

/// Such nodes, with conservative slabs. Wide nodes have the order by distance only. Throws
/// std::invalid_argument, one line, when a box of the hierarchy leaves its parent's.
std::unique_ptr<Tracer> near_first_tracer(Encoding encoding, ChildOrder order, const Mesh& mesh,
                                          const Bvh& bvh, TriangleTest triangle_test) {
  return kind_of(encoding).make(order, mesh, bvh, triangle_test);
}

struct Parts {
  const Bvh& bvh;
  Leaves leaves;
  Tracing tracing;
  hls::IntBits bits;
};

struct NamedTracer {
  bool plucker;
  Arithmetic arithmetic;
  Encoding encoding;
  bool look_up_table;
  std::unique_ptr<Tracer> (*make)(const Parts& parts);
};

template <class Store, class Test>
std::unique_ptr<Tracer> over(const Parts& parts) {
  return store_tracer(Store(parts.bvh), TestMaker<Test>(), parts.leaves, parts.tracing);
}

template <class Maker>
std::unique_ptr<Tracer> over_integers(const Parts& parts) {
  const Maker make_test(parts.bits);
  return store_tracer(IntNodes(parts.bvh, parts.bits.coord), make_test, parts.leaves, parts.tracing);
}

template <class Single, class Double>
void add_floats(Encoding encoding, bool look_up_table, std::vector<NamedTracer>& to) {
  to.insert(to.end(),
            {{false, Arithmetic::binary32, encoding, look_up_table, over<Single, Slabs<float>>},
             {true, Arithmetic::binary32, encoding, look_up_table, over<Single, Plucker<float>>},
             {false, Arithmetic::conservative, encoding, look_up_table, over<Single, ConservativeSlabs>},
             {false, Arithmetic::binary64, encoding, look_up_table, over<Double, Slabs<double>>},
             {true, Arithmetic::binary64, encoding, look_up_table, over<Double, Plucker<double>>}});
}

template <int bits, bool table>
void add_hierarchical(Encoding encoding, std::vector<NamedTracer>& to) {
  using Nodes = HierarchicalNodes<bits, table>;
  add_floats<Nodes, Nodes>(encoding, table, to);
}

std::vector<NamedTracer> named_tracers() {
  std::vector<NamedTracer> all{
      {false, Arithmetic::integer, Encoding::plain, false, over_integers<IntSlabsTestMaker>},
      {true, Arithmetic::integer, Encoding::plain, false, over_integers<IntPluckerTestMaker>}};
  add_floats<PlainNodes, DoubleNodes>(Encoding::plain, false, all);
  add_hierarchical<4, false>(Encoding::hierarchical_4, all);
  add_hierarchical<4, true>(Encoding::hierarchical_4, all);
  add_hierarchical<8, false>(Encoding::hierarchical_8, all);
  add_hierarchical<8, true>(Encoding::hierarchical_8, all);
  add_hierarchical<12, false>(Encoding::hierarchical_12, all);
  add_hierarchical<16, false>(Encoding::hierarchical_16, all);
  return all;
}

[[nodiscard]] ChildOrder child_order(Algorithm algorithm) {
  if (algorithm == Algorithm::slabs || algorithm == Algorithm::plu) return ChildOrder::fixed;
  return algorithm == Algorithm::slabs_dist ? ChildOrder::by_distance : ChildOrder::by_direction;
}

void allow(bool possible, const char* message) {
  if (!possible) throw std::invalid_argument(message);
}

}  // namespace

std::unique_ptr<Tracer> make_tracer(const Mesh& mesh, const Bvh& bvh, const TracerOptions& options) {
  static const std::vector<NamedTracer> all = named_tracers();
  const bool plucker = options.algorithm == Algorithm::plu || options.algorithm == Algorithm::plu_dsa;
  const bool by_distance = options.algorithm == Algorithm::slabs_dist;
  const bool integer = options.arithmetic == Arithmetic::integer;
  const auto named = std::find_if(all.begin(), all.end(), [&](const NamedTracer& each) {
    return each.plucker == plucker && each.arithmetic == options.arithmetic &&
           each.encoding == options.encoding && each.look_up_table == options.look_up_table;
  });
  // Why there is no such tracer.
  allow(!bvh.nodes.empty(), "tracer: the hierarchy has no node; build it first");
  if (const std::size_t boxes = boxes_in_node(options.encoding); boxes > 0) {
    allow(!plucker && options.arithmetic == Arithmetic::conservative && !options.look_up_table &&
              options.bundle == 1,
          "tracer: wide nodes and pairs are for single rays and conservative slabs, without a table");
    allow(by_distance || boxes == 2, "tracer: wide nodes have the order by distance; take slabs_dist");
    return near_first_tracer(options.encoding, child_order(options.algorithm), mesh, bvh,
                             options.triangle_test);
  }
  allow(!plucker || options.arithmetic != Arithmetic::conservative,
        "tracer: conservative arithmetic is for slabs; with Pluecker take binary32 or binary64");
  allow(!integer || !by_distance,
        "tracer: integer units give no distance; with integers take slabs, slabs_dsa, plu or plu_dsa");
  allow(!integer || options.encoding == Encoding::plain,
        "tracer: integer arithmetic has nodes of its own; take the plain encoding");
  allow(named != all.end(), "tracer: a look-up table is for hierarchical nodes of 4 or 8 bits");
  if (options.bundle != 1 && options.bundle != 64 && options.bundle != 256) {
    throw std::invalid_argument(
        fmt::format("tracer: bundles of {} rays; allowed are 1, 64 and 256", options.bundle));
  }
  allow(options.bundle == 1 || !by_distance,
        "tracer: the order by distance is of single rays; take bundle 1");
  allow(options.bundle == 1 || !integer, "tracer: integer units take single rays; take bundle 1");
  if (integer) check_format(options.bits, "tracer");
  return named->make({bvh,
                      Leaves(mesh, bvh, options.triangle_test),
                      {.order = child_order(options.algorithm), .bundle = options.bundle},
                      options.bits});
}

}  // namespace hitpipe::ref
