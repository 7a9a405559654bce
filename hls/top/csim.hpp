// The test program of a top function: random operands, its results against the native pipeline's. With a
// vendor's ap_int.h this compares that vendor's arithmetic with hitpipe's. Not for synthesis.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <random>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "hls/box/operand.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp.hpp"
#include "hls/top/top_domain.hpp"

namespace hitpipe::hls::top {

constexpr std::uint64_t low_bits(int width) {
  return ~std::uint64_t{0} >> (64 - width);
}

/// A port and the word on it; the word's low bits count.
struct OperandWord {
  Operand port;
  std::uint64_t word;
};
struct ResultWord {
  Result port;
  std::uint64_t word;
};

/// Draws a word for each operand: an integer that is small more often than not, or a float of magnitude 2^-8
/// to 2. With `any`, any pattern of bits.
struct DrawOperands {
  template <class Field>
  void operator()(const Operand& port, const Field& /*field*/) {
    const std::uint64_t bits = random();
    if (any || port.kind == Kind::flag) return keep(port, bits);
    const int dropped = 64 - port.width + static_cast<int>(random() % 6);
    keep(port, static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> std::min(dropped, 63)));
  }
  template <class D, class F>
  void operator()(const Operand& port, const Fp<D, F>& field) {
    const std::uint64_t bits = random();
    if (any) return keep(port, bits);
    const int fraction = field.format.fraction;
    const int smallest = std::max(1, (1 << (field.format.exponent - 1)) - 1 - 8);
    const std::uint64_t exponent = static_cast<std::uint64_t>(smallest) + random() % 9;
    const std::uint64_t sign = std::uint64_t{1} << (port.width - 1);
    keep(port, (bits & (sign | low_bits(fraction))) | exponent << fraction);
  }

  void keep(const Operand& port, std::uint64_t word) {
    const bool positive = port.role == Role::length;
    words.push_back({port, positive ? word & low_bits(port.width - 1) : word});
  }

  bool any;
  std::mt19937_64& random;
  std::vector<OperandWord> words{};
};

/// Whether the number on a is below that on b; of floats, whether its pattern is, signs considered.
inline bool is_below(const OperandWord& a, const OperandWord& b) {
  const auto number = [](const OperandWord& x) {
    return static_cast<std::int64_t>(x.word << (64 - x.port.width));
  };
  const bool both_negative = number(a) < 0 && number(b) < 0;
  return a.port.kind == Kind::real && both_negative ? number(b) < number(a) : number(a) < number(b);
}

/// Words in port order: planes of a box in order, lengths not negative. One draw in eight is any pattern of
/// bits, NaN and infinities included.
template <class Pipeline, class F>
std::vector<OperandWord> random_operands(std::mt19937_64& random) {
  using Operands = typename Pipeline::template Operands<Native, F>;
  const bool any = random() % 8 == 0;
  DrawOperands draw{any, random};
  const Operands shape{};
  Operands::for_each(F(), shape, draw);
  for (OperandWord& high : draw.words) {
    if (any || high.port.role != Role::plane_high) continue;
    for (OperandWord& low : draw.words) {
      const bool same_slab = low.port.axis == high.port.axis && low.port.box == high.port.box;
      if (low.port.role == Role::plane_low && same_slab && is_below(high, low))
        std::swap(low.word, high.word);
    }
  }
  return draw.words;
}

/// Takes words as operands, in port order.
struct WordReader {
  template <class Field>
  void operator()(const Operand& /*port*/, Field& field) {
    field = (next++)->word;
  }
  template <class D, class F>
  void operator()(const Operand& /*port*/, Fp<D, F>& field) {
    field.bits = (next++)->word;
  }

  const OperandWord* next;
};

/// The pipeline's results in domain D.
template <class Pipeline, class D, class F>
std::vector<ResultWord> pipeline_results(const std::vector<OperandWord>& words) {
  using Operands = typename Pipeline::template Operands<D, F>;
  using Results = typename Pipeline::template Results<D, F>;
  Operands in;
  Operands::for_each(F(), in, WordReader{words.data()});
  const Results out = Pipeline::template test<D>(F(), in);
  std::vector<ResultWord> results;
  Results::for_each(F(), out, [&](const Result& port, const auto& field) {
    results.push_back({port, static_cast<std::uint64_t>(field.to_int64()) & low_bits(port.width)});
  });
  return results;
}

/// HIT of the first box.
inline bool is_hit(const std::vector<ResultWord>& results) {
  return std::any_of(results.begin(), results.end(), [](const ResultWord& result) {
    return result.port.meaning == Meaning::hit && result.port.box == 0 && result.word != 0;
  });
}

/// The top's results, in order. Each starts as the opposite of what is expected: an output that is not
/// written shows.
template <class... Words>
std::vector<std::uint64_t> top_results(void (*top)(Words...), const std::vector<OperandWord>& words,
                                       const std::vector<ResultWord>& expected) {
  std::tuple<std::remove_reference_t<Words>...> ports;
  std::vector<std::uint64_t> results;
  std::size_t place = 0;
  const auto start = [&](auto& port) {
    port = place < words.size() ? words[place].word : ~expected.at(place - words.size()).word;
    ++place;
  };
  const auto keep_result = [&](const auto& port) {
    if (place++ < words.size()) return;
    const int width = expected.at(results.size()).port.width;
    results.push_back(static_cast<std::uint64_t>(port.to_int64()) & low_bits(width));
  };
  std::apply(
      [&](auto&... port) {
        (start(port), ...);
        top(port...);
        place = 0;
        (keep_result(port), ...);
      },
      ports);
  return results;
}

struct Comparison {
  int tests = 0, hits = 0, mismatches = 0;
};

/// Prints the first mismatch, with its operands in hexadecimal.
template <class Pipeline, class F, class... Words>
Comparison compare(void (*top)(Words...), int tests, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Comparison comparison;
  for (; comparison.tests < tests; ++comparison.tests) {
    const std::vector<OperandWord> words = random_operands<Pipeline, F>(random);
    const std::vector<ResultWord> expected = pipeline_results<Pipeline, Native, F>(words);
    comparison.hits += is_hit(expected) ? 1 : 0;
    const std::vector<std::uint64_t> results = top_results(top, words, expected);
    std::size_t wrong = 0;
    while (wrong < expected.size() && results.at(wrong) == expected[wrong].word) ++wrong;
    if (wrong == expected.size()) continue;
    if (comparison.mismatches++ > 0) continue;
    std::printf("%s test %d: %s %llx, expected %llx; operands", Pipeline::name, comparison.tests,
                expected[wrong].port.name, static_cast<unsigned long long>(results[wrong]),
                static_cast<unsigned long long>(expected[wrong].word));
    for (const OperandWord& operand : words)
      std::printf(" %llx", static_cast<unsigned long long>(operand.word));
    std::printf("\n");
  }
  return comparison;
}

/// The main() of a C simulation: 0 when every test agrees.
template <class Pipeline, class F, class... Words>
int csim(void (*top)(Words...)) {
  constexpr int tests = 10000;
  constexpr std::uint64_t seed = 11;
  const Comparison result = compare<Pipeline, F>(top, tests, seed);
  std::printf("%s: seed %d, %d tests, %d hits, %d mismatches\n", Pipeline::name, static_cast<int>(seed),
              result.tests, result.hits, result.mismatches);
  return result.mismatches == 0 && result.hits > 0 && result.hits < result.tests ? 0 : 1;
}

}  // namespace hitpipe::hls::top
