#include "cli/text/check_report.hpp"

#include <memory>

#include <fmt/format.h>

#include "sim/software.hpp"
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
    row.update(
        {{"design", findings.design}, {"bits", rtl::to_string(findings.format)}, {"seed", findings.seed}});
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
          {"bits", rtl::to_string(findings.format)},
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
  const rtl::Design& design = rtl::find_design(findings.design);
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
    fmt::print("{} {}, seed {}\n", findings.design, rtl::to_string(findings.format), findings.seed);
  }
  fmt::print("{}", table_text(rows, format));
  if (format == OutputFormat::text) {
    fmt::print("{}{}", share_text("false misses", "met", sum.false_miss_share),
               share_text("false hits", "missed", sum.false_hit_share));
  }
  if (sum.false_miss) {
    const std::unique_ptr<sim::BoxTest> test = sim::make_box_test(design, findings.format);
    const Case simple =
        ref::adversary::shrink(*sum.false_miss, [&](const Case& c) { return sim::is_false_miss(*test, c); });
    fmt::print(stderr, "hitpipe: {} false misses; the first, simplified: {}\n", sum.false_misses,
               replay_command(findings, simple));
  }
  if (sum.rtl_mismatches > 0) {
    fmt::print(stderr, "hitpipe: {} answers of the Verilog differ from the C++\n", sum.rtl_mismatches);
  }
  return check_verdict(design, sum.false_misses, sum.rtl_mismatches);
}

}  // namespace hitpipe::cli
