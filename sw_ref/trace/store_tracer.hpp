// A tracer over one store of nodes with one box test.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "sw_ref/trace/plucker.hpp"
#include "sw_ref/trace/slabs.hpp"
#include "sw_ref/trace/trace_batch.hpp"
#include "sw_ref/trace/tracer_kinds.hpp"

namespace hitpipe::ref {

[[nodiscard]] constexpr ChildOrder child_order(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::slabs:
    case Algorithm::plu:
      return ChildOrder::fixed;
    case Algorithm::slabs_dist:
      return ChildOrder::by_distance;
    case Algorithm::slabs_dsa:
    case Algorithm::plu_dsa:
      break;
  }
  return ChildOrder::by_direction;
}

[[nodiscard]] constexpr bool is_plucker(Algorithm algorithm) {
  return algorithm == Algorithm::plu || algorithm == Algorithm::plu_dsa;
}

/// Makes a box test from the ray alone.
template <class Test>
struct TestMaker {
  [[nodiscard]] Test operator()(const Ray& ray) const { return Test(ray); }
};

template <class Store, class Maker>
class StoreTracer final : public Tracer {
 public:
  StoreTracer(Store store, Maker make_test, const TracerParts& parts)
      : store_(std::move(store)),
        make_test_(std::move(make_test)),
        leaves_{parts.mesh, parts.bvh.order, leaf_test(parts.options.triangle_test)},
        order_(child_order(parts.options.algorithm)),
        bundle_(parts.options.bundle),
        ends_(parts.options.ends) {}

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    NoObserver observer;
    trace_batch(TraceWith<Store, Maker>{store_, make_test_, leaves_, order_, bundle_, ends_}, job, counts,
                observer);
  }

  [[nodiscard]] std::size_t bytes_per_node() const override { return store_.bytes_per_node; }
  [[nodiscard]] std::size_t node_count() const override { return store_.size(); }

 private:
  Store store_;
  Maker make_test_;
  Leaves leaves_;
  ChildOrder order_;
  int bundle_;
  bool ends_;
};

/// A tracer with a box test that is made from the ray alone.
template <class Test, class Store>
[[nodiscard]] std::unique_ptr<Tracer> store_tracer(Store store, const TracerParts& parts) {
  return std::make_unique<StoreTracer<Store, TestMaker<Test>>>(std::move(store), TestMaker<Test>{}, parts);
}

/// A tracer with slabs or Pluecker in T.
template <class T, class Store>
[[nodiscard]] std::unique_ptr<Tracer> float_tracer(Store store, const TracerParts& parts) {
  if (is_plucker(parts.options.algorithm)) return store_tracer<Plucker<T>>(std::move(store), parts);
  return store_tracer<Slabs<T>>(std::move(store), parts);
}

/// A tracer over binary32 boxes, with the arithmetic of the options.
template <class Store>
[[nodiscard]] std::unique_ptr<Tracer> any_float_tracer(Store store, const TracerParts& parts) {
  switch (parts.options.arithmetic) {
    case Arithmetic::robust:
      return store_tracer<RobustSlabs>(std::move(store), parts);
    case Arithmetic::binary64:
      return float_tracer<double>(std::move(store), parts);
    case Arithmetic::binary32:
    case Arithmetic::integer:
    case Arithmetic::major:
    case Arithmetic::any_float:
      break;
  }
  return float_tracer<float>(std::move(store), parts);
}

}  // namespace hitpipe::ref
