#include "cli/text/check_report.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "sim/software/software.hpp"
#include "sw_ref/judge/adversary/case.hpp"

namespace hitpipe::cli {

namespace {

using ref::adversary::Case;

Row kept(const sim::CategoryResult& result) {
  Row row{{"category", result.category},
          {"tests", result.tests},
          {"exact_hits", result.hits},
          {"false_misses", result.false_misses},
          {"false_hits", result.false_hits},
          {"rtl_mismatches", result.rtl_mismatches},
          {"false_miss_sums", result.false_miss_share.sums()},
          {"false_hit_sums", result.false_hit_share.sums()}};
  if (result.false_miss) row["false_miss"] = ref::adversary::to_text(*result.false_miss);
  return row;
}

sim::CategoryResult parse_kept(const Row& row) {
  const auto share = [&](const char* name) {
    return ref::GroupedRatio::of(row.at(name).get<ref::GroupedRatio::Sums>());
  };
  sim::CategoryResult result{.category = row.at("category").get<std::string>(),
                             .tests = row.at("tests").get<std::uint64_t>(),
                             .hits = row.at("exact_hits").get<std::uint64_t>(),
                             .false_misses = row.at("false_misses").get<std::uint64_t>(),
                             .false_hits = row.at("false_hits").get<std::uint64_t>(),
                             .rtl_mismatches = row.at("rtl_mismatches").get<std::uint64_t>(),
                             .false_miss_share = share("false_miss_sums"),
                             .false_hit_share = share("false_hit_sums"),
                             .false_miss = {}};
  if (row.contains("false_miss"))
    result.false_miss = ref::adversary::parse_case(row.at("false_miss").get<std::string>());
  return result;
}

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

Row to_row(const CheckFindings& findings) {
  const auto all = [](const std::vector<sim::CategoryResult>& results) {
    Row rows = Row::array();
    for (const sim::CategoryResult& result : results) rows.push_back(kept(result));
    return rows;
  };
  return {{"design", findings.design},
          {"bits", to_string(findings.format)},
          {"seed", findings.seed},
          {"rtl", findings.rtl},
          {"categories", all(findings.categories)},
          {"comparison", all(findings.comparison)}};
}

CheckFindings parse_findings(const Row& row) {
  const auto all = [&](const char* name) {
    std::vector<sim::CategoryResult> results;
    for (const Row& each : row.at(name)) results.push_back(parse_kept(each));
    return results;
  };
  const std::string design = row.at("design").get<std::string>();
  return {.design = design,
          .format = rtl::find_design(design).parse_format(row.at("bits").get<std::string>()),
          .seed = row.at("seed").get<std::uint64_t>(),
          .rtl = row.at("rtl").get<bool>(),
          .categories = all("categories"),
          .comparison = all("comparison")};
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
  if (format == OutputFormat::text) {
    fmt::print("{} {}, seed {}\n", findings.design, to_string(findings.format), findings.seed);
  }
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

Row to_row(const UnitsFindings& findings) {
  Row units = Row::array();
  for (const CheckFindings& unit : findings.units) units.push_back(to_row(unit));
  return {{"units", units}};
}

UnitsFindings parse_units_findings(const Row& row) {
  UnitsFindings findings;
  for (const Row& unit : row.at("units")) findings.units.push_back(parse_findings(unit));
  return findings;
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
