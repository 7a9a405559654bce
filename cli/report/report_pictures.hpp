// The pictures of a report: the scene by software in floats and through a design's Verilog, heat maps of box
// tests, and heat maps of the design's extra box tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options/design_options.hpp"
#include "cli/report/report_page.hpp"
#include "cli/text/table.hpp"
#include "rtl_gen/emit/files.hpp"
#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/render/whitted.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::cli {

struct PictureChoice {
  const rtl::Design* design;  ///< its Verilog renders
  rtl::Format format;
  rtl::Format coarse;  ///< for a second map of extra work
  const rtl::Library* library;
  std::string library_option;  ///< " --library xc7", or nothing for the default; for the commands
  std::string scene_options;   ///< as a user writes them; for the commands
  int width = 256;
  int height = 256;
  int threads = 1;
  ref::WhittedOptions light;
  std::function<void(double)> progress = [](double) {};
};

struct ReportPictures {
  std::vector<PagePicture> images;
  std::vector<PagePicture> maps;
  std::vector<std::string> not_drawn;  ///< maps that would be nearly all of one colour, with their numbers
  std::vector<rtl::File> files;        ///< the PNG files that the page embeds
  std::vector<Row> rows;               ///< one for each picture: its numbers and its command
  std::uint64_t different_pixels = 0;
  std::uint64_t different_triangles = 0;
  std::uint64_t rtl_mismatches = 0;
};

/// Throws what sim::cosimulate() and ref::render() throw.
[[nodiscard]] ReportPictures make_pictures(const ref::Scene& scene, const ref::Bvh& bvh,
                                           const PictureChoice& choice);

}  // namespace hitpipe::cli
