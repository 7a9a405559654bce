// How far a figure of ours is from the thesis's, by one rule for all figures. The figure is the one that the
// thesis's statement is about: where it says "4 % more tests", 4 and not 104. A printed figure stands for
// everything that is rounded to it, so it is first moved towards ours by at most half a unit of its last
// digit. The factor between the two then decides; two figures of different signs have no factor and differ.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sw_ref/judge/interval.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// In ascending distance.
enum class Verdict { agrees, same_order, differs };

inline constexpr double agreeing_factor = 1.25;
inline constexpr double same_order_factor = 3.0;

/// "agrees", "same order", "differs".
[[nodiscard]] std::string_view verdict_name(Verdict verdict);

struct Comparison {
  std::string what;  ///< with the unit
  double printed;
  double ours;
  double half_unit = 0;                ///< of the printed figure's last digit
  std::optional<Interval> interval{};  ///< 95 %, of ours, when ours is measured on a sample
};

/// At least 1; infinite for figures of different signs, or if only one of them is 0.
[[nodiscard]] double factor_between(const Comparison& comparison);
[[nodiscard]] Verdict verdict_of(const Comparison& comparison);

/// The comparison with the largest factor; there must be one.
[[nodiscard]] const Comparison& worst_of(std::span<const Comparison> comparisons);

/// The verdict with its distance: "agrees within 8 %", "same order, factor 2.3", "differs, factor 44",
/// "differs".
[[nodiscard]] std::string verdict_text(const Comparison& comparison);

/// "37.1", or "37.1 (35.2 to 39)" with an interval.
[[nodiscard]] std::string figure_text(double figure, const std::optional<Interval>& interval = {});

}  // namespace hitpipe::thesis
