#include "cli/report/occupancy_plot.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/plot.hpp"
#include "cli/report/sweep_rows.hpp"
#include "cli/report/unit_marks.hpp"

namespace hitpipe::cli {

namespace {

/// Units of the thesis whose occupancies are so close that their lines nearly lie on one another.
struct OccupancyLines {
  struct Unit {
    std::string name;
    std::map<int, double> by_rays;
  };
  std::string design;  ///< of the first
  std::vector<Unit> units;

  [[nodiscard]] bool are_like(const Unit& other) const {
    const std::map<int, double>& first = units.front().by_rays;
    return std::equal(first.begin(), first.end(), other.by_rays.begin(), other.by_rays.end(),
                      [](const auto& a, const auto& b) {
                        return a.first == b.first && std::abs(a.second - b.second) < 1.0;
                      });
  }
};

std::vector<OccupancyLines> occupancy_lines(std::span<const sim::SweepRow> rows) {
  std::vector<OccupancyLines> of_units;
  for (const sim::SweepRow& row : rows) {
    if (!is_thesis_unit(row)) continue;
    const std::string name = unit_name(row);
    auto line = std::find_if(of_units.begin(), of_units.end(),
                             [&](const OccupancyLines& each) { return each.units.front().name == name; });
    if (line == of_units.end()) line = of_units.insert(of_units.end(), {row.design, {{name, {}}}});
    line->units.front().by_rays[row.rays_in_flight] = row.occupancy_pct();
  }
  std::vector<OccupancyLines> lines;
  for (const OccupancyLines& unit : of_units) {
    if (unit.units.front().by_rays.size() < 2) continue;
    const auto like = std::find_if(lines.begin(), lines.end(), [&](const OccupancyLines& line) {
      return line.are_like(unit.units.front());
    });
    if (like == lines.end()) {
      lines.push_back(unit);
    } else {
      like->units.push_back(unit.units.front());
    }
  }
  return lines;
}

}  // namespace

std::optional<Picture> occupancy_picture(const std::string& scene, std::span<const sim::SweepRow> units,
                                         const PictureForm& form) {
  const std::vector<OccupancyLines> lines = occupancy_lines(units);
  if (lines.empty()) return {};
  std::map<int, double> all_rays;
  std::vector<std::string> keys;
  for (const OccupancyLines& line : lines) {
    for (const OccupancyLines::Unit& unit : line.units) {
      all_rays.insert(unit.by_rays.begin(), unit.by_rays.end());
      keys.push_back(unit.name);
    }
  }
  std::vector<int> tics;
  for (const auto& [rays, occupancy] : all_rays) tics.push_back(rays);
  const PlotFrame frame = plot_frame(form, "rays in flight", "cycles that begin a test, %", keys);
  std::string settings =
      frame.settings +
      fmt::format("set logscale x 2\nset xrange [{}:{}]\nset yrange [0:101]\nset xtics ({})\n",
                  0.95 * tics.front(), 1.05 * tics.back(), fmt::join(tics, ","));
  std::string plots;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const DesignStyle style = style_of(lines[i].design);
    for (std::size_t u = 0; u < lines[i].units.size(); ++u) {
      const auto& [name, by_rays] = lines[i].units[u];
      const std::string block = fmt::format("unit{}_{}", i, u);
      std::string points;
      for (const auto& [rays, occupancy] : by_rays) points += fmt::format("{} {}\n", rays, occupancy);
      settings += data_block(block, points);
      plots +=
          fmt::format("{} ${} using 1:2 with linespoints lc rgb '{}' pt {} ps {:g} lw 1.5 dt {} title {}",
                      plots.empty() ? "plot" : ",", block, style.colour, style.shape, style.size, i + 1,
                      gnuplot_string(name));
    }
  }
  return Picture{"occupancy", scene + ": occupancy of the pipeline against rays in flight",
                 frame.picture_height, settings, plots + "\n"};
}

}  // namespace hitpipe::cli
