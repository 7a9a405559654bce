// ap_int against machine words: for each pair of operands a 24 x 24 bit multiply, a 48-bit compare, a select
// and a slice, as in the integer slabs unit. Both benchmarks compute the same. ap_int should take at most 1.3
// times as long. One item is one pair.
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "hls/num/domain.hpp"

namespace {

namespace hls = hitpipe::hls;

constexpr std::size_t pair_count = 4096;
constexpr unsigned operand_seed = 2005;

/// The least product, and the sum of the products' high halves.
struct Result {
  std::int64_t least;
  std::uint64_t high_sum;
};

struct WordPairs {
  std::vector<std::int64_t> a;
  std::vector<std::int64_t> b;
};

WordPairs random_pairs() {
  std::mt19937 random(operand_seed);
  std::uniform_int_distribution<std::int64_t> value(-(1 << 23), (1 << 23) - 1);
  WordPairs pairs;
  for (std::size_t i = 0; i < pair_count; ++i) {
    pairs.a.push_back(value(random));
    pairs.b.push_back(value(random));
  }
  return pairs;
}

Result with_words(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  std::int64_t least = (std::int64_t{1} << 47) - 1;
  std::uint64_t high_sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::int64_t product = a[i] * b[i];
    const bool nearer = product < least;
    least = nearer ? product : least;
    high_sum += static_cast<std::uint64_t>(product) >> 24 & 0xffffff;
  }
  return {least, high_sum};
}

Result with_ap_int(const std::vector<hls::ap_int<24>>& a, const std::vector<hls::ap_int<24>>& b) {
  hls::ap_int<48> least = (std::int64_t{1} << 47) - 1;
  hls::ap_uint<64> high_sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const hls::ap_int<48> product = a[i] * b[i];
    const hls::ap_uint<1> nearer{product < least};
    least = hls::select(nearer, product, least);
    high_sum += hls::slice(product, hls::Width<47>(), hls::Width<24>());
  }
  return {least.to_int64(), high_sum.to_uint64()};
}

void BM_MultiplyCompareWords(benchmark::State& state) {
  const WordPairs pairs = random_pairs();
  for (auto _ : state) {
    benchmark::DoNotOptimize(with_words(pairs.a, pairs.b));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pair_count));
}
BENCHMARK(BM_MultiplyCompareWords);

void BM_MultiplyCompareApInt(benchmark::State& state) {
  const WordPairs pairs = random_pairs();
  const std::vector<hls::ap_int<24>> a(pairs.a.begin(), pairs.a.end());
  const std::vector<hls::ap_int<24>> b(pairs.b.begin(), pairs.b.end());
  const Result expected = with_words(pairs.a, pairs.b);
  const Result got = with_ap_int(a, b);
  if (got.least != expected.least || got.high_sum != expected.high_sum) {
    state.SkipWithError("ap_int and machine words disagree on the same operands");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(with_ap_int(a, b));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pair_count));
}
BENCHMARK(BM_MultiplyCompareApInt);

}  // namespace

BENCHMARK_MAIN();
