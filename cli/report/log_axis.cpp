#include "cli/report/log_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::cli {

namespace {

constexpr double margin = 0.03;         // of the length, so that marks at the ends are whole
constexpr double least_ratio = 1.05;    // of the ends, when all data is one number
constexpr double below_positive = 0.3;  // where "≤ 0" stands, of the least positive number

/// The tics of a decade, from few to many.
const std::array<std::vector<double>, 5> tic_series{
    {{1}, {1, 3}, {1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 7}, {1,   1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2, 2.2, 2.5, 2.8,
                                                       3.2, 3.6, 4,   4.5, 5,   5.5, 6,   7, 8,   9}}};

std::vector<double> tics_of(const std::vector<double>& decade, double least, double most) {
  std::vector<double> tics;
  for (int power = static_cast<int>(std::floor(std::log10(least))); std::pow(10, power) <= most; ++power) {
    for (const double tic : decade) {
      const double value = tic * std::pow(10, power);
      if (value >= least && value <= most) tics.push_back(value);
    }
  }
  return tics;
}

}  // namespace

LogAxis::LogAxis(std::span<const double> values) {
  double least = 0;
  double most = 0;
  bool zero = false;
  for (const double value : values) {
    zero = zero || value <= 0;
    if (value <= 0) continue;
    least = least == 0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
  if (least == 0) least = most = 1;
  if (zero) zero_ = least * below_positive;
  const double low = zero ? zero_ : least;
  const double ratio = std::max(most / low, least_ratio);
  least_ = low / std::pow(ratio, margin);
  most_ = std::max(most, low * least_ratio) * std::pow(ratio, margin);
}

double LogAxis::share(double value) const {
  return std::log(shown(value) / least_) / std::log(most_ / least_);
}

double LogAxis::at(double share) const {
  return least_ * std::pow(most_ / least_, share);
}

std::string LogAxis::tics() const {
  constexpr std::size_t enough = 4;
  std::vector<double> chosen;
  const double least = zero_ > 0 ? zero_ * 1.5 : least_;
  for (const std::vector<double>& decade : tic_series) {
    chosen = tics_of(decade, least, most_);
    if (chosen.size() >= enough) break;
  }
  std::vector<std::string> texts;
  if (zero_ > 0) texts.push_back(fmt::format("'≤ 0' {}", zero_));
  for (const double tic : chosen) texts.push_back(fmt::format("'{:.4g}' {:.4g}", tic, tic));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace hitpipe::cli
