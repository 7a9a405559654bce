#include "cli/commands/rescale.hpp"

#include <cmath>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/hierarchy_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/text.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::cli {

namespace {

std::optional<double> number(std::string_view text) {
  const auto value = host::number_in<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// "0.1" or "2^-100".
NamedTransform parse_scale(const std::string& text) {
  const bool power = text.starts_with("2^");
  const auto value = number(std::string_view(text).substr(power ? 2 : 0));
  const double scale = value ? (power ? std::exp2(*value) : *value) : 0.0;
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    throw CLI::ValidationError(
        "--scale",
        fmt::format("{} is not a scale; give a number above 0 or a power of two, for example 0.1 or 2^-10",
                    host::shortened(text)));
  }
  return {text, {.scale = scale}};
}

NamedTransform parse_offset(const std::string& text) {
  std::istringstream words(text);
  sim::Transform transform;
  int axis = 0;
  bool good = !text.ends_with(',');
  for (std::string word; std::getline(words, word, ','); ++axis) {
    const auto value = number(word);
    good = good && axis < 3 && value;
    if (good) transform.offset[axis] = *value;
  }
  if (!good || axis != 3) {
    throw CLI::ValidationError(
        "--offset",
        fmt::format("{} is not X,Y,Z; give three numbers, for example 1000,0,-0.5", host::shortened(text)));
  }
  return {"+" + text, transform};
}

/// What the user asked for, or a choice of scales and offsets. Offsets are measured in the longest side of
/// the mesh.
std::vector<NamedTransform> transforms(const RescaleChoice& choice, const ref::SceneDescription& scene) {
  std::vector<NamedTransform> all = choice.scales;
  all.insert(all.end(), choice.offsets.begin(), choice.offsets.end());
  if (!all.empty()) return all;
  for (const char* const scale : {"2^-100", "2^-10", "2^10", "2^100", "3", "0.1"}) {
    all.push_back(parse_scale(scale));
  }
  for (const double sides : {10.0, 1000.0}) {
    const double far = sides * ref::mesh_bounds(scene.mesh).longest();
    all.push_back(parse_offset(fmt::format("{0:.3g},{0:.3g},{0:.3g}", far)));
  }
  return all;
}

Row row_of(const NamedTransform& t, const sim::MovedScene& moved, const sim::Picture& picture,
           const sim::PixelChanges& changes, bool judged) {
  const auto by_rtl = [&](std::uint64_t count) { return judged ? Row(count) : Row(nullptr); };
  return {{"transform", t.name},
          {"vertices_moved", moved.vertices_moved},
          {"lost_to_rounding", picture.lost_to_rounding},
          {"pixels_other_triangle", changes.other_triangle},
          {"pixels_other_colour", changes.other_colour},
          {"different_triangles", by_rtl(picture.different_triangles)},
          {"rtl_mismatches", by_rtl(picture.rtl_mismatches)}};
}

/// As a table that fits 80 columns.
Row short_row(const Row& row, bool judged) {
  Row made{{"transform", row.at("transform")},
           {"vertices", row.at("vertices_moved")},
           {"lost", row.at("lost_to_rounding")},
           {"triangle", row.at("pixels_other_triangle")},
           {"colour", row.at("pixels_other_colour")}};
  if (judged) {
    made["different"] = row.at("different_triangles");
    made["rtl"] = row.at("rtl_mismatches");
  }
  return made;
}

}  // namespace

int rescale(const SceneChoice& chosen, const RescaleChoice& choice, const DesignChoice* design,
            OutputFormat format) {
  const bool judged = design != nullptr;
  sim::PictureOptions options{
      .width = chosen.width, .height = chosen.height, .threads = chosen.threads, .build = choice.build};
  std::optional<rtl::Unit> unit;
  if (judged) unit = rtl::make_unit(design->design(), design->format(), rtl::Library::thesis());

  std::optional<Progress> progress("reading the scene");
  const ref::SceneDescription read = ref::describe_scene(chosen.name, chosen.placing);
  static_cast<void>(chosen.placed(read));  // says what is lost before the long run
  // As a file of floats has it, and as each moved one is.
  const ref::SceneDescription scene = sim::moved(read, {}).description;
  const std::vector<NamedTransform> all = transforms(choice, scene);
  std::optional<sim::VerilatedDesign> verilated;
  if (judged) {
    progress.emplace("compiling the Verilog");
    verilated.emplace(*std::move(unit));
    options.verilated = &*verilated;
  }
  progress.emplace("rendering");
  std::uint64_t wrong = 0;
  const auto render = [&](const ref::SceneDescription& description, std::size_t finished) {
    sim::Picture picture = sim::picture(description, options);
    wrong += picture.different_triangles + picture.rtl_mismatches;
    progress->show(static_cast<double>(finished) / static_cast<double>(all.size() + 1));
    return picture;
  };
  const sim::Picture original = render(scene, 1);
  std::vector<Row> rows;
  for (const NamedTransform& t : all) {
    try {
      const sim::MovedScene moved = sim::moved(scene, t.transform);
      const sim::Picture picture = render(moved.description, rows.size() + 2);
      rows.push_back(row_of(t, moved, picture, sim::pixel_changes(original, picture), judged));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("transform {}: {}", t.name, error.what()));
    }
  }
  progress.reset();

  if (format == OutputFormat::text) {
    fmt::print("{}: {} vertices, {} pixels{}\n", scene.name, scene.mesh.vertices.size(),
               original.image.size(),
               judged ? fmt::format(", {} {}", design->design().name, to_string(design->format())) : "");
    for (Row& row : rows) row = short_row(row, judged);
  }
  fmt::print("{}", table_text(rows, format));
  if (wrong == 0) return 0;
  fmt::print(stderr, "hitpipe: {} answers of the Verilog differ from the reference on the moved mesh\n",
             wrong);
  return 1;
}

void add_rescale_options(CLI::App& command, RescaleChoice& choice, const std::vector<std::string>& used) {
  std::vector<std::string> allowed{"--rescale", "--scale", "--offset", "--format"};
  for (const std::string& name : scene_option_names())
    if (name != "--cube") allowed.push_back(name);  // it does not move with the mesh
  for (const std::string_view name : hierarchy_option_names())
    if (name != "--bvh") allowed.emplace_back(name);
  allowed.insert(allowed.end(), used.begin(), used.end());
  CLI::Option* const asked = command.add_flag(
      "--rescale", choice.asked,
      "In place of a picture, count the pixels that change when mesh, camera and lights are scaled and "
      "moved, by --scale and --offset or else a choice of both");
  const auto add = [&](const char* name, std::vector<NamedTransform>& list,
                       NamedTransform (*parse)(const std::string&), const char* what) {
    return command
        .add_option_function<std::vector<std::string>>(
            name,
            [&list, parse](const std::vector<std::string>& texts) {
              for (const std::string& text : texts) list.push_back(parse(text));
            },
            what)
        ->needs(asked)
        ->allow_extra_args(false);
  };
  add("--scale", choice.scales, parse_scale,
      "With --rescale: scale by a number or by 2^N; repeat it for more")
      ->delimiter(',')
      ->type_name("X");
  add("--offset", choice.offsets, parse_offset,
      "With --rescale: move, in units of the scene; repeat it for more")
      ->type_name("X,Y,Z");
  exclude_all_but(command, asked, allowed, "it builds the hierarchy of each picture, and writes none");
}

}  // namespace hitpipe::cli
