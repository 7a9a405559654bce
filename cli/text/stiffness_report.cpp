#include "cli/text/stiffness_report.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hitpipe::cli {

namespace {

std::string ratio_text(sim::Stiffness stiffness) {
  return stiffness ? fmt::format("2^{}", *stiffness) : "zero";
}

Row row_of(const MeasuredDesign& d, const Measured& m, sim::Stiffness stiffness, const std::string& boxes) {
  return {{"design", d.design->name},
          {"bits", rtl::to_string(m.format)},
          {"ratio", ratio_text(stiffness)},
          {"boxes", boxes}};
}

/// A share in percent, with its 95 % interval.
struct SampledPercent {
  double percent;
  ref::Interval interval;
};
SampledPercent boxes_pct(const Measured& m, std::size_t i) {
  return {m.all_boxes[i].false_hit_pct(), m.all_boxes[i].false_hit_interval_pct()};
}
SampledPercent traversals_pct(const Measured& m, std::size_t i) {
  return {m.traversals[i].extra_box_tests_pct(), m.traversals[i].extra_box_tests_interval_pct()};
}
using Percent = SampledPercent (*)(const Measured&, std::size_t);

constexpr std::size_t formats_of_a_table = 4;  // of 80 columns

/// Tables with a row for each ratio and a column for each format.
std::string text_of(const MeasuredDesign& d, Percent percent, int decimals, const std::string& what) {
  std::string text = fmt::format("{}: {}\n", d.design->name, what);
  for (std::size_t first = 0; first < d.formats.size(); first += formats_of_a_table) {
    const std::size_t end = std::min(d.formats.size(), first + formats_of_a_table);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < sim::stiffnesses().size(); ++i) {
      Row row{{"ratio", ratio_text(sim::stiffnesses()[i])}};
      for (std::size_t f = first; f < end; ++f) {
        const SampledPercent sampled = percent(d.formats[f], i);
        row[rtl::to_string(d.formats[f].format)] =
            fmt::format("{:>7.{}f} +-{:.2g}", sampled.percent, decimals,
                        (sampled.interval.high - sampled.interval.low) / 2);
      }
      rows.push_back(std::move(row));
    }
    text += table_text(rows, Format::text);
  }
  return text;
}

Plot plot_of(const std::vector<MeasuredDesign>& designs, Percent percent, std::string title,
             std::string counted) {
  Plot plot{
      .title = std::move(title), .counted = std::move(counted), .exponents = {}, .panels = {}, .least = 0.01};
  for (const sim::Stiffness stiffness : sim::stiffnesses()) {
    if (stiffness) plot.exponents.push_back(*stiffness);
  }
  const auto line_of = [&](const Measured& m) {
    PlotLine line{rtl::to_string(m.format), {}};
    for (std::size_t i = 0; i < sim::stiffnesses().size(); ++i) line.percent.push_back(percent(m, i).percent);
    return line;
  };
  for (const MeasuredDesign& d : designs) {
    PlotPanel panel{std::string(d.design->name), {}};
    for (const Measured& m : d.formats) panel.lines.push_back(line_of(m));
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

}  // namespace

std::vector<Row> stiffness_rows(const std::vector<MeasuredDesign>& designs, const std::string& scene) {
  std::vector<Row> rows;
  for (const MeasuredDesign& d : designs) {
    for (const Measured& m : d.formats) {
      const auto add_boxes = [&](const sim::StiffBoxes& b, const std::string& kind) {
        Row row = row_of(d, m, b.stiffness, kind);
        const ref::Interval interval = b.false_hit_interval_pct();
        row.update({{"tests", b.tests},
                    {"hits", b.hits},
                    {"false_misses", b.false_misses},
                    {"false_hits", b.false_hits},
                    {"false_hit_pct", b.false_hit_pct()},
                    {"false_hit_low_pct", interval.low},
                    {"false_hit_high_pct", interval.high},
                    {"rays", nullptr},
                    {"reference_tests", nullptr},
                    {"extra_box_tests_pct", nullptr},
                    {"extra_box_tests_low_pct", nullptr},
                    {"extra_box_tests_high_pct", nullptr},
                    {"different_triangles", nullptr}});
        rows.push_back(std::move(row));
      };
      for (const sim::StiffBoxes& b : m.boxes)
        add_boxes(b, fmt::format("{} 2^-{}", b.aimed ? "aimed" : "anywhere", b.half_side));
      for (const sim::StiffBoxes& b : m.all_boxes) add_boxes(b, "all");
      for (const sim::StiffTraversals& t : m.traversals) {
        const ref::Interval interval = t.extra_box_tests_interval_pct();
        Row row = row_of(d, m, t.stiffness, scene);
        row.update({{"tests", t.box_tests},
                    {"hits", nullptr},
                    {"false_misses", nullptr},
                    {"false_hits", nullptr},
                    {"false_hit_pct", nullptr},
                    {"false_hit_low_pct", nullptr},
                    {"false_hit_high_pct", nullptr},
                    {"rays", t.rays},
                    {"reference_tests", t.reference_box_tests},
                    {"extra_box_tests_pct", t.extra_box_tests_pct()},
                    {"extra_box_tests_low_pct", interval.low},
                    {"extra_box_tests_high_pct", interval.high},
                    {"different_triangles", t.different_triangles}});
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

std::string stiffness_text(const std::vector<MeasuredDesign>& designs, const std::string& scene) {
  std::string text;
  for (const MeasuredDesign& d : designs) {
    if (!text.empty()) text += '\n';
    text += text_of(d, boxes_pct, 4, "false hits, % of the boxes that the ray misses");
    if (!scene.empty()) {
      text += '\n' + text_of(d, traversals_pct, 2,
                             fmt::format("extra box tests on {}, % above robust float slabs", scene));
    }
  }
  if (designs.empty()) return text;
  const Measured& m = designs.front().formats.front();
  text += fmt::format("\nFor each ratio {} boxes", m.all_boxes.front().tests);
  if (!scene.empty()) text += fmt::format(" and {} rays through the scene", m.traversals.front().rays);
  return text + ". +-: half of the 95 % interval.\n";
}

Plot boxes_plot(const std::vector<MeasuredDesign>& designs) {
  return plot_of(designs, boxes_pct, "False hits on stiff rays, of the boxes that they miss", "false hits");
}

Plot traversals_plot(const std::vector<MeasuredDesign>& designs, const std::string& scene) {
  return plot_of(designs, traversals_pct,
                 fmt::format("Box tests of stiff rays on {}, above robust float slabs", scene),
                 "extra box tests");
}

std::uint64_t wrong_answers(const std::vector<MeasuredDesign>& designs) {
  std::uint64_t wrong = 0;
  for (const MeasuredDesign& d : designs) {
    if (!d.design->conservative) continue;
    for (const Measured& m : d.formats) {
      for (const sim::StiffBoxes& b : m.boxes) wrong += b.false_misses;
      for (const sim::StiffTraversals& t : m.traversals) wrong += t.different_triangles;
    }
  }
  return wrong;
}

}  // namespace hitpipe::cli
