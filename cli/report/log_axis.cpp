#include "cli/report/log_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/label_places.hpp"

namespace hitpipe::cli {

namespace {

constexpr double margin = 0.03;         // of the length, so that marks at the ends are whole
constexpr double least_decade = 10;     // of the ends, when there is a place for "≤ 0"
constexpr double least_ratio = 1.05;    // of the ends, when all data is one number
constexpr double below_positive = 0.3;  // of the length: how far "≤ 0" stands below the least positive number
constexpr double zero_margin = 0.1;     // below it, so that labels have room there
constexpr double between_tics = 6;      // in units

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
  if (zero) zero_ = least / std::pow(std::max(most / least, least_decade), below_positive);
  const double low = zero ? zero_ : least;
  const double ratio = std::max(most / low, least_ratio);
  least_ = low / std::pow(ratio, zero ? zero_margin : margin);
  most_ = std::max(most, low * least_ratio) * std::pow(ratio, margin);
}

double LogAxis::share(double value) const {
  return std::log(shown(value) / least_) / std::log(most_ / least_);
}

template <class Room>
std::string LogAxis::tics(double length, const Room& room) const {
  constexpr std::size_t enough = 4;
  std::vector<Tic> kept;
  const auto keep = [&](const Tic& tic) {
    const bool free = std::all_of(kept.begin(), kept.end(), [&](const Tic& other) {
      return std::abs(share(tic.value) - share(other.value)) * length >=
             (room(tic.text) + room(other.text)) / 2 + between_tics;
    });
    if (free) kept.push_back(tic);
  };
  if (zero_ > 0) keep({"≤ 0", zero_});
  const double least = zero_ > 0 ? zero_ * 1.5 : least_;
  std::vector<double> chosen;
  for (const std::vector<double>& decade : tic_series) {
    chosen = tics_of(decade, least, most_);
    if (chosen.size() >= enough) break;
  }
  // Where there is not room for all, those of the shorter series stay.
  for (const std::vector<double>& decade : tic_series)
    for (const double value : tics_of(decade, least, most_))
      if (std::find(chosen.begin(), chosen.end(), value) != chosen.end())
        keep({fmt::format("{:.6g}", value), value});
  std::sort(kept.begin(), kept.end(), [](const Tic& a, const Tic& b) { return a.value < b.value; });
  std::vector<std::string> texts;
  for (const Tic& tic : kept) texts.push_back(fmt::format("'{}' {:.4g}", tic.text, tic.value));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string LogAxis::tics_across(double length) const {
  return tics(length, [](const std::string& text) { return text_width(text); });
}

std::string LogAxis::tics_upward(double length) const {
  return tics(length, [](const std::string&) { return line_height; });
}

}  // namespace hitpipe::cli
