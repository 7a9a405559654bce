#include "cli/report/stiffness_plot.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "cli/report/plot.hpp"

namespace hitpipe::cli {

namespace {

constexpr int panel_width = 400;
constexpr int panel_height = 400;

struct LineStyle {
  const char* colour;
  int mark;
};
constexpr std::array<LineStyle, 8> line_styles{{{"#0072B2", 7},
                                                {"#D55E00", 5},
                                                {"#009E73", 9},
                                                {"#CC79A7", 13},
                                                {"#E69F00", 4},
                                                {"#56B4E9", 6},
                                                {"#000000", 8},
                                                {"#999999", 12}}};

/// One data block: x, and a column for each line.
std::string data_block(const Plot& plot, const PlotPanel& panel, std::size_t number, int zero_at) {
  std::string text = fmt::format("$panel{} << END\n", number);
  for (std::size_t i = 0; i <= plot.exponents.size(); ++i) {
    text += fmt::format("{}", i < plot.exponents.size() ? plot.exponents[i] : zero_at);
    for (const PlotLine& line : panel.lines)
      text += fmt::format(" {}", std::max(line.percent[i], plot.least));
    text += '\n';
  }
  return text + "END\n";
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

}  // namespace

std::string plot_script(const Plot& plot) {
  const int last = plot.exponents.back();
  const int zero_at = last + 8;  // zero is not a power of two, so it stands apart
  std::string tics;
  for (int x = 0; x <= last; x += 10) tics += fmt::format("'2^{{{}}}' {}, ", x, x);
  std::string text = fmt::format(
      "set terminal svg size {},{} font 'sans-serif,13' background 'white'\n"
      "set encoding utf8\nset multiplot layout 1,{} title {} noenhanced\n"
      "set grid ytics lc rgb '#dddddd'\nset logscale y\nset yrange [{}:{}]\n"
      "set xrange [-1:{}]\nset xtics ({}'zero' {})\nset key below samplen 1 width -0.5 height 0.5\n"
      "set format y '%g'\nset ytics add ('≤{}' {})\nset xlabel 'ratio of direction components'\nset ylabel "
      "{}\n",
      panel_width * plot.panels.size(), panel_height, plot.panels.size(), gnuplot_string(plot.title),
      plot.least, 1.2 * most_percent(plot), zero_at + 2, tics, zero_at, plot.least, plot.least,
      gnuplot_string(plot.counted + ", %"));
  for (std::size_t p = 0; p < plot.panels.size(); ++p) {
    const PlotPanel& panel = plot.panels[p];
    text += data_block(plot, panel, p, zero_at);
    text += fmt::format("set title {} noenhanced\nplot", gnuplot_string(panel.title));
    for (std::size_t l = 0; l < panel.lines.size(); ++l) {
      const LineStyle& style = line_styles[l % line_styles.size()];
      // The last point is for a component of zero and stands alone.
      text += fmt::format(
          "{0} $panel{1} using 1:{2} every ::0::{3} with linespoints lc rgb '{4}' pt {5} ps 0.6 "
          "lw 1.5 title {6}, $panel{1} using 1:{2} every ::{7} with points lc rgb '{4}' pt "
          "{5} ps 0.9 notitle",
          l == 0 ? "" : ",", p, l + 2, plot.exponents.size() - 1, style.colour, style.mark,
          gnuplot_string(panel.lines[l].title), plot.exponents.size());
    }
    text += '\n';
  }
  return text + "unset multiplot\n";
}

std::string draw_plot(const Plot& plot) {
  return run_gnuplot("stiffness", plot_script(plot));
}

}  // namespace hitpipe::cli
