// How the files of a picture are written: NAME.gp, a program of gnuplot with its data inside, and what it
// draws, NAME.svg and NAME.pdf. A picture has no title, because the page or the paper that shows it has a
// caption.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/files.hpp"

namespace hitpipe::cli {

/// How wide pictures are and how large their letters. Pictures are laid out in units of a twelfth of a
/// letter's size, so a narrow picture differs from a wide one by its room alone.
struct PictureForm {
  double width_px;  ///< 96 to the inch
  double letters_px;

  [[nodiscard]] double unit_px() const { return letters_px / 12; }
  [[nodiscard]] double width() const { return width_px / unit_px(); }
};
/// As wide as a report.
inline constexpr PictureForm report_form{1000, 12};
/// As wide as a page of a repository.
inline constexpr PictureForm page_form{800, 12};
/// With letters of 8 pt.
[[nodiscard]] PictureForm paper_form(double width_mm);

struct Picture {
  std::string name;
  std::string title;        ///< in words; a comment of the program
  double height;            ///< in units
  std::string settings;     ///< data and settings; a plot without a key has no titles
  std::string plots;        ///< the plot commands
  std::size_t unnamed = 0;  ///< marks whose names had no room
};

/// It is the same text for the same numbers.
[[nodiscard]] std::string picture_script(const Picture& picture, const PictureForm& form);

struct DrawnPicture {
  std::string name, title, script, svg, pdf;
  double width_px = 0;
  std::size_t unnamed = 0;
};
/// Throws std::runtime_error, one line that begins with `command`, when gnuplot is missing or fails.
[[nodiscard]] DrawnPicture draw_picture(const std::string& command, const Picture& picture,
                                        const PictureForm& form);

/// NAME.svg, NAME.pdf and NAME.gp.
[[nodiscard]] std::vector<host::File> picture_files(const DrawnPicture& drawn);

}  // namespace hitpipe::cli
