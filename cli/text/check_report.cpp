#include "cli/text/check_report.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/text/kept.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/judge/adversary/case.hpp"

namespace nlohmann {

template <>
struct adl_serializer<hitpipe::ref::adversary::Case, void> {
  static void to_json(auto& row, const hitpipe::ref::adversary::Case& c) {
    row = hitpipe::ref::adversary::to_text(c);
  }
  static void from_json(const auto& row, hitpipe::ref::adversary::Case& c) {
    c = hitpipe::ref::adversary::parse_case(row.template get<std::string>());
  }
};

}  // namespace nlohmann

namespace hitpipe::cli {

template <>
struct Kept<sim::CategoryResult> {
  static void each(auto& result, const auto& member) {
    member("category", result.category);
    member("tests", result.tests);
    member("exact_hits", result.hits);
    member("false_misses", result.false_misses);
    member("false_hits", result.false_hits);
    member("rtl_mismatches", result.rtl_mismatches);
    member("false_miss_sums", result.false_miss_share);
    member("false_hit_sums", result.false_hit_share);
    member("false_miss", result.false_miss);
  }
};

namespace {

using ref::adversary::Case;

void add(std::vector<sim::CategoryResult>& sums, const std::vector<sim::CategoryResult>& later) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += later.at(i);
}

/// In percent, with its 95 % interval, as columns of CSV and JSON.
void add_share(Row& row, const std::string& name, const ref::GroupedRatio& share) {
  const ref::Interval interval = share.share_interval();
  row[name] = 100 * share.ratio();
  row[name + "_low"] = 100 * interval.low;
  row[name + "_high"] = 100 * interval.high;
}

Row row_of(const CheckFindings& findings, OutputFormat format, const sim::CategoryResult& r,
           const sim::CategoryResult* comparison) {
  Row row;
  if (format != OutputFormat::text)
    row.update({{"design", findings.design}, {"bits", to_string(findings.format)}, {"seed", findings.seed}});
  row.update({{"category", r.category},
              {"tests", r.tests},
              {"exact_hits", r.hits},
              {"false_misses", r.false_misses},
              {"false_hits", r.false_hits}});
  if (format != OutputFormat::text) {
    add_share(row, "false_miss_pct", r.false_miss_share);
    add_share(row, "false_hit_pct", r.false_hit_share);
  }
  if (comparison != nullptr) row["ize_misses"] = comparison->false_misses;
  if (comparison != nullptr && format != OutputFormat::text) {
    add_share(row, "ize_false_miss_pct", comparison->false_miss_share);
    row["ize_false_hits"] = comparison->false_hits;
  }
  if (findings.rtl) row["rtl_mismatches"] = r.rtl_mismatches;
  return row;
}

/// One line: a share of all tests, in percent.
std::string share_text(const std::string& what, const std::string& of, const ref::GroupedRatio& share) {
  const ref::Interval interval = share.share_interval();
  return fmt::format("{}: {:.4g} % of the boxes {}; 95 %: {:.4g} to {:.4g}; {} rays\n", what,
                     100 * share.ratio(), of, 100 * interval.low, 100 * interval.high, share.groups());
}

std::string replay_command(const CheckFindings& findings, const Case& c) {
  const std::string bits = rtl::find_design(findings.design).bits_option(findings.format);
  return fmt::format("hitpipe check {}{} --replay \"{}\"", findings.design, bits, ref::adversary::to_text(c));
}

/// Prints the wrong answers on standard error, and returns the exit code.
int verdict(const CheckFindings& findings, const sim::CategoryResult& sum) {
  const rtl::Design& design = rtl::find_design(findings.design);
  if (sum.false_miss) {
    const std::unique_ptr<sim::BoxTest> test = sim::make_box_test(design, findings.format);
    const Case simple =
        ref::adversary::shrink(*sum.false_miss, [&](const Case& c) { return sim::is_false_miss(*test, c); });
    fmt::print(stderr, "hitpipe: {} false misses; the first, simplified: {}\n", sum.false_misses,
               replay_command(findings, simple));
  }
  if (sum.rtl_mismatches > 0) {
    fmt::print(stderr, "hitpipe: {} {}: {} answers of the Verilog differ from the C++\n", findings.design,
               to_string(findings.format), sum.rtl_mismatches);
  }
  return check_verdict(design, sum.false_misses, sum.rtl_mismatches);
}

std::string interval_text(const ref::GroupedRatio& share) {
  const ref::Interval interval = share.share_interval();
  const auto percent = [](double end) {
    const bool tiny = end > 0 && end < 5e-5;
    return tiny ? fmt::format("{:.0e}", 100 * end) : fmt::format("{:.2f}", 100 * end);
  };
  return percent(interval.low) + "-" + percent(interval.high);
}

/// Of 80 columns. `unit`: the design's name beside its first category, its bits beside the second.
Row short_row(const std::string& unit, const sim::CategoryResult& r) {
  return {{"design", unit},
          {"category", r.category},
          {"misses", r.false_misses},
          {"95 % of met", interval_text(r.false_miss_share)},
          {"false hits, %",
           fmt::format("{:5.2f} ({})", 100 * r.false_hit_share.ratio(), interval_text(r.false_hit_share))}};
}

}  // namespace

