#include "cli/report/report_pictures.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/options/trace_options.hpp"
#include "host/files.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/generic_tracer.hpp"
#include "sim/software.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// The bytes of the PNG file that `write` makes when it is given a file name.
template <class Write>
std::string png_of(const Write& write) {
  const host::ScratchFolder folder;
  write(folder / "picture.png");
  return host::read_file(folder / "picture.png");
}

class Studio {
 public:
  Studio(const ref::Scene& scene, const PictureChoice& choice, ReportPictures& made)
      : scene_(scene), choice_(choice), made_(made) {}

  [[nodiscard]] ref::RenderResult render(const ref::Tracer& tracer) const {
    return ref::render(scene_, tracer,
                       {.width = choice_.width,
                        .height = choice_.height,
                        .threads = choice_.threads,
                        .light = choice_.light,
                        .maps = true});
  }

  void image(const std::string& name, const std::vector<glm::vec3>& pixels, const std::string& caption,
             const std::string& alternative, Row row) const {
    keep(name,
         png_of([&](const fs::path& file) { ref::write_image(file, choice_.width, choice_.height, pixels); }),
         {.caption = caption, .alternative = alternative, .png = {}, .scale = {}}, std::move(row),
         made_.images);
  }

  /// From zero to the largest value.
  void map(const std::string& name, const std::vector<float>& values, const std::string& caption,
           const std::string& alternative, Row row) const {
    const ref::MapScale scale{0.0F, ref::scale_of(values).high};
    row["map_high"] = scale.high;
    keep(name, png_of([&](const fs::path& file) {
           ref::write_map(file, choice_.width, choice_.height, values, scale);
         }),
         {.caption = caption,
          .alternative = alternative,
          .png = {},
          .scale = {{"0", fmt::format("{:g}", scale.high)}}},
         std::move(row), made_.maps);
  }

 private:
  void keep(const std::string& name, std::string png, PagePicture picture, Row row,
            std::vector<PagePicture>& among) const {
    row["file"] = name + ".png";
    made_.files.push_back({name + ".png", png});
    made_.rows.push_back(std::move(row));
    picture.png = std::move(png);
    picture.width = choice_.width;
    picture.height = choice_.height;
    among.push_back(std::move(picture));
  }

  const ref::Scene& scene_;
  const PictureChoice& choice_;
  ReportPictures& made_;
};

/// A map is drawn if one pixel in so many is above zero.
constexpr std::size_t shown_from = 10;

std::size_t pixels_with_more(const std::vector<float>& extra) {
  return static_cast<std::size_t>(
      std::count_if(extra.begin(), extra.end(), [](float value) { return value > 0; }));
}

Row row_of(const std::string& unit, std::uint64_t box_tests, std::uint64_t triangle_tests,
           const std::string& command) {
  return {{"file", ""},
          {"unit", unit},
          {"box_tests", box_tests},
          {"triangle_tests", triangle_tests},
          {"map_high", nullptr},
          {"command", command}};
}

}  // namespace

ReportPictures make_pictures(const ref::Scene& scene, const ref::Bvh& bvh, const PictureChoice& choice) {
  ReportPictures made;
  const Studio studio(scene, choice, made);
  const std::string render = "hitpipe render " + choice.scene_options;

  const ref::RenderResult software = studio.render(*ref::make_tracer(scene.mesh, bvh, {}));
  const ref::TraceCounts reference = software.counts.total();
  studio.image("software", software.image, "Software: conservative float slabs.",
               fmt::format("The scene {} rendered by software", scene.name),
               row_of("software", reference.box_tests, reference.triangle_tests, render + " --out FILE.png"));

  const std::string unit = choice.design->name_at(choice.format);
  const sim::VerilatedDesign verilated(rtl::make_unit(*choice.design, choice.format, *choice.library));
  const sim::CosimResult rtl = sim::cosimulate(verilated, scene, bvh,
                                               {.width = choice.width,
                                                .height = choice.height,
                                                .threads = choice.threads,
                                                .light = choice.light,
                                                .progress = choice.progress});
  for (std::size_t i = 0; i < rtl.image.size(); ++i)
    made.different_pixels += rtl.image[i] == software.image[i] ? 0 : 1;
  made.different_triangles = rtl.different_triangles;
  made.rtl_mismatches = rtl.unit.rtl_mismatches;
  studio.image("rtl", rtl.image,
               fmt::format("RTL: each of {} box tests answered by the Verilog of {}. Pixels that differ from "
                           "the software's: {}.",
                           readable_number(std::to_string(rtl.unit.box_tests)), unit, made.different_pixels),
               fmt::format("The scene {} rendered through the Verilog of {}", scene.name, unit),
               row_of(unit, rtl.unit.box_tests, rtl.unit.triangle_tests,
                      fmt::format("hitpipe cosim {}{}{} {} --out FOLDER", choice.design->name,
                                  choice.design->bits_option(choice.format), choice.library_option,
                                  choice.scene_options)));

  studio.map(
      "box_tests", software.box_tests, "Box tests of all rays of a pixel, conservative float slabs.",
      "Heat map of the box tests of each pixel",
      row_of("software", reference.box_tests, reference.triangle_tests, render + " --box-map FILE.png"));
  std::vector<rtl::Format> formats{choice.format};
  if (choice.coarse != choice.format) formats.push_back(choice.coarse);
  for (const rtl::Format& format : formats) {
    const std::string bits = rtl::to_string(format);
    const auto named = sim::software_of(*choice.design).named_tracer;
    const ref::RenderResult work =
        studio.render(*sim::make_tracer(*choice.design, {format}, scene.mesh, bvh));
    const ref::TraceCounts counts = work.counts.total();
    const std::vector<float> extra = ref::extra_box_tests(work, software);
    const std::string numbers =
        fmt::format("{} in all, of {}",
                    readable_number(std::to_string(static_cast<std::int64_t>(counts.box_tests) -
                                                   static_cast<std::int64_t>(reference.box_tests))),
                    readable_number(std::to_string(counts.box_tests)));
    const std::size_t pixels = pixels_with_more(extra);
    if (shown_from * pixels < extra.size()) {
      made.not_drawn.push_back(
          fmt::format("Extra box tests of {} {} have no map, because only {} of {} pixels have any. {}.",
                      choice.design->name, bits, pixels, extra.size(), numbers));
      continue;
    }
    std::string file = "extra_box_tests_" + bits;
    std::replace(file.begin(), file.end(), '/', '_');
    studio.map(
        file, extra,
        fmt::format("Extra box tests of a pixel: {} {} above conservative float slabs. {}.",
                    choice.design->name, bits, numbers),
        fmt::format("Heat map of the extra box tests of {} {}", choice.design->name, bits),
        row_of(fmt::format("{} {}", choice.design->name, bits), counts.box_tests, counts.triangle_tests,
               named == nullptr ? ""
                                : fmt::format("{} {} --extra-box-map FILE.png", render,
                                              trace_options_text(named(format)))));
  }
  return made;
}

}  // namespace hitpipe::cli
