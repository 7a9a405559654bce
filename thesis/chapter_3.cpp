// Tables 3.1 and 3.2: eleven box tests and also Woo's, on pairs with 0, 50 and 100 % hits.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "thesis/printed.hpp"
#include "thesis/tables.hpp"
#include "thesis/timing.hpp"
#include "thesis/variants.hpp"

namespace hitpipe::thesis {
namespace {

constexpr std::size_t pair_count = 100'000;  // the thesis has 500,000; neither fits a cache
constexpr int rounds = 5;                    // over all pairs, in one timed run
constexpr std::array hit_percents{0, 50, 100};
constexpr std::array<std::string_view, 3> printed_columns{"time_hit0M_miss50M_s", "time_hit25M_miss25M_s",
                                                          "time_hit50M_miss0M_s"};
constexpr double printed_half_unit = 0.05;        // seconds
constexpr std::string_view unit_variant = "plu";  // its time at 50 % hits is 1

/// Seconds of each run by variant and share of hits.
using Times = std::map<std::pair<std::string_view, int>, std::vector<double>>;

Times measured(int precision_bits, const ExperimentOptions& options) {
  Times times;
  for (int run = 0; run < options.repeats; ++run) {
    for (const BoxTestTiming& timing : time_box_tests(pair_count, rounds)) {
      if (timing.precision_bits != precision_bits) continue;
      times[{timing.variant, timing.hit_percent}].push_back(timing.seconds);
    }
    options.progress((run + 1.0) / options.repeats);
  }
  return times;
}

/// By how many percent `faster` is faster than `slower`, at each share of hits.
Finding compared(const Times& times, const PrintedTable& printed, const std::string& claim,
                 std::string_view faster, std::string_view slower) {
  Finding finding{claim, {}, other_machine};
  for (std::size_t i = 0; i < hit_percents.size(); ++i) {
    const int percent = hit_percents.at(i);
    const double a = *printed.find({faster})->number(printed_columns.at(i));
    const double b = *printed.find({slower})->number(printed_columns.at(i));
    const ref::Middle by_runs = ref::middle_ratio(times.at({slower, percent}), times.at({faster, percent}));
    finding.figures.push_back({fmt::format("{} faster than {} at {} % hits, %", faster, slower, percent),
                               100 * (b / a - 1), 100 * (by_runs.median - 1),
                               100 * b / a * (printed_half_unit / a + printed_half_unit / b),
                               percent_more(by_runs)});
  }
  return finding;
}

}  // namespace

ResultTable box_test_times(std::string_view number, const ExperimentOptions& options) {
  const int precision_bits = number == "3.1" ? 32 : 64;
  const PrintedTable& printed = printed_table(number);
  const Times times = measured(precision_bits, options);
  ResultTable table;
  table.number = number;
  table.title = fmt::format("Ray-box tests in binary{}: time by share of hits; {} at 50 % is 1",
                            precision_bits, unit_variant);
  table.labels = {"variant"};
  for (const int percent : hit_percents) table.columns.push_back({fmt::format("hit_{}_pct", percent), 2});
  const std::vector<double>& unit = times.at({unit_variant, 50});
  const double printed_unit = *printed.find({unit_variant})->number(printed_columns[1]);
  const auto variants = box_test_variants<float>();
  for (const BoxTestVariant& variant : variants) {
    ResultRow row{.labels = {std::string(variant.name)}, .ours = {}, .printed = {}};
    if (variant.name == unit_variant) row.unit = 1;
    const PrintedRow* const thesis = printed.find({variant.name});
    for (std::size_t i = 0; i < hit_percents.size(); ++i) {
      const ref::Middle ratio = ref::middle_ratio(times.at({variant.name, hit_percents[i]}), unit);
      row.ours.emplace_back(ratio.median);
      row.intervals.push_back(ratio.interval);
      row.printed.push_back(thesis == nullptr
                                ? std::nullopt
                                : std::optional(*thesis->number(printed_columns[i]) / printed_unit));
    }
    drop_empty_intervals(row);
    table.rows.push_back(std::move(row));
  }
  const auto add = [&](const std::string& claim, std::string_view faster, std::string_view slower) {
    table.findings.push_back(compared(times, printed, claim, faster, slower));
  };
  add("Pluecker is considerably faster than the best slabs test", "plu", "slabs8-mul");
  add("Pluecker with a distance is faster than slabs", "plu-int-mul", "slabs8-mul");
  add("multiplying is faster than dividing", "slabs8-mul", "slabs8-div");
  add("eight cases make slabs faster", "slabs8-mul", "slabs-mul");
  add("stored coefficients make Pluecker a few percent faster", "plu-cff", "plu");
  add("the separating axis test is as fast as Pluecker", "sat", "plu");
  table.notes.push_back(fmt::format("{} pairs, {} times, the median of {} runs; woo is not in the thesis",
                                    pair_count, rounds, options.repeats));
  if (options.repeats >= runs_of_interval) table.notes.emplace_back(interval_note);
  return table;
}

}  // namespace hitpipe::thesis
