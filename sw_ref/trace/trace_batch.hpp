// Traces a batch of rays, one by one or in bundles, over a store of nodes with a box test. It is a template
// over all parts.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "sw_ref/trace/trace_bundle.hpp"
#include "sw_ref/trace/trace_by_distance.hpp"

namespace hitpipe::ref {

enum class ChildOrder : std::uint8_t { fixed, by_direction, by_distance };

/// How a tracer goes through a hierarchy with a box test.
struct Tracing {
  ChildOrder order = ChildOrder::by_direction;
  int bundle =
      1;  ///< the most rays traced together, for box tests that allow it and another order than by_distance
  bool ends = true;  ///< box tests know where rays end; if not, single rays only and not by_distance
};

/// `make_test(ray)` makes the box test of a ray.
template <class Store, class Maker>
struct TraceWith {
  const Store& store;
  const Maker& make_test;
  Leaves leaves;
  Tracing tracing{};
};

template <class Maker>
using BoxTestOf = std::invoke_result_t<const Maker&, const Ray&>;

/// Box tests that give the distance at which a ray enters a box.
template <class Test, class Box>
concept HasDistance = requires(const Test& test, const Box& box, typename Test::Distance& distance) {
  { test.enters(box, distance) } -> std::same_as<bool>;
};

template <class Store, class Maker>
TraceCounts trace_one(const TraceWith<Store, Maker>& with, const Ray& ray, Query query, Hit& hit,
                      Loads loads) {
  using Test = BoxTestOf<Maker>;
  if constexpr (HasDistance<Test, typename Store::Box>) {
    if (with.tracing.order == ChildOrder::by_distance) {
      return trace_by_distance(with.store, with.leaves, with.make_test(ray), ray, query, hit, loads);
    }
  }
  const unsigned order_class = with.tracing.order == ChildOrder::fixed ? 0 : direction_class(ray.direction);
  const Ray tested{ray.origin, ray.direction, with.tracing.ends ? ray.length : Ray::infinite};
  return trace_ray(with.store, with.leaves, with.make_test(tested), ray, query, order_class,
                   with.tracing.ends, hit, loads);
}

template <class Store, class Maker>
void trace_singly(const TraceWith<Store, Maker>& with, const TraceJob& job, TraceCounts& counts) {
  for (std::size_t i = 0; i < job.rays.size(); ++i) {
    Hit hit;
    const TraceCounts work = trace_one(with, job.rays[i], job.query, hit, Loads{job.loads});
    job.triangles[i] = hit.triangle;
    if (!job.work.empty()) job.work[i] = work;
    counts += work;
  }
}

/// Traces the rays first..first + count of the job, as one bundle for each direction class that they have.
template <class Store, class Maker>
void trace_bundles(const TraceWith<Store, Maker>& with, const TraceJob& job, std::size_t first,
                   std::size_t count, TraceCounts& counts) {
  using Test = BoxTestOf<Maker>;
  static_assert(std::is_trivially_destructible_v<Test> && std::is_trivially_destructible_v<BundledRay>);
  std::array<unsigned char, largest_bundle> classes;
  unsigned present = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned ray_class = direction_class(job.rays[first + i].direction);
    classes[i] = static_cast<unsigned char>(ray_class);
    present |= 1U << ray_class;
  }
  // The memory is not initialised; only as many elements are made as there are rays.
  alignas(Test) std::array<std::byte, sizeof(Test) * largest_bundle> test_memory;
  alignas(BundledRay) std::array<std::byte, sizeof(BundledRay) * largest_bundle> ray_memory;
  Test* const tests = reinterpret_cast<Test*>(test_memory.data());
  BundledRay* const rays = reinterpret_cast<BundledRay*>(ray_memory.data());
  std::array<std::size_t, largest_bundle> places;
  for (unsigned ray_class = 0; ray_class < direction_classes; ++ray_class) {
    if ((present >> ray_class & 1U) == 0) continue;
    std::size_t members = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (classes[i] != ray_class) continue;
      const Ray& ray = job.rays[first + i];
      std::construct_at(tests + members, with.make_test(ray));
      TraceCounts* const work = job.work.empty() ? nullptr : &job.work[first + i];
      if (work != nullptr) *work = {.rays = 1};
      std::construct_at(rays + members, ray, work);
      places[members++] = first + i;
    }
    BundleTrace bundle(with.store, with.leaves, job.query, std::span(rays, members), tests, Loads{job.loads});
    bundle.run(with.tracing.order == ChildOrder::fixed ? 0 : ray_class, counts);
    for (std::size_t i = 0; i < members; ++i) job.triangles[places[i]] = rays[i].hit.triangle;
  }
}

/// Adds to `counts`; tells the job's observer each load.
template <class Store, class Maker>
void trace_batch(const TraceWith<Store, Maker>& with, const TraceJob& job, TraceCounts& counts) {
  if constexpr (BundleBoxTest<BoxTestOf<Maker>, typename Store::Box>) {
    if (with.tracing.bundle > 1) {
      const auto most = static_cast<std::size_t>(with.tracing.bundle);
      counts.rays += job.rays.size();
      for (std::size_t first = 0; first < job.rays.size(); first += most) {
        trace_bundles(with, job, first, std::min(most, job.rays.size() - first), counts);
      }
      return;
    }
  }
  trace_singly(with, job, counts);
}

}  // namespace hitpipe::ref
