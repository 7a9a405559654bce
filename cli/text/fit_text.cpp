#include "cli/text/fit_text.hpp"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/text/table.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

constexpr const char* legend = R"(
before, after  area in mm2, account built: the whole design, and what is left
saved%, ADP%   of the area, and of area times delay
stages         before>after
bytes          of a node of the hierarchy in so many bits
extra%         box tests beyond conservative float slabs, which miss none
wrong          answers and triangles that differ, and false misses; must be 0
)";

std::string text_of(const Row& row, const char* key) {
  return row.at(key).get<std::string>();
}
double number_of(const Row& row, const char* key) {
  return row.at(key).get<double>();
}
/// 0 for a count that no one judged.
std::uint64_t count_of(const Row& row, const char* key) {
  return row.at(key).is_null() ? 0 : row.at(key).get<std::uint64_t>();
}

std::uint64_t wrong_answers(const Row& row) {
  return count_of(row, "vector_mismatches") + count_of(row, "rtl_mismatches") +
         count_of(row, "different_triangles") + count_of(row, "false_misses");
}

/// As text of 80 columns.
Row short_row(const Row& row) {
  const double extra = number_of(row, "extra_box_tests_pct");
  return {{"design", row.at("design")},
          {"bits", row.at("bits")},
          {"before", fmt::format("{:.4f}", number_of(row, "area_before_mm2"))},
          {"after", fmt::format("{:.4f}", number_of(row, "area_after_mm2"))},
          {"saved%", fmt::format("{:.1f}", number_of(row, "area_saved_pct"))},
          {"stages", fmt::format("{}>{}", count_of(row, "stages_before"), count_of(row, "stages"))},
          {"ADP%", fmt::format("{:.1f}", 100.0 - 100.0 * number_of(row, "area_delay_mm2_ns") /
                                                     number_of(row, "area_delay_before_mm2_ns"))},
          {"bytes", row.at("bytes_per_node")},
          // Prints zero without a sign.
          {"extra%", fmt::format("{:.2f}", std::abs(extra) < 0.005 ? 0.0 : extra)},
          {"wrong", wrong_answers(row)}};
}

std::string evidence_text(const ref::SceneDemands& demands, bool bounds) {
  std::string text;
  for (const ref::Evidence& each : demands.evidence()) {
    if (each.bounds != bounds) continue;
    text += "  " + host::wrapped(each.demand, 4, 2) + "    " + host::wrapped(each.why, 6, 4);
  }
  return text;
}

/// The format before the fit, the search's other starts, and its result, with their costs.
std::string search_text(const FitReport& report) {
  const auto starts = report.row.at("search_starts").get<std::vector<std::string>>();
  if (starts.empty()) return "";
  const std::vector<std::string> others(starts.begin() + 1, starts.end());
  return "  " + host::wrapped(fmt::format("compared by {}: before {}{}{}; result {} {:.4g}",
                                          text_of(report.row, "search_measure"), starts.front(),
                                          others.empty() ? "" : "; other starts ", fmt::join(others, ", "),
                                          text_of(report.row, "bits"), number_of(report.row, "search_cost")),
                              4, 2);
}

std::string design_text(const FitReport& report) {
  const Row& row = report.row;
  const std::string bits = text_of(row, "bits");
  const std::string before = text_of(row, "bits_before");
  std::string text = fmt::format("\n{} {}{}\n", text_of(row, "design"), bits,
                                 before == bits ? "" : fmt::format(", {} before", before));
  text += report.left_out.empty() ? "  left out: nothing, the scene needs it all\n"
                                  : "  left out, each with the share of the area that it saves alone:\n";
  const double whole_um2 = number_of(row, "area_before_mm2") * 1e6;
  for (const sim::LeftOut& cut : report.left_out) {
    text += fmt::format("  {:6.2f} %  ", 100.0 * static_cast<double>(cut.area_um2) / whole_um2) +
            host::wrapped(cut.what, 14, 12) + std::string(12, ' ') + host::wrapped(cut.why, 14, 12);
  }
  if (row.at("ray_ends").get<bool>() && !row.at("endless_extra_box_tests_pct").is_null())
    text += "  " + host::wrapped(fmt::format("ends of rays kept: {:.2f} % extra box tests without them",
                                             number_of(row, "endless_extra_box_tests_pct")),
                                 4, 2);
  text += search_text(report);
  text += "  " + host::wrapped("whole cost " + report.cost, 4, 2);
  if (row.contains("ii"))
    text += "  " + host::wrapped(
                       fmt::format(
                           "takes {:.4g} million boxes a second, and traces {:.4g} million rays of the image "
                           "a second",
                           number_of(row, "boxes_per_second") / 1e6, number_of(row, "rays_per_second") / 1e6),
                       4, 2);
  const auto kept = row.at("kept_whole").get<std::vector<std::string>>();
  text += "  " + host::wrapped(fmt::format("ports kept whole: {}", fmt::join(kept, ", ")), 4, 2);
  text +=
      "  " +
      host::wrapped(fmt::format("compared with the C++: {} vectors, {} of them hits; {} box tests of {} rays",
                                count_of(row, "vectors"), count_of(row, "vector_hits"),
                                count_of(row, "box_tests"), count_of(row, "rays")),
                    4, 2);
  return text;
}

}  // namespace

std::string fit_text(const std::string& scene, const ref::SceneDemands& demands,
                     const std::vector<FitReport>& reports, const std::vector<std::string>& advice) {
  std::string text = fmt::format("What {} asks for\n", scene) + evidence_text(demands, true) +
                     "What cannot be bounded is kept\n" + evidence_text(demands, false) + "\n";
  std::vector<Row> table;
  for (const FitReport& report : reports) table.push_back(short_row(report.row));
  text += table_text(table, OutputFormat::text) + legend + "\n";
  for (const std::string& line : advice) text += host::wrapped(line, 2);
  for (const FitReport& report : reports) text += design_text(report);
  return text;
}

std::string wrong_text(const FitReport& report) {
  const Row& row = report.row;
  if (wrong_answers(row) == 0) return "";
  const std::string text = fmt::format(
      "{} {} fitted to {}: {} vector mismatches, {} RTL mismatches, {} different triangles, {} false misses; "
      "all must be 0",
      text_of(row, "design"), text_of(row, "bits"), text_of(row, "scene"), count_of(row, "vector_mismatches"),
      count_of(row, "rtl_mismatches"), count_of(row, "different_triangles"), count_of(row, "false_misses"));
  return report.first_mismatch.empty() ? text
                                       : fmt::format("{}; first vector: {}", text, report.first_mismatch);
}

}  // namespace hitpipe::cli
