#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/cache_options.hpp"
#include "cli/options/core_scene_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/values.hpp"
#include "cli/options/world_options.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/format.hpp"
#include "host/outputs.hpp"
#include "rays/image/core_image.hpp"
#include "sw_ref/core/core_tracer.hpp"
#include "sw_ref/memory/read_bytes.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/recording.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::cli {

namespace {

struct ImageCommand {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  std::string bits = to_string(Format(hls::WorldBits{}));
  std::string out;
  std::string check;  ///< a file to read in place of writing one
  std::optional<int> block_bits;
  std::vector<int> places;
  CacheChoice caches;
  OutputFormat format = OutputFormat::text;
};

Row figures_of(const ref::CoreImage& image) {
  return {{"records", image.records},
          {"levels", image.header.levels},
          {"blocks", image.blocks.size()},
          {"bytes", image.bytes()}};
}

void check_image(const ImageCommand& command) {
  const ref::CoreImage image = read_core_image(command.check);
  const ref::CoreHeader& header = image.header;
  Row row{{"file", command.check},
          {"coordinate_bits", header.coord_bits},
          {"triangles", header.triangles},
          {"missing_triangles", header.missing}};
  row.update(figures_of(image));
  const glm::dvec3& offset = header.to_cube.offset;
  row.update({{"offset", {offset.x, offset.y, offset.z}}, {"scale", header.to_cube.scale}});
  if (command.format == OutputFormat::text) {  // with all digits
    row["offset"] = fmt::format("{},{},{}", offset.x, offset.y, offset.z);
    row["scale"] = fmt::format("{}", header.to_cube.scale);
  }
  fmt::print("{}", record_text(row, command.format));
}

/// Refuses an image that a core's numbers of blocks are too short for.
void check_block_bits(const ImageCommand& command, const ref::CoreImage& image) {
  if (!command.block_bits || image.blocks.size() <= std::uint64_t{1} << *command.block_bits) return;
  int needed = *command.block_bits;
  while (image.blocks.size() > std::uint64_t{1} << needed) ++needed;
  throw std::runtime_error(fmt::format("--block-bits {}: the image has {} blocks; allowed is {} and more",
                                       *command.block_bits, image.blocks.size(), needed));
}

/// What whoever uses the image must know and cannot read in it: where the mesh went, and which of its triangles
/// are not there. A triangle's number is its place in the order of the source; a face of several triangles has
/// several numbers.
Row beside(const Row& row, const ref::IntScene& scene, const CLI::App& parsed) {
  const ref::Mesh& mesh = scene.mesh.mesh;
  Row about = notes_of(parsed, scene.scene);
  about["image"] = row;
  about["units_of_a_corner_in_half_the_cube"] = (1 << (scene.bits.coord - 2)) - 1;
  about["dropped_triangles"] = mesh.dropped;
  about["first_triangle_of_face"] = mesh.faces;
  return about;
}

/// What the rays of the scene's picture read of the image, a row for each size of the stack.
std::vector<Row> reads_of(const ImageCommand& command, const ref::IntScene& scene,
                          const ref::CoreImage& image) {
  const ref::IntSurfaces surfaces(scene);
  std::vector<Row> rows;
  for (const int places : command.places) {
    Progress progress("walking");
    const ref::CoreTracer core(
        image, scene.mesh.mesh,
        {.world = scene.bits, .boxes = usual_box_format(scene.bits), .places = places});
    ref::RenderOptions picture{.width = command.scene.width,
                               .height = command.scene.height,
                               .threads = command.scene.threads,
                               .surfaces = &surfaces,
                               .progress = [&](double share) { progress.show(share); }};
    ref::Recording recording;
    if (command.caches.kib.empty()) {
      recording.counts = ref::render(scene.scene, core, picture).counts;
    } else {
      picture.threads = 1;  // caches depend on the order of the rays
      recording = ref::record_rays(scene.scene, core, picture);
    }
    const ref::TraceCounts work = recording.counts.total();
    const auto rays = static_cast<double>(work.rays);
    const auto blocks = static_cast<double>(work.nodes_loaded + work.triangles_loaded);
    Row row{{"stack", places},
            {"rays", work.rays},
            {"records_a_ray", static_cast<double>(work.nodes_loaded) / rays},
            {"triangles_a_ray", static_cast<double>(work.triangles_loaded) / rays},
            {"restarts_a_ray", static_cast<double>(core.restarts()) / rays},
            {"bytes_a_ray", blocks * static_cast<double>(ref::core_block_bytes) / rays}};
    if (!command.caches.kib.empty())  // to the memory's model all blocks are nodes
      add_read_bytes(row, "bytes_a_ray",
                     ref::read_bytes(core, {}, {}, recording.batches, ref::TriangleLayout::corners,
                                     command.caches.shapes(ref::Replacement::by_age)),
                     command.caches);
    rows.push_back(std::move(row));
  }
  return rows;
}

void write_image(ImageCommand command, const CLI::App& parsed) {
  const auto bits = parse_bits<hls::WorldBits>(command.bits);
  if (!command.out.empty())
    for (const char* const ending : {"", ".json"}) host::announce_output("--out", command.out + ending);
  command.hierarchy.build.threads = command.scene.threads;
  std::optional<Progress> progress("reading the scene");
  const ref::IntScene scene = command.scene.in_integers(command.scene.load(), bits, command.hierarchy);
  progress.emplace("writing the image");
  const ref::CoreImage image = ref::core_image(scene);
  Row row{{"scene", scene.scene.name},
          {"bits", to_string(Format(bits))},
          {"hierarchy", command.hierarchy.name()}};
  row.update(scene_row(scene));
  row.update(figures_of(image));
  check_block_bits(command, image);
  if (!command.out.empty()) {
    row["file"] = command.out;
    host::write_file(command.out, ref::core_image_bytes(image.blocks));
    host::write_file(command.out + ".json", record_text(beside(row, scene, parsed), OutputFormat::json));
  }
  progress.reset();
  if (command.places.empty()) {
    fmt::print("{}", record_text(row, command.format));
    return;
  }
  if (command.format == OutputFormat::text) fmt::print("{}\n", record_text(row, command.format));
  std::vector<Row> reads = reads_of(command, scene, image);
  if (command.format == OutputFormat::json)
    for (Row& each : reads) each.update(scene_row(scene));
  if (command.format != OutputFormat::text || command.caches.kib.empty()) {
    fmt::print("{}", table_text(reads, command.format));
    return;
  }
  for (const Row& each : reads)  // a table would be too wide
    fmt::print("{}{}", &each == &reads.front() ? "" : "\n", record_text(each, command.format));
}

}  // namespace

