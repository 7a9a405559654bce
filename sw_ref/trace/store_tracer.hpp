// A tracer over one store of nodes with one box test. A design's own tracer is made by it too.
#pragma once

#include <memory>
#include <utility>

#include "rays/trace/test_maker.hpp"
#include "sw_ref/trace/trace_batch.hpp"

namespace hitpipe::ref {

template <class Store, class Maker>
class StoreTracer final : public Tracer {
 public:
  StoreTracer(Store store, Maker make_test, const Leaves& leaves, const Tracing& tracing)
      : store_(std::move(store)), make_test_(std::move(make_test)), leaves_(leaves), tracing_(tracing) {}

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    trace_batch(TraceWith<Store, Maker>{store_, make_test_, leaves_, tracing_}, job, counts);
  }

  [[nodiscard]] std::size_t bytes_per_node() const override { return store_.bytes_per_node; }
  [[nodiscard]] std::size_t node_count() const override { return store_.size(); }

 private:
  Store store_;
  Maker make_test_;
  Leaves leaves_;
  Tracing tracing_;
};

template <class Store, class Maker>
[[nodiscard]] std::unique_ptr<Tracer> store_tracer(Store store, Maker make_test, const Leaves& leaves,
                                                   const Tracing& tracing = {}) {
  return std::make_unique<StoreTracer<Store, Maker>>(std::move(store), std::move(make_test), leaves, tracing);
}

}  // namespace hitpipe::ref
