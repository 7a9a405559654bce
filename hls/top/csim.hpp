// The test program of a top function: random operands, its HIT against the native pipeline's. With a vendor's
// ap_int.h this compares that vendor's arithmetic with hitpipe's. Not for synthesis.
#pragma once

#include <cstdint>
#include <cstdio>
#include <random>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "hls/box/arithmetic.hpp"
#include "hls/box/operand.hpp"
#include "hls/num/domain.hpp"
#include "hls/top/top_domain.hpp"

namespace hitpipe::hls::top {

/// A number of W bits that is small more often than not, or a float of magnitude 2^-8 to 2.
template <int W>
std::uint64_t random_word(Arithmetic arithmetic, std::mt19937_64& random) {
  const std::uint64_t bits = random();
  if (arithmetic == Arithmetic::integer)
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> (64 - W + random() % 6));
  return (bits & 0x807fffff) | (119 + random() % 9) << 23;
}

/// Operands in port order, as words whose low bits count: planes of a box in order, lengths not negative. One
/// in eight is any pattern of bits, NaN and infinities included.
template <class Pipeline, class F>
std::vector<std::uint64_t> random_operands(std::mt19937_64& random) {
  std::vector<std::uint64_t> words;
  typename Pipeline::template Operands<Native, F> shape{};
  const bool any = random() % 8 == 0;
  std::remove_cvref_t<decltype(shape)>::for_each(shape, [&](const Operand& port, auto& field) {
    constexpr int width = std::remove_cvref_t<decltype(field)>::width;
    std::uint64_t word = any || width == 1 ? random() : random_word<width>(Pipeline::arithmetic, random);
    constexpr std::uint64_t sign = std::uint64_t{1} << (width - 1);
    if (port.role == Role::length) word &= sign - 1;
    if (port.role == Role::plane_high && !any) {
      std::uint64_t& lower = words.back();
      const bool negative = (lower & word & sign) != 0 && Pipeline::arithmetic == Arithmetic::floating;
      const auto order = [](std::uint64_t x) { return static_cast<std::int64_t>(x << (64 - width)); };
      if ((order(word) < order(lower)) != negative) std::swap(word, lower);
    }
    words.push_back(word);
  });
  return words;
}

template <class Pipeline, class F>
bool native_hit(const std::vector<std::uint64_t>& words) {
  typename Pipeline::template Operands<Native, F> in;
  std::size_t next = 0;
  std::remove_cvref_t<decltype(in)>::for_each(in,
                                              [&](const Operand&, auto& field) { field = words[next++]; });
  return Pipeline::template hit<Native, F>(in).to_bool();
}

/// `hit` starts as the opposite of what the native pipeline says: an output that is not written shows.
template <class... Words>
bool top_hit(void (*top)(Words...), const std::vector<std::uint64_t>& words, bool before) {
  std::tuple<std::remove_reference_t<Words>...> ports;
  std::size_t next = 0;
  const auto word = [&] { return next < words.size() ? words[next++] : std::uint64_t{before}; };
  std::apply(
      [&](auto&... port) {
        ((port = word()), ...);
        top(port...);
      },
      ports);
  return std::get<sizeof...(Words) - 1>(ports).to_bool();
}

struct Comparison {
  int tests = 0, hits = 0, mismatches = 0;
};

/// Prints the operands of the first mismatch in hexadecimal.
template <class Pipeline, class... Words>
Comparison compare(void (*top)(Words...), int tests, std::uint64_t seed) {
  using F = std::conditional_t<Pipeline::arithmetic == Arithmetic::floating, Fp32, Integers>;
  std::mt19937_64 random(seed);
  Comparison result;
  for (; result.tests < tests; ++result.tests) {
    const std::vector<std::uint64_t> words = random_operands<Pipeline, F>(random);
    const bool expected = native_hit<Pipeline, F>(words);
    result.hits += expected ? 1 : 0;
    if (top_hit(top, words, !expected) == expected) continue;
    if (result.mismatches++ > 0) continue;
    std::printf("%s test %d: HIT %d, expected %d; operands", Pipeline::name, result.tests, expected ? 0 : 1,
                expected ? 1 : 0);
    for (const std::uint64_t word : words) std::printf(" %llx", static_cast<unsigned long long>(word));
    std::printf("\n");
  }
  return result;
}

/// The main() of a C simulation: 0 when every test agrees.
template <class Pipeline, class... Words>
int csim(void (*top)(Words...)) {
  constexpr int tests = 10000;
  constexpr std::uint64_t seed = 11;
  const Comparison result = compare<Pipeline>(top, tests, seed);
  std::printf("%s: seed %d, %d tests, %d hits, %d mismatches\n", Pipeline::name, static_cast<int>(seed),
              result.tests, result.hits, result.mismatches);
  return result.mismatches == 0 && result.hits > 0 && result.hits < result.tests ? 0 : 1;
}

}  // namespace hitpipe::hls::top
