#include "cli/report/sweep_plot.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/plot.hpp"
#include "cli/report/sweep_rows.hpp"
#include "cli/report/unit_marks.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

constexpr const char* extra_boxes = "extra box tests, % above conservative float slabs";
constexpr const char* extra_triangles = "extra triangle tests, % above conservative float slabs";
using Diagrams = std::array<Diagram, 7>;

constexpr Diagrams diagrams_of(bool on_chip) {
  return {
      {{"error_run_time", "error and run time of box tests alone", "run_time_ms",
        "run time of the box tests, ms (cycles × clock period)", "extra_box_tests_pct", extra_boxes},
       {"error_software_time", "error and measured run time in software", "software_s_per_mray",
        "processor time of the traversal in software, s for a million rays", "extra_box_tests_pct",
        extra_boxes},
       {"error_area", "error and area", on_chip ? "area_per_box_lut" : "area_per_box_mm2",
        on_chip ? "lookup tables for each box tested in a cycle" : "area for each box tested in a cycle, mm²",
        "extra_box_tests_pct", extra_boxes},
       {"error_area_run_time", "error and area × run time of box tests alone",
        on_chip ? "area_run_time_lut_ms" : "area_run_time_mm2_ms",
        on_chip ? "lookup tables × run time of the box tests, LUT ms"
                : "area × run time of the box tests, mm² ms",
        "extra_box_tests_pct", extra_boxes},
       {"whole_run_time", "error and run time with triangle tests", "whole_run_time_ms",
        "run time of box tests and triangle tests, ms", "extra_triangle_tests_pct", extra_triangles},
       {"whole_area_run_time", "error and area × run time with triangle tests",
        on_chip ? "whole_area_run_time_lut_ms" : "whole_area_run_time_mm2_ms",
        on_chip ? "lookup tables × run time of box unit and triangle unit, LUT ms"
                : "area × run time of box unit and triangle unit, mm² ms",
        "extra_triangle_tests_pct", extra_triangles},
       {"memory", "error and memory traffic", "bytes_per_ray", "bytes of nodes and triangles for each ray",
        "extra_box_tests_pct", extra_boxes}}};
}

constexpr Diagrams diagrams_of_cells = diagrams_of(false);
constexpr Diagrams diagrams_of_chips = diagrams_of(true);

std::vector<double> column(std::span<const sim::SweepRow> units, std::string_view name) {
  std::vector<double> values;
  for (const sim::SweepRow& unit : units) values.push_back(sim::sweep_column(name).number(unit));
  return values;
}

/// One unit of a design at its intervals.
struct RateLine {
  rtl::Format format;
  std::vector<sim::SweepRow> rows;
};

std::vector<RateLine> rate_lines(std::span<const sim::SweepRow> units) {
  std::map<std::size_t, RateLine> by_design;  // by the place in the catalogue
  std::map<std::pair<std::string, std::string>, std::vector<sim::SweepRow>> all;
  for (const sim::SweepRow& unit : units) all[{unit.design, unit.bits}].push_back(unit);
  for (const auto& [name, rows] : all) {
    if (rows.size() < 2) continue;
    const rtl::Design& design = rtl::find_design(name.first);
    const rtl::Format format = design.parse_format(name.second);
    const auto [line, first] = by_design.try_emplace(rtl::place_of(design).value(), RateLine{format, rows});
    const rtl::Format& shown = line->second.format;
    if (!first && shown != design.default_format &&
        (format == design.default_format || shown.numbers() < format.numbers()))
      line->second = {format, rows};
  }
  std::vector<RateLine> lines;
  for (auto& [place, line] : by_design) lines.push_back(std::move(line));
  return lines;
}

constexpr const char* front_title = "Pareto front";

std::string front_plot() {
  return fmt::format("plot $front using 1:2 with steps lc rgb '#888888' lw 1.5 dt 2 title '{}'", front_title);
}

/// The steps of the front, for labels to keep off.
std::vector<PlotSegment> steps_between(const std::vector<Mark>& corners) {
  std::vector<PlotSegment> lines;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Mark bend{corners[i].x, corners[i - 1].y};
    lines.push_back({corners[i - 1], bend});
    lines.push_back({bend, corners[i]});
  }
  return lines;
}

/// Where the values of axes are in a plot.
struct Places {
  const LogAxis& x;
  const LogAxis& y;
  Mark size;

  [[nodiscard]] Mark of(double at_x, double at_y) const {
    return {x.share(at_x) * size.x, y.share(at_y) * size.y};
  }
};

}  // namespace

std::vector<CostAndError> pareto_front(std::vector<CostAndError> units) {
  std::sort(units.begin(), units.end(), [](const CostAndError& a, const CostAndError& b) {
    return std::pair(a.cost, a.error) < std::pair(b.cost, b.error);
  });
  std::vector<CostAndError> front;
  for (const CostAndError& unit : units) {
    if (front.empty() || unit.error < front.back().error) front.push_back(unit);
  }
  return front;
}

