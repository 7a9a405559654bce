// What the plots of hitpipe share: how gnuplot takes texts and data, where axes and key are, and marks'
// styles. Lengths are in units of PictureForm.
#pragma once

#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report/label_places.hpp"
#include "cli/report/log_axis.hpp"
#include "cli/report/picture.hpp"

namespace hitpipe::cli {

/// A gnuplot string that gnuplot takes literally.
[[nodiscard]] std::string gnuplot_string(const std::string& text);

/// The text in lines of at most this width, as far as blanks allow, and gnuplot's string of lines.
[[nodiscard]] std::vector<std::string> lines_within(std::string_view text, double width);
[[nodiscard]] std::string gnuplot_string(const std::vector<std::string>& lines);

/// A block of data with a name.
[[nodiscard]] std::string data_block(const std::string& name, const std::string& lines);

struct DesignStyle {
  std::string_view colour;
  int shape;  ///< gnuplot's number
  double size;

  friend auto operator<=>(const DesignStyle&, const DesignStyle&) = default;
};
/// The marks of the design at this place of the catalogue. No shape comes twice among the first twelve; the
/// next take other pairs of colour and shape, and when these are used up too, larger marks.
[[nodiscard]] DesignStyle design_style(std::size_t place);

/// The key of a picture is below it and has as many columns as have room in the width of a plot, up to three.
struct KeyRoom {
  std::size_t columns;
  double height;
};
[[nodiscard]] KeyRoom key_room(double width, std::span<const std::string> titles);
[[nodiscard]] std::string key_settings(const KeyRoom& key);

/// A large plot with a key: where it is and what surrounds it.
struct PlotFrame {
  Mark size;  ///< what marks lie in
  double picture_height;
  std::string settings;  ///< margins, labels of the axes, grid, key
};
[[nodiscard]] PlotFrame plot_frame(const PictureForm& form, const std::string& x_label,
                                   const std::string& y_label, std::span<const std::string> key_titles);
/// Of the texts at the tics of an upward axis.
inline constexpr double tic_texts_width = 64;
/// Both axes of a plot.
[[nodiscard]] std::string axes_settings(const LogAxis& x, const LogAxis& y, const Mark& size);

}  // namespace hitpipe::cli
