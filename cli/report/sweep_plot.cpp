#include "cli/report/sweep_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "cli/report/gnuplot.hpp"
#include "cli/report/label_places.hpp"
#include "cli/report/sweep_rows.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

constexpr int picture_width = 760;
// Edges of the plot as fractions of the picture's width.
constexpr double left = 0.13;
constexpr double right = 0.975;
// In pixels. The picture grows with its key, and the plot keeps its size.
constexpr int plot_height = 414;
constexpr int above_plot = 45;
constexpr int axis_height = 73;  // numbers and text below the plot
constexpr int key_line_height = 23;
constexpr int least_key_lines = 3;
constexpr double error_least_pct = error_floor_pct / 2;  // leaves room for marks at the lowest error
constexpr double error_most_pct = 1e3;

struct Style {
  const char* colour;
  int mark;       ///< number of gnuplot's filled mark
  int open_mark;  ///< the same, hollow
  double size;    ///< marks of two units often coincide; the smaller lies on the larger
};
/// Styles by the design's place in the catalogue. They repeat when there are more designs.
constexpr std::array<Style, 8> styles{{{"#0072B2", 7, 6, 1.8},
                                       {"#D55E00", 5, 4, 1.8},
                                       {"#E69F00", 9, 8, 1.1},
                                       {"#000000", 13, 12, 1.1},
                                       {"#009E73", 11, 10, 1.5},
                                       {"#CC79A7", 15, 14, 1.4},
                                       {"#56B4E9", 7, 6, 1.5},
                                       {"#8C6D31", 5, 4, 1.2}}};

const Style& style_of(const std::string& design) {
  return styles[rtl::place_of(rtl::find_design(design)) % styles.size()];
}

constexpr std::array<CostAxis, 3> axes{
    {{"run_time", "run time, ns for each box test of the reference (cycles × stage delay)", 1, 64},
     {"area", "area, mm² for each box tested in a cycle", 0.05, 10},
     {"area_run_time", "area × run time, mm² ns for each box test of the reference", 0.2, 100}}};

double cost_of(const sim::SweepRow& unit, Cost cost) {
  switch (cost) {
    case Cost::run_time:
      return run_time_ns(unit);
    case Cost::area:
      return unit.area_per_box_mm2();
    case Cost::area_run_time:
      break;
  }
  // The whole area: a pair needs fewer cycles already.
  return static_cast<double>(unit.area_um2) / 1e6 * run_time_ns(unit);
}

/// The point at which a diagram shows a unit.
CostAndError shown(const sim::SweepRow& unit, Cost cost) {
  const CostAxis& axis = axis_of(cost);
  return {std::clamp(cost_of(unit, cost), axis.least, axis.most),
          std::clamp(extra_box_tests_pct(unit), error_floor_pct, error_most_pct)};
}

/// The position of a value on a logarithmic axis, as a fraction of its length.
double share(double value, double least, double most) {
  return std::log(value / least) / std::log(most / least);
}

std::vector<std::string> designs_of(std::span<const sim::SweepRow> units) {
  std::vector<std::string> names;
  for (const sim::SweepRow& unit : units) {
    if (std::find(names.begin(), names.end(), unit.design) == names.end()) names.push_back(unit.design);
  }
  return names;
}

/// The key has two columns.
std::string head(const std::string& title, std::size_t key_entries) {
  const int key_lines = std::max(least_key_lines, (static_cast<int>(key_entries) + 1) / 2);
  const int below_plot = axis_height + key_lines * key_line_height;
  const int height = above_plot + plot_height + below_plot;
  const double bottom = static_cast<double>(below_plot) / height;
  const double top = static_cast<double>(below_plot + plot_height) / height;
  return fmt::format(
      "set terminal svg size {},{} font 'sans-serif,15' background 'white' noenhanced\n"
      "set encoding utf8\nset title {}\nset lmargin at screen {}\nset rmargin at screen {}\n"
      "set bmargin at screen {}\nset tmargin at screen {}\nset grid lc rgb '#dddddd'\n"
      "set key at screen 0.5,0.005 center bottom horizontal Left reverse samplen 1.5 width 1\n",
      picture_width, height, gnuplot_string(title), left, right, bottom, top);
}

std::string block(const std::string& name, const std::string& lines) {
  return fmt::format("${} << END\n{}END\n", name, lines);
}

/// Labels beside the thesis's units. A line leads to each label that had to move away.
std::string labels(std::span<const sim::SweepRow> units, Cost cost) {
  const CostAxis& axis = axis_of(cost);
  const double width = picture_width * (right - left);
  const double height = plot_height;
  std::vector<Mark> marks;
  std::vector<std::string> texts;
  std::vector<sim::SweepRow> from_left(units.begin(), units.end());
  std::stable_sort(from_left.begin(), from_left.end(), [&](const sim::SweepRow& a, const sim::SweepRow& b) {
    return std::pair(!is_thesis_unit(a), shown(a, cost).cost) <
           std::pair(!is_thesis_unit(b), shown(b, cost).cost);
  });
  for (const sim::SweepRow& unit : from_left) {
    const CostAndError at = shown(unit, cost);
    marks.push_back({share(at.cost, axis.least, axis.most) * width,
                     share(at.error, error_least_pct, error_most_pct) * height});
    if (is_thesis_unit(unit)) texts.push_back(unit_name(unit));
  }
  const std::vector<LabelPlace> places = place_labels(marks, texts, {width, height});
  std::string text;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const LabelPlace& p = places[i];
    text += fmt::format("set label {} at graph {:.4f},{:.4f} left front\n", gnuplot_string(texts[i]),
                        p.left / width, p.middle / height);
    if (p.line) {
      text +=
          fmt::format("set arrow from graph {:.4f},{:.4f} to graph {:.4f},{:.4f} nohead lc rgb '#666666'\n",
                      marks[i].x / width, marks[i].y / height, p.line_x / width, p.middle / height);
    }
  }
  return text;
}

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

