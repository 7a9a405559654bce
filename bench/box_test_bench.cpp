// The ray-box tests of chapter 3 (Tables 3.1 and 3.2), and the integer tests of chapter 6 for comparison.
// They run on random pairs with a fixed seed. The argument is the percentage of hits among them. One item is
// one test. The data fit the second cache level.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "rays/world/int_box.hpp"
#include "sw_ref/hierarchy/hierarchical_nodes.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"
#include "sw_ref/trace/int_plucker.hpp"
#include "sw_ref/trace/int_slabs.hpp"
#include "thesis/variants.hpp"
#include "thesis/workload.hpp"

namespace {

namespace hls = hitpipe::hls;
namespace ref = hitpipe::ref;
namespace thesis = hitpipe::thesis;

constexpr std::size_t pairs = 2'000;
constexpr std::uint64_t seed = 2007;

void run_variant(benchmark::State& state, const thesis::BoxTestVariant& variant) {
  const auto workload = thesis::make_box_workload(pairs, static_cast<int>(state.range(0)), seed);
  const std::unique_ptr<thesis::PreparedBoxTests> tests = variant.prepare(workload);
  for (auto _ : state) benchmark::DoNotOptimize(tests->run());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
}

template <class T>
void register_variants(const std::string& precision) {
  for (const thesis::BoxTestVariant& variant : thesis::box_test_variants<T>()) {
    benchmark::RegisterBenchmark((std::string(variant.name) + '/' + precision).c_str(), run_variant, variant)
        ->ArgName("hits")
        ->Arg(0)
        ->Arg(50)
        ->Arg(100);
  }
}

const bool registered = [] {
  register_variants<float>("binary32");
  register_variants<double>("binary64");
  return true;
}();

template <class SetUp>
void integer_test(benchmark::State& state) {
  const hls::IntBits bits{24, 24};
  const SetUp set_up(bits);
  std::vector<decltype(set_up(ref::Ray{}))> tests;
  std::vector<ref::IntBox> boxes;
  for (const thesis::BoxPair& pair :
       thesis::make_box_workload(pairs, static_cast<int>(state.range(0)), seed)) {
    tests.push_back(set_up(pair.ray));
    boxes.push_back(ref::quantise_box(pair.box, bits.coord));
  }
  for (auto _ : state) {
    std::size_t hits = 0;
    for (std::size_t i = 0; i < pairs; ++i) hits += tests[i](boxes[i]) ? 1U : 0U;
    benchmark::DoNotOptimize(hits);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
}
BENCHMARK(integer_test<ref::IntSlabsTestMaker>)->ArgName("hits")->Arg(0)->Arg(50)->Arg(100);
BENCHMARK(integer_test<ref::IntPluckerTestMaker>)->ArgName("hits")->Arg(0)->Arg(50)->Arg(100);

/// A complete tree of 12 levels: each child takes most of its parent.
ref::Bvh tree() {
  ref::Bvh bvh;
  bvh.nodes.push_back({{glm::vec3(-0.9F), glm::vec3(0.9F)}, 1, 0});
  for (std::uint32_t parent = 0; parent < 2047; ++parent) {
    const ref::Aabb box = bvh.nodes[parent].box;
    const auto axis = static_cast<int>(parent % 3);
    ref::Aabb half = box;
    half.max[axis] -= (box.max[axis] - box.min[axis]) * 0.4F;
    bvh.nodes[parent].count = -1 - axis;
    bvh.nodes[parent].first = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes.push_back({half, 1, 0});
    half = box;
    half.min[axis] += (box.max[axis] - box.min[axis]) * 0.4F;
    bvh.nodes.push_back({half, 1, 0});
  }
  return bvh;
}

/// Loads and decodes every node once, parents first.
template <class Store>
void load_nodes(benchmark::State& state, const Store& store) {
  std::vector<typename Store::Node> nodes(store.size());
  for (auto _ : state) {
    nodes[0] = store.root();
    for (std::size_t parent = 0; store.count(nodes[parent]) < 0; ++parent) {
      const std::uint32_t first = store.first(nodes[parent]);
      nodes[first] = store.child(nodes[parent], 0);
      nodes[first + 1] = store.child(nodes[parent], 1);
      benchmark::DoNotOptimize(store.box(nodes[first]));
      benchmark::DoNotOptimize(store.box(nodes[first + 1]));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(store.size()));
}

template <int bits, bool lut>
void hierarchical(benchmark::State& state) {
  load_nodes(state, ref::HierarchicalNodes<bits, lut>(tree()));
}
BENCHMARK(hierarchical<4, false>);
BENCHMARK(hierarchical<4, true>);
BENCHMARK(hierarchical<8, false>);
BENCHMARK(hierarchical<8, true>);
BENCHMARK(hierarchical<12, false>);
BENCHMARK(hierarchical<16, false>);

void packed(benchmark::State& state) {
  load_nodes(state, ref::IntNodes(tree(), static_cast<int>(state.range(0))));
}
BENCHMARK(packed)->ArgName("bits")->Arg(16)->Arg(20)->Arg(24);

}  // namespace