CLI::App* add_core_image_command(CLI::App& core, int& /*exit_code*/) {
  CLI::App* const command = core.add_subcommand("image", "Write a scene as the memory of a core holds it");
  const auto options = std::make_shared<ImageCommand>();
  add_scene_options(*command, options->scene);
  add_hierarchy_options(*command, options->hierarchy, Boxes::integers);
  command->add_option("--bits", options->bits, "Format of the integer world, n+gsS")
      ->capture_default_str()
      ->type_name("FORMAT");
  as_output(command->add_option(
      "--out", options->out,
      "Write the blocks to this file, and beside it, as FILE.json, where the mesh lies in "
      "the image and which triangles it lacks"));
  add_count_option(*command, "--block-bits", options->block_bits, {4, 32},
                   "Refuse an image with more blocks than a core of `core rtl --block-bits N` reads");
  CLI::Option* const check =
      as_input(
          command->add_option("--check", options->check,
                              "Judge a file in place of writing one: each block is reached once, and boxes "
                              "hold what is in them"))
          ->type_name("FILE");
  needs_one_of(*command, {command->get_option("--scene")->required(false), check});
  constexpr int most_places = 60;
  CLI::Option* const places = command->add_option(
      "--stack", options->places,
      "Also print what the rays of the picture read, for a stack of so many places (0 to 60)");
  places->delimiter(',')->transform(number_from(0, most_places))->type_name("N");
  add_cache_options(*command, options->caches)->needs(places);
  add_format_option(*command, options->format);
  exclude_all_but(*command, check, {"--format"}, "the file is there");
  add_examples(*command, {"hitpipe core image --scene spheres --out spheres.bin",
                          "hitpipe core image --scene terrain --stack 4,8 --cache 16"});
  command->callback([options, command] {
    options->check.empty() ? write_image(*options, *command) : check_image(*options);
  });
  return command;
}

}  // namespace hitpipe::cli
