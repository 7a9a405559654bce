#include "sw_ref/judge/interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hitpipe::ref {

namespace {

/// 95 % of a normal distribution lie within this many standard deviations.
constexpr double normal_quantile = 1.959963984540054;

/// The quantile of Student's distribution, because few groups tell little of their own spread. Abramowitz and
/// Stegun 26.7.5, within 1 % from 4 degrees of freedom on.
double students_quantile(double degrees) {
  const double z = normal_quantile;
  const double z3 = z * z * z;
  const double z5 = z3 * z * z;
  const double z7 = z5 * z * z;
  return z + (z3 + z) / (4 * degrees) + (5 * z5 + 16 * z3 + 3 * z) / (96 * degrees * degrees) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * degrees * degrees * degrees);
}

/// Wilson 1927: solves |share - p| = z sqrt(p (1 - p) / cases) for p.
Interval wilson(double share, double cases) {
  if (cases <= 0) return {0, 1};
  const double z = normal_quantile;
  const double shrink = 1 + z * z / cases;
  const double middle = (share + z * z / (2 * cases)) / shrink;
  const double half = z * std::sqrt(share * (1 - share) / cases + z * z / (4 * cases * cases)) / shrink;
  return {share <= 0 ? 0.0 : middle - half, share >= 1 ? 1.0 : middle + half};
}

}  // namespace

Middle middle_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  Middle middle{.median = (values[(n - 1) / 2] + values[n / 2]) / 2};
  // The median lies outside the values number k to n - 1 - k if at most k coins of n fall on one side.
  double coins = std::pow(0.5, static_cast<double>(n)), outside = 0;
  constexpr double most_outside = 0.05;
  for (std::size_t k = 0; k < n / 2; ++k) {
    outside += 2 * coins;
    if (outside > most_outside) break;
    middle.interval = {values[k], values[n - 1 - k]};
    coins *= static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  return middle;
}

Middle middle_ratio(std::span<const double> above, std::span<const double> below) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i] / below[i]);
  return middle_of(std::move(ratios));
}

Interval wilson_interval(std::uint64_t part, std::uint64_t whole) {
  const auto cases = static_cast<double>(whole);
  return wilson(whole == 0 ? 0.0 : static_cast<double>(part) / cases, cases);
}

double Share::percent() const {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

Interval Share::percent_interval() const {
  const Interval share = wilson_interval(part, whole);
  return {100 * share.low, 100 * share.high};
}

void GroupedRatio::add(double above, double below) {
  if (above == 0 && below == 0) return;
  ++groups_;
  above_ += above;
  below_ += below;
  above_squared_ += above * above;
  below_squared_ += below * below;
  product_ += above * below;
}

GroupedRatio& GroupedRatio::operator+=(const GroupedRatio& other) {
  groups_ += other.groups_;
  above_ += other.above_;
  below_ += other.below_;
  above_squared_ += other.above_squared_;
  below_squared_ += other.below_squared_;
  product_ += other.product_;
  return *this;
}

GroupedRatio::Sums GroupedRatio::sums() const {
  return {static_cast<double>(groups_), above_, below_, above_squared_, below_squared_, product_};
}

GroupedRatio GroupedRatio::of(const Sums& sums) {
  GroupedRatio ratio;
  ratio.groups_ = static_cast<std::uint64_t>(sums[0]);
  ratio.above_ = sums[1];
  ratio.below_ = sums[2];
  ratio.above_squared_ = sums[3];
  ratio.below_squared_ = sums[4];
  ratio.product_ = sums[5];
  return ratio;
}

double GroupedRatio::ratio() const {
  return groups_ == 0 ? 0.0 : above_ / below_;
}

/// Cochran, Sampling Techniques, chapter 6: the spread of above - ratio * below, which is 0 on average.
double GroupedRatio::variance() const {
  const auto groups = static_cast<double>(groups_);
  const double r = ratio();
  const double squares = above_squared_ - 2 * r * product_ + r * r * below_squared_;
  return std::max(0.0, squares) * groups / (groups - 1) / (below_ * below_);
}

double GroupedRatio::deviation() const {
  return std::sqrt(variance());
}

Interval GroupedRatio::interval() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (groups_ < 2) return {-infinity, infinity};
  const double half = students_quantile(static_cast<double>(groups_ - 1)) * deviation();
  return {ratio() - half, ratio() + half};
}

Interval GroupedRatio::share_interval() const {
  const double share = ratio();
  const auto groups = static_cast<double>(groups_);
  if (groups_ < 2 || share <= 0 || share >= 1) return wilson(share, groups);
  // Korn and Graubard 1998: few groups know their own spread badly, so they count as fewer cases.
  const double few = students_quantile(groups - 1) / normal_quantile;
  const double spread = few * few * variance();
  return wilson(share, spread > 0 ? std::min(below_, share * (1 - share) / spread) : below_);
}

void ExtraWork::add(std::uint64_t work, std::uint64_t reference) {
  groups_.add(static_cast<double>(work), static_cast<double>(reference));
  with_more_ += work > reference ? 1 : 0;
  with_less_ += work < reference ? 1 : 0;
}

ExtraWork& ExtraWork::operator+=(const ExtraWork& other) {
  groups_ += other.groups_;
  with_more_ += other.with_more_;
  with_less_ += other.with_less_;
  return *this;
}

double ExtraWork::percent() const {
  return groups_.groups() == 0 ? 0.0 : 100 * (groups_.ratio() - 1);
}

std::optional<Interval> ExtraWork::percent_interval() const {
  if (groups_.groups() < 2) return std::nullopt;
  if (with_more_ == 0 && with_less_ == 0) return Interval{0, 100 * wilson_interval(0, groups_.groups()).high};
  if (with_less_ > 0) {
    const Interval ratio = groups_.interval();
    return Interval{100 * (ratio.low - 1), 100 * (ratio.high - 1)};
  }
  const double extra = percent();
  // Few groups with more know their own spread badly.
  const double half =
      100 * students_quantile(std::max(3.0, static_cast<double>(with_more_))) * groups_.deviation();
  // Solves |extra - p| = half * sqrt(p / extra) for p.
  const double middle = extra + half * half / (2 * extra);
  const double reach = half * std::sqrt(1 + half * half / (4 * extra * extra));
  return Interval{std::max(0.0, middle - reach), middle + reach};
}

}  // namespace hitpipe::ref
