// A design's own C++ on the host, at one format.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "hls/box/operand.hpp"
#include "host/format.hpp"

namespace hitpipe::rtl {

/// In the order of hls::Meaning.
inline constexpr std::array<std::string_view, 26> meaning_names{
    "hit",        "entry",  "exit",       "order",        "determinant",   "determinant_low", "volume",
    "volume_low", "edge_u", "edge_u_low", "edge_v",       "edge_v_low",    "error",           "axis",
    "back",       "origin", "slope",      "mantissa_low", "mantissa_high", "exponent",        "length",
    "tie",        "once",   "side",       "zero",         "inner"};

/// Where HIT of the first box is among a design's results. Throws std::invalid_argument when there is none.
[[nodiscard]] std::size_t place_of_hit(std::span<const hls::Result> results);

/// The result that says yes or no: HIT of the first box or, in a design without HIT, its error.
struct Verdict {
  std::size_t place;  ///< among the design's results
  bool yes;           ///< an error of 0 is a yes

  [[nodiscard]] bool operator()(const std::int64_t* results) const { return (results[place] != 0) == yes; }
};
/// Throws std::invalid_argument when there is neither.
[[nodiscard]] Verdict verdict_of(std::span<const hls::Result> results);

class Evaluate {
 public:
  /// Operands in port order, each sign-extended when its port is signed; bits above a port's width are
  /// ignored.
  using Run = void (*)(const Format& format, const std::int64_t* operands, std::int64_t* results);
  static constexpr std::size_t most_results = 24;

  /// `results` are the design's. Throws std::invalid_argument when there are more than most_results, or no
  /// verdict.
  Evaluate(Run run, const Format& format, std::span<const hls::Result> results);

  /// HIT of the first box. Throws std::logic_error when the design has none.
  bool operator()(const std::int64_t* operands) const {
    std::array<std::int64_t, most_results> results;  // NOLINT: run_ writes as many as the design has
    run_(format_, operands, results.data());
    return hit(results.data());
  }
  /// All results, in the design's order.
  void operator()(const std::int64_t* operands, std::int64_t* results) const {
    run_(format_, operands, results);
  }
  /// HIT of the first box, from all results. Throws std::logic_error when the design has none.
  [[nodiscard]] bool hit(const std::int64_t* results) const {
    if (!verdict_.yes) throw_no_hit();
    return verdict_(results);
  }
  /// The verdict of all results: HIT or, in a design without HIT, that there is no error.
  [[nodiscard]] bool yes(const std::int64_t* results) const { return verdict_(results); }
  [[nodiscard]] std::size_t result_count() const { return result_count_; }

 private:
  [[noreturn]] static void throw_no_hit();

  Run run_;
  Format format_;
  Verdict verdict_;
  std::size_t result_count_;
};

}  // namespace hitpipe::rtl
