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
#include "hls/num/fp.hpp"
#include "hls/top/top_domain.hpp"

namespace hitpipe::hls::top {

/// An integer that is small more often than not, or a float of magnitude 2^-8 to 2.
inline std::uint64_t random_word(const Operand& port, std::mt19937_64& random) {
  const std::uint64_t bits = random();
  if (port.kind != Kind::real) {
    const int dropped = 64 - port.width + static_cast<int>(random() % 6);
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> dropped);
  }
  return (bits & 0x807fffff) | (119 + random() % 9) << 23;
}

/// Operands in port order, as words whose low bits count: planes of a box in order, lengths not negative. One
/// in eight is any pattern of bits, NaN and infinities included.
template <class Pipeline, class F>
std::vector<std::uint64_t> random_operands(std::mt19937_64& random) {
  using Operands = typename Pipeline::template Operands<Native, F>;
  std::vector<std::uint64_t> words;
  const bool any = random() % 8 == 0;
  const Operands shape{};
  Operands::for_each(F(), shape, [&](const Operand& port, const auto& /*field*/) {
    std::uint64_t word = any || port.kind == Kind::flag ? random() : random_word(port, random);
    const std::uint64_t sign = std::uint64_t{1} << (port.width - 1);
    if (port.role == Role::length) word &= sign - 1;
    if (port.role == Role::plane_high && !any) {
      std::uint64_t& lower = words.back();
      const bool negative = (lower & word & sign) != 0 && port.kind == Kind::real;
      const auto order = [&](std::uint64_t x) { return static_cast<std::int64_t>(x << (64 - port.width)); };
      if ((order(word) < order(lower)) != negative) std::swap(word, lower);
    }
    words.push_back(word);
  });
  return words;
}

/// Takes words as operands, in port order.
struct WordReader {
  template <class Field>
  void operator()(const Operand& /*port*/, Field& field) {
    field = *next++;
  }
  template <class D, class F>
  void operator()(const Operand& /*port*/, Fp<D, F>& field) {
    field.bits = *next++;
  }

  const std::uint64_t* next;
};

/// The pipeline's HIT in domain D.
template <class Pipeline, class D, class F>
bool pipeline_hit(const std::vector<std::uint64_t>& words) {
  using Operands = typename Pipeline::template Operands<D, F>;
  Operands in;
  Operands::for_each(F(), in, WordReader{words.data()});
  return Pipeline::template test<D>(F(), in).hit.to_bool();
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
    const bool expected = pipeline_hit<Pipeline, Native, F>(words);
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
