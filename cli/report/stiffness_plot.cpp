#include "cli/report/stiffness_plot.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/plot.hpp"

namespace hitpipe::cli {

namespace {

constexpr double right_of_panels = 12;
constexpr double between_columns = 14;
constexpr double name_height = 28;        // above each panel
constexpr double axis_height = 60;        // below the lowest panels
constexpr double ratio_label_below = 40;  // the panels
constexpr double between_texts = 6;
constexpr double below_least = 1.4;  // so that marks there do not lie on the border
constexpr double two_columns_from = 300;
constexpr double three_columns_from = 700;

/// Where panels are. Their room is counted from the upper left corner of the picture.
struct Grid {
  std::size_t columns = 1;
  double panel_width = 0;
  double panel_height = 0;
  double panels_height = 0;  ///< of all rows, with names
  double left_of_panels = 0;
  double width = 0;
  double height = 0;
  KeyRoom key{};
  std::vector<std::string> y_label;

  [[nodiscard]] double left(std::size_t panel) const {
    return left_of_panels + static_cast<double>(panel % columns) * (panel_width + between_columns);
  }
  [[nodiscard]] double top(std::size_t panel) const {
    const std::size_t row = panel / columns;
    return static_cast<double>(row) * (name_height + panel_height) + name_height;
  }
  [[nodiscard]] double screen_x(double x) const { return x / width; }
  [[nodiscard]] double screen_y(double y) const { return 1 - y / height; }
  [[nodiscard]] std::string margins(double from_x, double to_x, double from_y, double to_y) const {
    return fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
        "set bmargin at screen {:.4f}\n",
        screen_x(from_x), screen_x(to_x), screen_y(from_y), screen_y(to_y));
  }
};

Grid grid_of(const Plot& plot, const PictureForm& form, const std::vector<std::string>& keys) {
  Grid grid;
  grid.width = form.width();
  const std::size_t panels = plot.panels.size();
  const std::size_t most = grid.width >= three_columns_from && panels > 4 ? 3
                           : grid.width >= two_columns_from               ? 2
                                                                          : 1;
  grid.columns = std::min(most, panels);
  const auto columns = static_cast<double>(grid.columns);
  const std::size_t whole_rows = (panels + grid.columns - 1) / grid.columns;
  const auto rows = static_cast<double>(whole_rows);
  // A label of two lines takes width from the panels, and that height from the label; hardly ever more.
  for (int round = 0; round < 2; ++round) {
    const auto lines = static_cast<double>(std::max(std::size_t{1}, grid.y_label.size()));
    grid.left_of_panels = tic_texts_width + lines * line_height;
    grid.panel_width =
        (grid.width - grid.left_of_panels - right_of_panels - (columns - 1) * between_columns) / columns;
    grid.panel_height = 90 + 0.4 * grid.panel_width;
    grid.panels_height = rows * (name_height + grid.panel_height);
    grid.y_label = lines_within(plot.counted + ", %", grid.panels_height);
  }
  grid.key = key_room(grid.width, keys);
  grid.height = grid.panels_height + axis_height + grid.key.height;
  return grid;
}

/// One data block: x, and a column for each line.
std::string panel_data(const Plot& plot, const PlotPanel& panel, std::size_t number, int zero_at) {
  std::string text;
  for (std::size_t i = 0; i <= plot.exponents.size(); ++i) {
    text += fmt::format("{}", i < plot.exponents.size() ? plot.exponents[i] : zero_at);
    for (const PlotLine& line : panel.lines)
      text += fmt::format(" {}", std::max(line.percent[i], plot.least));
    text += '\n';
  }
  return data_block(fmt::format("panel{}", number), text);
}

double most_percent(const Plot& plot) {
  double most = 10 * plot.least;
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotLine& line : panel.lines) {
      most = std::max(most, *std::max_element(line.percent.begin(), line.percent.end()));
    }
  }
  return most;
}

/// Each format once; its place is its style.
std::vector<std::string> titles_of(const Plot& plot) {
  std::vector<std::string> titles;
  for (const PlotPanel& panel : plot.panels)
    for (const PlotLine& line : panel.lines)
      if (std::find(titles.begin(), titles.end(), line.title) == titles.end()) titles.push_back(line.title);
  return titles;
}

std::string power_of_two(int exponent) {
  constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "2";
  for (const char digit : std::to_string(exponent)) text += raised[static_cast<std::size_t>(digit - '0')];
  return text;
}

/// Ratios are as far apart as their texts need; zero is no power of two, so it stands apart.
struct RatioAxis {
  int step = 10;
  int zero_at = 0;
  int end = 0;