std::span<const Diagram> diagrams(bool on_chip) {
  return on_chip ? diagrams_of_chips : diagrams_of_cells;
}

Picture diagram_picture(const std::string& scene, std::span<const sim::SweepRow> units,
                        const Diagram& diagram, const PictureForm& form) {
  const std::vector<double> costs = column(units, diagram.cost);
  const std::vector<double> errors = column(units, diagram.error);
  const LogAxis x(costs);
  const LogAxis y(errors);
  std::vector<std::string> designs;
  for (const sim::SweepRow& unit : units)
    if (std::find(designs.begin(), designs.end(), unit.design) == designs.end())
      designs.push_back(unit.design);
  std::vector<std::string> keys = designs;
  keys.emplace_back(front_title);
  const PlotFrame frame = plot_frame(form, diagram.cost_label, diagram.error_label, keys);
  const Places places{x, y, frame.size};

  std::vector<CostAndError> all;
  std::vector<PlotMark> marks;
  for (std::size_t i = 0; i < units.size(); ++i) {
    all.push_back({x.shown(costs[i]), y.shown(errors[i])});
    marks.push_back({units[i].design, units[i].bits, style_of(units[i].design), all[i].cost, all[i].error,
                     places.of(costs[i], errors[i])});
  }
  enlarge_hidden(marks);
  std::string front;
  std::vector<Mark> corners;
  for (const CostAndError& at : pareto_front(all)) {
    front += fmt::format("{:.6g} {:.6g}\n", at.cost, at.error);
    corners.push_back(places.of(at.cost, at.error));
  }
  const PlacedLabels labels =
      place_mark_labels(unit_labels(marks), marks, steps_between(corners), frame.size);
  std::string plots = front_plot() + ", " + marks_plot();
  for (const std::string& design : designs) plots += ", " + mark_key(style_of(design), design);
  return {diagram.name,
          scene + ": " + diagram.title,
          frame.picture_height,
          frame.settings + axes_settings(x, y, frame.size) + labels.settings + data_block("front", front) +
              marks_data(marks),
          plots + "\n",
          labels.left_out};
}

std::optional<Picture> rate_picture(const std::string& scene, std::span<const sim::SweepRow> units,
                                    const PictureForm& form) {
  const std::vector<RateLine> lines = rate_lines(units);
  if (lines.empty()) return {};
  const bool on_chip = units.front().on_chip();
  const auto area = [&](const sim::SweepRow& row) {
    return sim::sweep_column(on_chip ? "luts" : "area_mm2").number(row);
  };
  const auto rate = [](const sim::SweepRow& row) { return 1000 / row.box_time_ns(); };
  std::vector<double> rates;
  std::vector<double> areas;
  std::vector<CostAndError> all;
  std::vector<std::string> keys;
  for (const RateLine& line : lines) {
    for (const sim::SweepRow& row : line.rows) {
      rates.push_back(rate(row));
      areas.push_back(area(row));
      all.push_back({row.box_time_ns(), area(row)});
    }
    keys.push_back(rtl::find_design(line.rows.front().design).name_at(line.format));
  }
  const LogAxis x(rates);
  const LogAxis y(areas);
  std::vector<std::string> all_keys = keys;
  all_keys.emplace_back(front_title);
  const PlotFrame frame =
      plot_frame(form, "boxes a second of a full unit, millions",
                 on_chip ? "lookup tables of the unit" : "area of the unit, mm²", all_keys);
  const Places places{x, y, frame.size};
  std::string front;
  std::vector<Mark> corners;
  for (const CostAndError& at : pareto_front(all)) {
    front += fmt::format("{:.6g} {:.6g}\n", 1000 / at.cost, at.error);
    corners.push_back(places.of(1000 / at.cost, at.error));
  }
  std::vector<PlotSegment> segments = steps_between(corners);
  std::vector<PlotMark> marks;
  std::string data = data_block("front", front);
  std::string plots = front_plot();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const DesignStyle style = style_of(lines[i].rows.front().design);
    std::string points;
    for (const sim::SweepRow& row : lines[i].rows) {
      points += fmt::format("{:.6g} {:.6g}\n", rate(row), area(row));
      const Mark place = places.of(rate(row), area(row));
      if (&row != &lines[i].rows.front()) segments.push_back({marks.back().place, place});
      marks.push_back({row.design, fmt::format("{}", row.interval), style, rate(row), area(row), place});
    }
    data += data_block(fmt::format("unit{}", i), points);
    plots += fmt::format(", $unit{} using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 title {}", i,
                         style.colour, style.shape, style.size, gnuplot_string(keys[i]));
  }
  const PlacedLabels labels = place_mark_labels(name_labels(marks), marks, segments, frame.size);
  return Picture{
      "area_rate",          scene + ": area and boxes a second",
      frame.picture_height, frame.settings + axes_settings(x, y, frame.size) + labels.settings + data,
      plots + "\n",         labels.left_out};
}

}  // namespace hitpipe::cli
