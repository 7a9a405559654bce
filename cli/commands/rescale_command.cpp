#include <cmath>
#include <memory>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "host/text.hpp"
#include "sim/check/rescale.hpp"

namespace hitpipe::cli {

namespace {

/// A transform, with the text by which the user gave it.
struct NamedTransform {
  std::string name;
  sim::Transform transform;
};

struct RescaleCommand {
  SceneChoice scene;
  std::vector<NamedTransform> scales;
  std::vector<NamedTransform> offsets;
  DesignChoice design;  ///< without a name: software only
  Format format = Format::text;
};

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
                    text));
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
        "--offset", fmt::format("{} is not X,Y,Z; give three numbers, for example 1000,0,-0.5", text));
  }
  return {"+" + text, transform};
}

/// What the user asked for, or a choice of scales and offsets. Offsets are measured in the longest side of
/// the mesh.
std::vector<NamedTransform> transforms(const RescaleCommand& command, const ref::SceneDescription& scene) {
  std::vector<NamedTransform> all = command.scales;
  all.insert(all.end(), command.offsets.begin(), command.offsets.end());
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
          {"degenerate_dropped", picture.degenerate_dropped},
          {"pixels_other_triangle", changes.other_triangle},
          {"pixels_other_colour", changes.other_colour},
          {"different_triangles", by_rtl(picture.different_triangles)},
          {"rtl_mismatches", by_rtl(picture.rtl_mismatches)}};
}

/// As a table that fits 80 columns.
Row short_row(const Row& row, bool judged) {
  Row made{{"transform", row.at("transform")},
           {"vertices", row.at("vertices_moved")},
           {"dropped", row.at("degenerate_dropped")},
           {"triangle", row.at("pixels_other_triangle")},
           {"colour", row.at("pixels_other_colour")}};
  if (judged) {
    made["different"] = row.at("different_triangles");
    made["rtl"] = row.at("rtl_mismatches");
  }
  return made;
}

int rescale(const RescaleCommand& command) {
  const bool judged = !command.design.name.empty();
  if (!judged && command.design.bits) throw CLI::ValidationError("--bits", "needs --design");
  sim::PictureOptions options{
      .width = command.scene.width, .height = command.scene.height, .threads = command.scene.threads};
  std::optional<sim::Unit> unit;
  if (judged) unit = sim::make_unit(command.design.design(), command.design.format(), rtl::Library::thesis());

  std::optional<Progress> progress("reading the scene");
  const ref::SceneDescription scene = ref::describe_scene(command.scene.name, command.scene.placing);
  const std::vector<NamedTransform> all = transforms(command, scene);
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

  if (command.format == Format::text) {
    fmt::print(
        "{}: {} vertices, {} pixels{}\n", scene.name, scene.mesh.vertices.size(), original.image.size(),
        judged ? fmt::format(", {} {}", command.design.design().name, rtl::to_string(command.design.format()))
               : "");
    for (Row& row : rows) row = short_row(row, judged);
  }
  fmt::print("{}", table_text(rows, command.format));
  if (wrong == 0) return 0;
  fmt::print(stderr, "hitpipe: {} answers of the Verilog differ from the reference on the moved mesh\n",
             wrong);
  return 1;
}

}  // namespace

void add_rescale_command(CLI::App& program, int& exit_code) {
  CLI::App* const command = program.add_subcommand(
      "rescale", "Render a scene in other units and at other places, and count the pixels that change");
  const auto options = std::make_shared<RescaleCommand>();
  add_scene_options(*command, options->scene);
  const auto add = [&](const char* name, std::vector<NamedTransform>& list,
                       NamedTransform (*parse)(const std::string&), const char* what) {
    return command->add_option_function<std::vector<std::string>>(
        name,
        [&list, parse](const std::vector<std::string>& texts) {
          for (const std::string& text : texts) list.push_back(parse(text));
        },
        what);
  };
  add("--scale", options->scales, parse_scale, "Scale mesh, camera and lights by a number or by 2^N")
      ->delimiter(',')
      ->type_name("X");
  add("--offset", options->offsets, parse_offset, "Move them, in units of the scene")->type_name("X,Y,Z");
  command->add_option("--design", options->design.name, "This design's Verilog answers every box test")
      ->type_name("NAME");
  command->add_option("--bits", options->design.bits, "Number format of the design (default: its own)")
      ->type_name("FORMAT");
  add_format_option(*command, options->format);
  command->callback([options, &exit_code] { exit_code = rescale(*options); });
}

}  // namespace hitpipe::cli