  RatioAxis(int last, double width) {
    constexpr int before = 1;
    constexpr int after = 3;
    zero_at = last + 8;
    const auto unit = [&] { return width / (zero_at + after + before); };
    const double zero_room = (text_width("zero") + text_width("200")) / 2 + between_texts;
    while ((zero_at - last) * unit() < zero_room) ++zero_at;
    if (10 * unit() < text_width("200") + between_texts) step = 20;
    end = zero_at + after;
  }

  [[nodiscard]] std::string tics(int last, bool named) const {
    std::vector<std::string> texts;
    for (int x = 0; x <= last; x += step)
      texts.push_back(fmt::format("'{}' {}", named ? power_of_two(x) : "", x));
    texts.push_back(fmt::format("'{}' {}", named ? "zero" : "", zero_at));
    return fmt::format("{}", fmt::join(texts, ", "));
  }
};

std::string percent_tics(double least, double most, bool named) {
  std::vector<std::string> texts;
  for (double y = least; y <= most * 1.001; y *= 10)
    texts.push_back(
        fmt::format("'{}' {:.4g}", !named ? "" : fmt::format("{}{:.4g}", y > least ? "" : "≤ ", y), y));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

Picture stiffness_picture(const Plot& plot, const PictureForm& form) {
  const std::vector<std::string> titles = titles_of(plot);
  const Grid grid = grid_of(plot, form, titles);
  const int last = plot.exponents.back();
  const RatioAxis ratios(last, grid.panel_width);
  const double most = 1.2 * most_percent(plot);
  std::string settings = fmt::format(
      "set grid ytics lc rgb '#dddddd'\nset logscale y\nset yrange [{:.4g}:{:.4g}]\nset xrange [-1:{}]\n",
      plot.least / below_least, most, ratios.end);
  // Labels of both axes, once for all panels.
  std::string plots = fmt::format(
      "set multiplot\nunset key\nset label 1 {} at screen {:.4f},{:.4f} center rotate\n"
      "set label 2 'ratio of direction components' at screen {:.4f},{:.4f} center\n",
      gnuplot_string(grid.y_label), grid.screen_x(line_height), grid.screen_y(grid.panels_height / 2),
      grid.screen_x((grid.left_of_panels + grid.width - right_of_panels) / 2),
      grid.screen_y(grid.panels_height + ratio_label_below));
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const PlotPanel& panel = plot.panels[p];
    settings += panel_data(plot, panel, p, ratios.zero_at);
    const bool lowest = p + grid.columns >= plot.panels.size();
    plots += grid.margins(grid.left(p), grid.left(p) + grid.panel_width, grid.top(p),
                          grid.top(p) + grid.panel_height);
    plots += fmt::format("set xtics ({})\nset ytics ({})\nset label 3 {} at screen {:.4f},{:.4f} center\n",
                         ratios.tics(last, lowest), percent_tics(plot.least, most, p % grid.columns == 0),
                         gnuplot_string(panel.title), grid.screen_x(grid.left(p) + grid.panel_width / 2),
                         grid.screen_y(grid.top(p) - 10));
    std::string drawn;
    for (std::size_t l = 0; l < panel.lines.size(); ++l) {
      const auto title = std::find(titles.begin(), titles.end(), panel.lines[l].title);
      const DesignStyle style = design_style(static_cast<std::size_t>(title - titles.begin()));
      // The last point is for a component of zero and stands alone.
      drawn += fmt::format(
          "{0} $panel{1} using 1:{2} every ::0::{3} with linespoints lc rgb '{4}' pt {5} ps 0.6 "
          "lw 1.5 notitle, $panel{1} using 1:{2} every ::{6} with points lc rgb '{4}' pt {5} ps 0.9 notitle",
          drawn.empty() ? "plot" : ",", p, l + 2, plot.exponents.size() - 1, style.colour, style.shape,
          plot.exponents.size());
    }
    plots += drawn + "\nunset label\n";
  }
  // gnuplot gives a key no more width than its plot has, so an empty plot below the panels has it.
  plots += grid.margins(0, grid.width, grid.height - 2, grid.height - 1) + "unset border\nunset tics\n" +
           key_settings(grid.key) + "plot NaN notitle";
  for (std::size_t t = 0; t < titles.size(); ++t) {
    const DesignStyle style = design_style(t);
    plots += fmt::format(", keyentry with linespoints lc rgb '{}' pt {} ps 0.6 lw 1.5 title {}", style.colour,
                         style.shape, gnuplot_string(titles[t]));
  }
  // As it was, for the next kind of file.
  plots += "\nset border\nset tics\nunset multiplot\n";
  return {plot.name, plot.title, grid.height, settings, plots};
}

}  // namespace hitpipe::cli
