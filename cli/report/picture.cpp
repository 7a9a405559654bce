#include "cli/report/picture.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "host/process.hpp"

namespace hitpipe::cli {

namespace {

constexpr double mm_per_inch = 25.4;
constexpr double px_per_inch = 96;
constexpr double pt_per_inch = 72;
constexpr double paper_letters_pt = 8;

/// For a comment. gnuplot would read on after a line break, and after a backslash at the end.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\\') c = ' ';
  return text;
}

}  // namespace

PictureForm paper_form(double width_mm) {
  return {width_mm / mm_per_inch * px_per_inch, paper_letters_pt / pt_per_inch * px_per_inch};
}

std::string picture_script(const Picture& picture, const PictureForm& form) {
  const double height_px = picture.height * form.unit_px();
  const auto cm = [](double px) { return px / px_per_inch * mm_per_inch / 10; };
  // A point of pdfcairo's fonts is one of 96 to the inch, and its lines are thinner and closer than those of
  // SVG.
  return fmt::format(
      "# {0}\n# gnuplot {1}.gp writes {1}.svg and {1}.pdf.\nset encoding utf8\n{2}"
      "do for [kind in 'svg pdf'] {{\n"
      "if (kind eq 'svg') {{\n"
      "set terminal svg size {3:.0f},{4:.0f} font 'sans-serif,{5:.4g}' background 'white' noenhanced\n"
      "set key spacing 1\n"
      "}} else {{\n"
      "set terminal pdfcairo size {6:.4f}cm,{7:.4f}cm font 'sans-serif,{8:.4g}' fontscale 0.75 linewidth 1.5 "
      "noenhanced\nset key spacing 1.3\n}}\n"
      "set output '{1}.'.kind\n{9}set output\n}}\n",
      one_line(picture.title), picture.name, picture.settings, form.width_px, height_px, form.letters_px,
      cm(form.width_px), cm(height_px), form.letters_px / px_per_inch * pt_per_inch, picture.plots);
}

DrawnPicture draw_picture(const std::string& command, const Picture& picture, const PictureForm& form) {
  const host::ScratchFolder folder;
  DrawnPicture drawn{.name = picture.name,
                     .title = picture.title,
                     .script = picture_script(picture, form),
                     .svg = {},
                     .pdf = {},
                     .width_px = form.width_px,
                     .unnamed = picture.unnamed};
  host::write_files(folder.path(), {{picture.name + ".gp", drawn.script}});
  const host::Outcome plotted = host::run({"gnuplot", picture.name + ".gp"},
                                          {.folder = folder.path(), .time_limit = host::answering_time});
  drawn.svg = host::contents_of(folder / (picture.name + ".svg")).value_or("");
  drawn.pdf = host::contents_of(folder / (picture.name + ".pdf")).value_or("");
  if (!plotted.succeeded() || drawn.svg.empty() || drawn.pdf.empty()) {
    throw std::runtime_error(fmt::format("{}: gnuplot {}{}", command, plotted.failure(),
                                         plotted.not_found() ? "; install the package gnuplot-nox" : ""));
  }
  return drawn;
}

std::vector<host::File> picture_files(const DrawnPicture& drawn) {
  return {
      {drawn.name + ".svg", drawn.svg}, {drawn.name + ".pdf", drawn.pdf}, {drawn.name + ".gp", drawn.script}};
}

}  // namespace hitpipe::cli
