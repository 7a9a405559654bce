#include "thesis/timing.hpp"

#include <array>
#include <ctime>
#include <memory>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "thesis/variants.hpp"

namespace hitpipe::thesis {
namespace {

/// A first run without timing loads the pairs into the caches and counts the hits.
BoxTestTiming time_variant(const BoxTestVariant& variant, std::span<const BoxPair> workload, int hit_percent,
                           int repeats) {
  const std::unique_ptr<PreparedBoxTests> tests = variant.prepare(workload);
  const std::uint64_t hits = tests->run().hits;
  const std::uint64_t expected = workload.size() * static_cast<std::uint64_t>(hit_percent) / 100;
  if (hits != expected) {
    throw std::logic_error(
        fmt::format("{}: {} hits of {}; the referee has {}", variant.name, hits, workload.size(), expected));
  }
  const std::clock_t start = std::clock();
  for (int i = 0; i < repeats; ++i) (void)tests->run();
  const std::clock_t ticks = std::clock() - start;
  return {variant.name, 0, hit_percent, workload.size() * static_cast<std::uint64_t>(repeats),
          static_cast<double>(ticks) / CLOCKS_PER_SEC};
}

}  // namespace

std::vector<BoxTestTiming> time_box_tests(std::size_t pairs, int repeats, std::uint64_t seed) {
  constexpr std::array hit_percents{0, 50, 100};
  std::array<std::vector<BoxPair>, hit_percents.size()> workloads;
  for (std::size_t i = 0; i < workloads.size(); ++i) {
    workloads[i] = make_box_workload(pairs, hit_percents[i], seed);
  }
  std::vector<BoxTestTiming> timings;
  for (const int precision_bits : {32, 64}) {
    const auto variants = precision_bits == 32 ? box_test_variants<float>() : box_test_variants<double>();
    for (std::size_t i = 0; i < workloads.size(); ++i) {
      for (const BoxTestVariant& variant : variants) {
        timings.push_back(time_variant(variant, workloads[i], hit_percents[i], repeats));
        timings.back().precision_bits = precision_bits;
      }
    }
  }
  return timings;
}

}  // namespace hitpipe::thesis