CheckFindings& CheckFindings::operator+=(const CheckFindings& later) {
  add(categories, later.categories);
  add(comparison, later.comparison);
  return *this;
}

void to_json(Row& row, const CheckedUnit& unit) {
  row = {{"design", unit.design}, {"bits", to_string(unit.format)}, {"seed", unit.seed}, {"rtl", unit.rtl}};
}

void from_json(const Row& row, CheckedUnit& unit) {
  row.at("design").get_to(unit.design);
  unit.format = rtl::find_design(unit.design).parse_format(row.at("bits").get<std::string>());
  row.at("seed").get_to(unit.seed);
  row.at("rtl").get_to(unit.rtl);
}

std::string head_of(const CheckedUnit& unit) {
  return fmt::format("{} {}, seed {}\n", unit.design, to_string(unit.format), unit.seed);
}

void to_json(Row& row, const CheckFindings& findings) {
  to_json(row, static_cast<const CheckedUnit&>(findings));
  row.update({{"categories", findings.categories}, {"comparison", findings.comparison}});
}

void from_json(const Row& row, CheckFindings& findings) {
  from_json(row, static_cast<CheckedUnit&>(findings));
  row.at("categories").get_to(findings.categories);
  row.at("comparison").get_to(findings.comparison);
}

int check_verdict(const rtl::Design& design, std::uint64_t false_misses, std::uint64_t rtl_mismatches) {
  return (false_misses > 0 && design.conservative) || rtl_mismatches > 0 ? 1 : 0;
}

int report_findings(const CheckFindings& findings, OutputFormat format) {
  std::vector<Row> rows;
  sim::CategoryResult sum;
  sim::CategoryResult comparison_sum;
  for (std::size_t i = 0; i < findings.categories.size(); ++i) {
    const sim::CategoryResult* const other = findings.comparison.empty() ? nullptr : &findings.comparison[i];
    rows.push_back(row_of(findings, format, findings.categories[i], other));
    sum += findings.categories[i];
    if (other != nullptr) comparison_sum += *other;
  }
  sum.category = "all";
  // A table of categories has no row of another kind: whoever adds them up would count it twice.
  if (format != OutputFormat::csv)
    rows.push_back(row_of(findings, format, sum, findings.comparison.empty() ? nullptr : &comparison_sum));
  if (format == OutputFormat::text) fmt::print("{}", head_of(findings));
  fmt::print("{}", table_text(rows, format));
  if (format == OutputFormat::text) {
    fmt::print("{}{}", share_text("false misses", "met", sum.false_miss_share),
               share_text("false hits", "missed", sum.false_hit_share));
  }
  return verdict(findings, sum);
}

UnitsFindings& UnitsFindings::operator+=(const UnitsFindings& later) {
  for (std::size_t i = 0; i < units.size(); ++i) units[i] += later.units.at(i);
  return *this;
}

void to_json(Row& row, const UnitsFindings& findings) {
  row = {{"units", findings.units}};
}

void from_json(const Row& row, UnitsFindings& findings) {
  row.at("units").get_to(findings.units);
}

int report_findings(const UnitsFindings& findings, OutputFormat format) {
  std::vector<Row> rows;
  std::vector<sim::CategoryResult> sums;
  for (const CheckFindings& unit : findings.units) {
    sim::CategoryResult& sum = sums.emplace_back();
    std::vector<sim::CategoryResult> results = unit.categories;
    for (const sim::CategoryResult& result : results) sum += result;
    sum.category = "all";
    if (format != OutputFormat::csv) results.push_back(sum);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::string beside = i == 0 ? unit.design : i == 1 ? to_string(unit.format) : "";
      rows.push_back(format == OutputFormat::text ? short_row(beside, results[i])
                                                  : row_of(unit, format, results[i], nullptr));
    }
  }
  if (format == OutputFormat::text)
    fmt::print(
        "seed {}, {} tests of each unit\n"
        "misses         false misses; then the 95 % interval of their share of boxes met\n"
        "false hits, %  of the boxes missed, with the 95 % interval of that share\n",
        findings.units.front().seed, sums.front().tests);
  fmt::print("{}", table_text(rows, format));
  int exit_code = 0;
  for (std::size_t i = 0; i < sums.size(); ++i)
    exit_code = std::max(exit_code, verdict(findings.units[i], sums[i]));
  return exit_code;
}

}  // namespace hitpipe::cli
