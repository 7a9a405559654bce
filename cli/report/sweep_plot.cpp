#include "cli/report/sweep_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/plot.hpp"
#include "cli/report/sweep_rows.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::array design_colours{"#0072B2", "#D55E00", "#806000", "#000000", "#00664B", "#CC79A7",
                                    "#56B4E9", "#8C6D31", "#444444", "#7A1F5C", "#004C77", "#8F3F00"};
constexpr std::array design_shapes{7, 5, 8, 13, 10, 9, 11, 15, 4, 6, 12, 14};

constexpr const char* extra_boxes = "extra box tests, % above conservative float slabs";
constexpr const char* extra_triangles = "extra triangle tests, % above conservative float slabs";
using Diagrams = std::array<Diagram, 6>;

constexpr Diagrams diagrams_of(bool on_chip) {
  return {
      {{"error_run_time", "error and run time of box tests alone", "run_time_ms",
        "run time of the box tests, ms (cycles × clock period)", "extra_box_tests_pct", extra_boxes},
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

DesignStyle style_of(const std::string& design) {
  return design_style(rtl::place_of(rtl::find_design(design)).value());
}

/// The thesis's units with their occupancy by rays in flight.
struct OccupancyLine {
  std::vector<std::string> names;
  std::string design;  ///< of the first
  std::map<int, double> by_rays;

  /// So close that the lines would lie on one another.
  [[nodiscard]] bool is_like(const std::map<int, double>& other) const {
    return std::equal(by_rays.begin(), by_rays.end(), other.begin(), other.end(),
                      [](const auto& a, const auto& b) {
                        return a.first == b.first && std::abs(a.second - b.second) < 1.0;
                      });
  }
};

std::vector<OccupancyLine> occupancy_lines(std::span<const sim::SweepRow> units) {
  std::vector<OccupancyLine> of_units;
  for (const sim::SweepRow& unit : units) {
    if (!is_thesis_unit(unit)) continue;
    const std::string name = unit_name(unit);
    auto line = std::find_if(of_units.begin(), of_units.end(),
                             [&](const OccupancyLine& each) { return each.names.front() == name; });
    if (line == of_units.end()) line = of_units.insert(of_units.end(), {{name}, unit.design, {}});
    line->by_rays[unit.rays_in_flight] = unit.occupancy_pct();
  }
  std::vector<OccupancyLine> lines;
  for (const OccupancyLine& unit : of_units) {
    if (unit.by_rays.size() < 2) continue;
    const auto like = std::find_if(lines.begin(), lines.end(),
                                   [&](const OccupancyLine& line) { return line.is_like(unit.by_rays); });
    if (like == lines.end()) {
      lines.push_back(unit);
    } else {
      like->names.push_back(unit.names.front());
    }
  }
  return lines;
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

}  // namespace

DesignStyle design_style(std::size_t place) {
  const std::size_t turn = place / design_shapes.size();
  const std::size_t larger = turn / design_shapes.size();
  return {design_colours[place % design_colours.size()], design_shapes[(place + turn) % design_shapes.size()],
          0.9 + 0.3 * static_cast<double>(larger)};
}

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

std::string diagram_script(const std::string& scene, std::span<const sim::SweepRow> units,
                           const Diagram& diagram) {
  const std::vector<double> costs = column(units, diagram.cost);
  const std::vector<double> errors = column(units, diagram.error);
  const LogAxis x(costs);
  const LogAxis y(errors);
  const Mark size = plot_size();
  std::vector<CostAndError> all;
  std::vector<Mark> places;
  for (std::size_t i = 0; i < units.size(); ++i) {
    all.push_back({x.shown(costs[i]), y.shown(errors[i])});
    places.push_back({x.share(costs[i]) * size.x, y.share(errors[i]) * size.y});
  }
  std::string front;
  for (const CostAndError& at : pareto_front(all)) front += fmt::format("{:.6g} {:.6g}\n", at.cost, at.error);

  const std::vector<UnitMark> marks = unit_marks(units, places);
  std::vector<std::string> designs;
  std::map<std::string, std::string> points;
  for (const UnitMark& mark : marks) {
    if (!points.contains(mark.design)) designs.push_back(mark.design);
    points[mark.design] +=
        fmt::format("{:.6g} {:.6g}\n", x.at(mark.place.x / size.x), y.at(mark.place.y / size.y));
  }
  constexpr std::size_t other_key_entries = 1;  // the front
  std::string text = plot_head(scene + ": " + diagram.title, designs.size() + other_key_entries);
  text += fmt::format("set logscale xy\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", x.least(),
                      x.most(), y.least(), y.most());
  text += fmt::format("set xtics ({})\nset ytics ({})\nset xlabel {}\nset ylabel {}\n", x.tics(), y.tics(),
                      gnuplot_string(diagram.cost_label), gnuplot_string(diagram.error_label));
  text += mark_labels(marks, size) + data_block("front", front);
  std::string plot = "plot $front using 1:2 with steps lc rgb '#888888' lw 1.5 dt 2 title 'Pareto front'";
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const DesignStyle style = style_of(designs[i]);
    text += data_block(fmt::format("units{}", i), points[designs[i]]);
    plot += fmt::format(", $units{} using 1:2 with points lc rgb '{}' pt {} ps {:g} lw 1.5 title {}", i,
                        style.colour, style.shape, style.size, gnuplot_string(designs[i]));
  }
  return text + plot + "\n";
}

std::string rate_script(const std::string& scene, std::span<const sim::SweepRow> units) {
  const std::vector<RateLine> lines = rate_lines(units);
  if (lines.empty()) return "";
  const bool on_chip = units.front().on_chip();
  const auto area = [&](const sim::SweepRow& row) {
    return sim::sweep_column(on_chip ? "luts" : "area_mm2").number(row);
  };
  const auto rate = [](const sim::SweepRow& row) { return 1000 / row.box_time_ns(); };
  std::vector<double> rates;
  std::vector<double> areas;
  for (const RateLine& line : lines)
    for (const sim::SweepRow& row : line.rows) {
      rates.push_back(rate(row));
      areas.push_back(area(row));
    }
  const LogAxis x(rates);
  const LogAxis y(areas);
  const Mark size = plot_size();
  constexpr std::size_t other_key_entries = 1;  // the front
  std::string text = plot_head(scene + ": area and boxes a second", lines.size() + other_key_entries);
  text += fmt::format(
      "set logscale xy\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nset xtics ({})\nset ytics "
      "({})\n"
      "set xlabel 'boxes a second of a full unit, millions'\nset ylabel {}\n",
      x.least(), x.most(), y.least(), y.most(), x.tics(), y.tics(),
      gnuplot_string(on_chip ? "lookup tables of the unit" : "area of the unit, mm²"));
  std::vector<CostAndError> all;
  std::vector<UnitMark> marks;
  std::string plot = "plot $front using 1:2 with steps lc rgb '#888888' lw 1.5 dt 2 title 'Pareto front'";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string points;
    for (const sim::SweepRow& row : lines[i].rows) {
      all.push_back({row.box_time_ns(), area(row)});
      points += fmt::format("{:.6g} {:.6g}\n", rate(row), area(row));
      marks.push_back({row.design,
                       fmt::format("{}", row.interval),
                       {x.share(rate(row)) * size.x, y.share(area(row)) * size.y}});
    }
    const sim::SweepRow& first = lines[i].rows.front();
    const DesignStyle style = style_of(first.design);
    text += data_block(fmt::format("unit{}", i), points);
    plot += fmt::format(", $unit{} using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 title {}", i,
                        style.colour, style.shape, style.size,
                        gnuplot_string(rtl::find_design(first.design).name_at(lines[i].format)));
  }
  std::string front;
  for (const CostAndError& at : pareto_front(all))
    front += fmt::format("{:.6g} {:.6g}\n", 1000 / at.cost, at.error);
  return text + mark_labels(marks, size) + data_block("front", front) + plot + "\n";
}

std::string occupancy_script(const std::string& scene, std::span<const sim::SweepRow> units) {
  const std::vector<OccupancyLine> lines = occupancy_lines(units);
  if (lines.empty()) return "";
  std::map<int, double> all_rays;
  for (const OccupancyLine& line : lines) all_rays.insert(line.by_rays.begin(), line.by_rays.end());
  std::vector<int> tics;
  for (const auto& [rays, occupancy] : all_rays) tics.push_back(rays);
  // Long names: one line of the key for each.
  std::string text = plot_head(scene + ": occupancy of the pipeline against rays in flight",
                               plot_key_columns * lines.size());
  text += fmt::format(
      "set key maxcols 1\nset logscale x 2\nset xrange [{}:{}]\nset yrange [0:101]\nset xtics ({})\n"
      "set xlabel 'rays in flight'\nset ylabel 'cycles that begin a test, %'\n",
      0.95 * tics.front(), 1.05 * tics.back(), fmt::join(tics, ","));
  std::string plot;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const DesignStyle style = style_of(lines[i].design);
    std::string points;
    for (const auto& [rays, occupancy] : lines[i].by_rays) points += fmt::format("{} {}\n", rays, occupancy);
    text += data_block(fmt::format("unit{}", i), points);
    plot +=
        fmt::format("{} $unit{} using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 dt {} title {}",
                    i == 0 ? "plot" : ",", i, style.colour, style.shape, style.size, i + 1,
                    gnuplot_string(fmt::format("{}", fmt::join(lines[i].names, ", "))));
  }
  return text + plot + "\n";
}

}  // namespace hitpipe::cli