const CostAxis& axis_of(Cost cost) {
  return axes[static_cast<std::size_t>(cost)];
}

std::string work_precision_script(const std::string& scene, std::span<const sim::SweepRow> units, Cost cost) {
  const CostAxis& axis = axis_of(cost);
  std::vector<CostAndError> all;
  for (const sim::SweepRow& unit : units) all.push_back(shown(unit, cost));
  std::string front;
  for (const CostAndError& at : pareto_front(all)) front += fmt::format("{} {}\n", at.cost, at.error);

  const std::vector<std::string> designs = designs_of(units);
  constexpr std::size_t other_key_entries = 2;  // the front, and what is hollow
  std::string text = head(fmt::format("{}: extra box tests against {}", scene,
                                      cost == Cost::run_time ? "run time"
                                      : cost == Cost::area   ? "area for each box"
                                                             : "area × run time"),
                          designs.size() + other_key_entries);
  text += fmt::format("set logscale xy\nset xrange [{}:{}]\nset yrange [{}:{}]\nset format x '%g'\n",
                      axis.least, axis.most, error_least_pct, error_most_pct);
  text +=
      fmt::format("set xlabel {}\nset ylabel 'extra box tests, %' offset 3,0\n", gnuplot_string(axis.label));
  text +=
      "set ytics ('≤0.0001' 1e-4, '0.001' 1e-3, '0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100, '1000' "
      "1000)\n";
  if (cost == Cost::run_time) text += "set xtics (1, 2, 4, 8, 16, 32, 64)\n";
  text += labels(units, cost) + block("front", front);
  std::string plot = "plot $front using 1:2 with steps lc rgb '#888888' lw 2 dt 2 title 'Pareto front'";
  std::size_t number = 0;
  for (const std::string& design : designs) {
    const Style& style = style_of(design);
    std::string points;
    std::string thesis;
    for (const sim::SweepRow& unit : units) {
      if (unit.design != design) continue;
      const CostAndError at = shown(unit, cost);
      (is_thesis_unit(unit) ? thesis : points) += fmt::format("{} {}\n", at.cost, at.error);
    }
    for (const bool of_thesis : {false, true}) {
      const std::string& lines = of_thesis ? thesis : points;
      if (lines.empty()) continue;
      const std::string name = fmt::format("units{}", number++);
      text += block(name, lines);
      plot += fmt::format(", ${} using 1:2 with points lc rgb '{}' pt {} ps {} lw 1.5 notitle", name,
                          style.colour, of_thesis ? style.mark : style.open_mark,
                          of_thesis ? style.size : 0.7 * style.size);
    }
    plot += fmt::format(", keyentry with points lc rgb '{}' pt {} ps {} title {}", style.colour, style.mark,
                        style.size, gnuplot_string(design));
  }
  plot += ", keyentry with points lc rgb '#666666' pt 6 ps 1.3 title 'hollow: not of Table 7.2'";
  return text + plot + "\n";
}

std::string occupancy_script(const std::string& scene, std::span<const sim::SweepRow> units) {
  std::map<std::string, std::map<int, double>> by_unit;
  std::vector<std::pair<std::string, std::string>> order;  // name and design
  for (const sim::SweepRow& unit : units) {
    if (!is_thesis_unit(unit)) continue;
    const std::string name = unit_name(unit);
    if (!by_unit.contains(name)) order.emplace_back(name, unit.design);
    by_unit[name][unit.rays_in_flight] = unit.occupancy_pct();
  }
  std::string text = head(scene + ": occupancy of the pipeline against rays in flight", order.size());
  text +=
      "set logscale x 2\nset xrange [0.9:290]\nset yrange [0:105]\nset xtics (1, 2, 4, 8, 16, 32, 64, 128, "
      "256)\n"
      "set xlabel 'rays in flight'\nset ylabel 'cycles that begin a test, %'\n";
  std::string plot;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& [name, design] = order[i];
    const Style& style = style_of(design);
    const bool first = seen.insert(design).second;  // the second format of a design: hollow and dashed
    std::string lines;
    for (const auto& [rays, occupancy] : by_unit[name]) lines += fmt::format("{} {}\n", rays, occupancy);
    text += block(fmt::format("unit{}", i), lines);
    plot += fmt::format("{} $unit{} using 1:2 with linespoints lc rgb '{}' pt {} ps {} lw {} dt {} title {}",
                        i == 0 ? "plot" : ",", i, style.colour, first ? style.mark : style.open_mark,
                        style.size, 1.6 * style.size, first ? 1 : 2, gnuplot_string(name));
  }
  return text + plot + "\n";
}

}  // namespace hitpipe::cli
