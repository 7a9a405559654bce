// The bit-level float operators in binary32 against the host's floating-point unit, as co-simulation uses it
// (rtl_gen/catalogue/host_float.hpp). First 10^8 pairs, many of them at corner cases, must agree bit for bit.
// Then both are timed on the same pairs. An item is a pair. times_host is our
// time divided by the host's.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "hls/box/fp_format.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp_logic.hpp"
#include "rtl_gen/catalogue/host_float.hpp"
#include "tests/hls/num/float_corners.hpp"

namespace {

namespace exact = hitpipe::hls::exact;
namespace fp_logic = hitpipe::hls::fp_logic;
using hitpipe::hls::Fp32;
using hitpipe::hls::Native;
using Bits = hitpipe::hls::ap_uint<32>;

constexpr std::uint64_t seed = 2005;
constexpr std::size_t checked_pairs = 100'000'000;
constexpr std::size_t timed_pairs = 4096;

using Number = hitpipe::hls::Fp<hitpipe::rtl::HostFloat, Fp32>;

Number number(std::uint32_t pattern) {
  return {{pattern}, {}};
}

struct Subtract {
  static std::uint64_t ours(std::uint32_t a, std::uint32_t b) {
    return fp_logic::subtract<Native>(Fp32(), Bits(a), Bits(b)).to_uint64();
  }
  static std::uint64_t host(const Number& a, const Number& b) { return fp_sub(a, b).bits.to_uint64(); }
};
struct Multiply {
  static std::uint64_t ours(std::uint32_t a, std::uint32_t b) {
    return fp_logic::multiply<Native>(Fp32(), Bits(a), Bits(b)).to_uint64();
  }
  static std::uint64_t host(const Number& a, const Number& b) { return fp_mul(a, b).bits.to_uint64(); }
};
struct Compare {
  static std::uint64_t ours(std::uint32_t a, std::uint32_t b) {
    return fp_logic::compare<Native>(Fp32(), Bits(a), Bits(b)).to_uint64();
  }
  static std::uint64_t host(const Number& a, const Number& b) {
    const auto order = fp_compare(a, b);
    return order.greater.to_uint64() << 1 | order.less.to_uint64();
  }
};

template <class Operator>
std::uint64_t by_host(const exact::FloatPair& p) {
  return Operator::host(number(p.a), number(p.b));
}

template <class Operator>
void BM_EqualsHost(benchmark::State& state) {
  for (auto _ : state) {
    exact::FloatPairs random(seed);
    for (std::size_t i = 0; i < checked_pairs; ++i) {
      const exact::FloatPair p = random.next();
      const std::uint64_t got = Operator::ours(p.a, p.b);
      const std::uint64_t expected = by_host<Operator>(p);
      if (got == expected) continue;
      const std::string message =
          fmt::format("pair {} of seed {}: a {:#x}, b {:#x} gives {:#x}, on the host {:#x}", i, seed, p.a,
                      p.b, got, expected);
      state.SkipWithError(message.c_str());
      return;
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(checked_pairs));
}
BENCHMARK_TEMPLATE(BM_EqualsHost, Subtract)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_TEMPLATE(BM_EqualsHost, Multiply)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_TEMPLATE(BM_EqualsHost, Compare)->Iterations(1)->Unit(benchmark::kSecond);

/// Pairs of numbers that are common in ray tracing: either sign, magnitudes 2^-8 to 2^8.
std::vector<exact::FloatPair> usual_pairs() {
  std::mt19937 random(seed);
  const auto one = [&] {
    const auto bits = static_cast<std::uint32_t>(random());
    return (bits & 0x80000000) | (119 + (bits >> 27 & 15)) << 23 | (bits & 0x7fffff);
  };
  std::vector<exact::FloatPair> pairs(timed_pairs);
  for (exact::FloatPair& p : pairs) p = {one(), one()};
  return pairs;
}

template <class Work>
double seconds(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Operator>
void BM_Speed(benchmark::State& state) {
  const std::vector<exact::FloatPair> pairs = usual_pairs();
  double ours = 0;
  double host = 0;
  for (auto _ : state) {
    const double once = seconds([&] {
      for (const exact::FloatPair& p : pairs) benchmark::DoNotOptimize(Operator::ours(p.a, p.b));
    });
    host += seconds([&] {
      for (const exact::FloatPair& p : pairs) {
        benchmark::DoNotOptimize(by_host<Operator>(p));
      }
    });
    ours += once;
    state.SetIterationTime(once);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(timed_pairs));
  state.counters["times_host"] = ours / host;
}
BENCHMARK_TEMPLATE(BM_Speed, Subtract)->UseManualTime();
BENCHMARK_TEMPLATE(BM_Speed, Multiply)->UseManualTime();
BENCHMARK_TEMPLATE(BM_Speed, Compare)->UseManualTime();

}  // namespace

BENCHMARK_MAIN();
