#include "thesis/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace hitpipe::thesis {

std::string_view verdict_name(Verdict verdict) {
  if (verdict == Verdict::agrees) return "agrees";
  return verdict == Verdict::same_order ? "same order" : "differs";
}

double factor_between(const Comparison& comparison) {
  const double ours = comparison.ours;
  const double printed =
      std::clamp(ours, comparison.printed - comparison.half_unit, comparison.printed + comparison.half_unit);
  if (printed == ours) return 1.0;
  if (printed * ours <= 0) return std::numeric_limits<double>::infinity();
  return std::max(ours / printed, printed / ours);
}

Verdict verdict_of(const Comparison& comparison) {
  const double factor = factor_between(comparison);
  if (factor <= agreeing_factor) return Verdict::agrees;
  return factor <= same_order_factor ? Verdict::same_order : Verdict::differs;
}

const Comparison& worst_of(std::span<const Comparison> comparisons) {
  return *std::max_element(comparisons.begin(), comparisons.end(), [](const auto& a, const auto& b) {
    return factor_between(a) < factor_between(b);
  });
}

std::string verdict_text(const Comparison& comparison) {
  const double factor = factor_between(comparison);
  const std::string_view name = verdict_name(verdict_of(comparison));
  if (factor == 1.0) return std::string(name);
  if (std::isinf(factor)) return fmt::format("{}, {}", name, comparison.ours == 0 ? "0" : "other sign");
  if (verdict_of(comparison) == Verdict::agrees)
    return fmt::format("{} within {:.0f} %", name, std::ceil(100 * (factor - 1)));
  return fmt::format("{}, factor {:.{}f}", name, factor, factor < 10 ? 1 : 0);
}

std::string figure_text(double figure, const std::optional<Interval>& interval) {
  const std::string text = fmt::format("{:.3g}", figure);
  // Whole numbers of more than three digits are exact.
  const std::string exact = std::abs(figure) >= 1000 ? fmt::format("{:.0f}", figure) : text;
  if (!interval) return exact;
  return fmt::format("{} ({:.3g} to {:.3g})", exact, interval->low, interval->high);
}

}  // namespace hitpipe::thesis
