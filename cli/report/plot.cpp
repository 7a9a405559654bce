#include "cli/report/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace hitpipe::cli {

namespace {

constexpr std::array design_colours{"#0072B2", "#D55E00", "#806000", "#000000", "#00664B", "#CC79A7",
                                    "#56B4E9", "#8C6D31", "#444444", "#7A1F5C", "#004C77", "#8F3F00"};
constexpr std::array design_shapes{7, 5, 8, 13, 10, 9, 11, 15, 4, 6, 12, 14};

constexpr double tic_texts_height = 36;
constexpr double right_of_plot = 15;
constexpr double above_plot = 12;
constexpr double above_key = 12;
constexpr double key_line_height = 18;
constexpr double key_letter_width = 7.4;  // as gnuplot counts, which has no fonts for SVG
constexpr double key_sample_width = 44;
constexpr std::size_t most_key_columns = 3;

/// Wide plots are flat, narrow ones have room for labels above one another.
double plot_height(double width) {
  return 200 + 0.3 * width;
}

}  // namespace

std::string gnuplot_string(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("''") : std::string(1, c);
  return word + "'";
}

std::vector<std::string> lines_within(std::string_view text, double width) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word(text.substr(at, end - at));
    if (!lines.empty() && text_width(lines.back() + " " + word) <= width) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
    at = end + 1;
  }
  return lines;
}

std::string gnuplot_string(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : ".\"\\n\".") + gnuplot_string(line);
  return text;
}

std::string data_block(const std::string& name, const std::string& lines) {
  return fmt::format("${} << END\n{}END\n", name, lines);
}

DesignStyle design_style(std::size_t place) {
  const std::size_t turn = place / design_shapes.size();
  const std::size_t larger = turn / design_shapes.size();
  return {design_colours[place % design_colours.size()], design_shapes[(place + turn) % design_shapes.size()],
          0.9 + 0.3 * static_cast<double>(larger)};
}

KeyRoom key_room(double width, std::span<const std::string> titles) {
  std::size_t longest = 0;
  for (const std::string& title : titles) longest = std::max(longest, title.size());
  const double column = static_cast<double>(longest) * key_letter_width + key_sample_width;
  const auto columns = std::clamp(static_cast<std::size_t>(width / column), std::size_t{1}, most_key_columns);
  const std::size_t lines = (titles.size() + columns - 1) / columns;
  return {columns, static_cast<double>(lines) * key_line_height};
}

std::string key_settings(const KeyRoom& key) {
  return fmt::format(
      "set key at screen 0.5,0.005 center bottom horizontal Left reverse samplen 1.5 width 1 maxcols {}\n",
      key.columns);
}

PlotFrame plot_frame(const PictureForm& form, const std::string& x_label, const std::string& y_label,
                     std::span<const std::string> key_titles) {
  PlotFrame frame{{form.width() - right_of_plot - tic_texts_width - line_height, 0}, 0, {}};
  const std::vector<std::string> up = lines_within(y_label, plot_height(frame.size.x));
  frame.size.x -= line_height * static_cast<double>(up.size() - 1);
  frame.size.y = plot_height(frame.size.x);
  const std::vector<std::string> across = lines_within(x_label, frame.size.x);
  const KeyRoom key = key_room(frame.size.x, key_titles);
  const double below =
      tic_texts_height + line_height * static_cast<double>(across.size()) + above_key + key.height;
  frame.picture_height = above_plot + frame.size.y + below;
  // gnuplot would place the label by the texts at the tics, partly outside of the picture.
  frame.settings = fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n"
      "set tmargin at screen {:.4f}\nset grid lc rgb '#dddddd'\nset xlabel {}\n"
      "set label {} at screen {:.4f},{:.4f} center rotate\n"
      "set style textbox opaque margins 0.2,0.2 fc rgb 'white' noborder\n{}",
      1 - (right_of_plot + frame.size.x) / form.width(), 1 - right_of_plot / form.width(),
      below / frame.picture_height, 1 - above_plot / frame.picture_height, gnuplot_string(across),
      gnuplot_string(up), line_height / form.width(), (below + frame.size.y / 2) / frame.picture_height,
      key_settings(key));
  return frame;
}

std::string axes_settings(const LogAxis& x, const LogAxis& y, const Mark& size) {
  return fmt::format(
      "set logscale xy\nset xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nset xtics ({})\nset ytics "
      "({})\n",
      x.least(), x.most(), y.least(), y.most(), x.tics_across(size.x), y.tics_upward(size.y));
}

}  // namespace hitpipe::cli
