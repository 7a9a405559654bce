#include "cli/text/stiffness_report.hpp"

#include <fmt/format.h>

namespace hitpipe::cli {

namespace {

std::string ratio_text(sim::Stiffness stiffness) {
  return stiffness ? fmt::format("2^{}", *stiffness) : "zero";
}

Row row_of(const MeasuredDesign& d, const Measured& m, sim::Stiffness stiffness, const std::string& boxes) {
  return {{"design", d.design->name},
          {"bits", to_string(m.format)},
          {"log2_ratio", stiffness ? Row(*stiffness) : Row("inf")},
          {"boxes", boxes}};
}

/// In percent, with its 95 % interval.
struct Figure {
  double percent;
  ref::Interval interval;
};
using FigureOf = Figure (*)(const Measured&, std::size_t);

/// One table: a row for each ratio, a column for each format. Below each row half the widths of its 95 %
/// intervals.
std::string text_of(const MeasuredDesign& d, FigureOf figure, int decimals, const std::string& what) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < sim::stiffnesses().size(); ++i) {
    Row row{{"ratio", ratio_text(sim::stiffnesses()[i])}};
    Row spread{{"ratio", "+-95 %"}};
    for (const Measured& m : d.formats) {
      const auto [percent, interval] = figure(m, i);
      row[to_string(m.format)] = fmt::format("{:>7.{}f}", percent, decimals);
      spread[to_string(m.format)] = fmt::format("{:>7.{}f}", (interval.high - interval.low) / 2, decimals);
    }
    rows.push_back(std::move(row));
    rows.push_back(std::move(spread));
  }
  return fmt::format("{}: {}\n{}", d.design->name, what, table_text(rows, OutputFormat::text));
}

}  // namespace

std::vector<Row> stiffness_rows(const std::vector<MeasuredDesign>& designs, const std::string& scene) {
  std::vector<Row> rows;
  for (const MeasuredDesign& d : designs) {
    for (const Measured& m : d.formats) {
      const auto add_boxes = [&](const sim::StiffBoxes& b, const std::string& kind) {
        Row row = row_of(d, m, b.stiffness, kind);
        row.update({{"tests", b.tests},
                    {"exact_hits", b.hits},
                    {"false_misses", b.false_misses},
                    {"false_hits", b.false_hits},
                    {"false_hit_pct", b.false_hit_pct()},
                    {"false_hit_pct_low", b.false_hit_pct_interval().low},
                    {"false_hit_pct_high", b.false_hit_pct_interval().high},
                    {"rays", nullptr},
                    {"reference_tests", nullptr},
                    {"extra_box_tests_pct", nullptr},
                    {"extra_box_tests_pct_low", nullptr},
                    {"extra_box_tests_pct_high", nullptr},
                    {"different_triangles", nullptr}});
        rows.push_back(std::move(row));
      };
      for (const sim::StiffBoxes& b : m.boxes)
        add_boxes(b, fmt::format("{} 2^-{}", b.aimed ? "aimed" : "anywhere", b.half_side));
      for (const sim::StiffTraversals& t : m.traversals) {
        Row row = row_of(d, m, t.stiffness, scene);
        row.update({{"tests", t.box_tests},
                    {"exact_hits", nullptr},
                    {"false_misses", nullptr},
                    {"false_hits", nullptr},
                    {"false_hit_pct", nullptr},
                    {"false_hit_pct_low", nullptr},
                    {"false_hit_pct_high", nullptr},
                    {"rays", t.rays},
                    {"reference_tests", t.reference_box_tests},
                    {"extra_box_tests_pct", t.extra_box_tests_pct()},
                    {"extra_box_tests_pct_low", t.extra_box_tests_pct_interval().low},
                    {"extra_box_tests_pct_high", t.extra_box_tests_pct_interval().high},
                    {"different_triangles", t.different_triangles}});
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

std::string stiffness_text(const std::vector<MeasuredDesign>& designs, const std::string& scene) {
  const auto of_boxes = [](const Measured& m, std::size_t i) {
    return Figure{m.all_boxes[i].false_hit_pct(), m.all_boxes[i].false_hit_pct_interval()};
  };
  const auto of_scene = [](const Measured& m, std::size_t i) {
    return Figure{m.traversals[i].extra_box_tests_pct(), m.traversals[i].extra_box_tests_pct_interval()};
  };
  std::string text;
  for (const MeasuredDesign& d : designs) {
    if (!text.empty()) text += '\n';
    text += text_of(d, of_boxes, 4, "false hits, % of the boxes that the ray misses");
    if (!scene.empty()) {
      text += '\n' + text_of(d, of_scene, 2,
                             fmt::format("extra box tests on {}, % above conservative float slabs", scene));
    }
  }
  const Measured& any = designs.front().formats.front();
  const std::string rays = scene.empty() ? "" : fmt::format(" and {} rays", any.traversals.front().rays);
  text += fmt::format("\n{} tests{} a ratio; +-95 %: half the width of the 95 % interval\n",
                      any.all_boxes.front().tests, rays);
  return text;
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
