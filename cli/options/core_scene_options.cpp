#include "cli/options/core_scene_options.hpp"

#include <filesystem>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/hierarchy_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/scene_text.hpp"
#include "host/files.hpp"
#include "sw_ref/core/image_scene.hpp"

namespace hitpipe::cli {

ref::CoreImage read_core_image(const std::string& file) {
  const std::string bytes = host::read_file(file);
  try {
    return ref::checked_image(ref::core_image_blocks(bytes));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  }
}

void check_grid(const ref::CoreImage& image, const hls::WorldBits& world, const std::string& bits) {
  if (const int n = image.header.coord_bits; n != world.coord)
    throw std::runtime_error(fmt::format(
        "--bits {}: the image has a grid of {} bits; allowed are formats that begin with {}+", bits, n, n));
}

std::optional<ref::CoreImage> CoreSceneChoice::stored() const {
  if (image.empty()) return std::nullopt;
  return read_core_image(image);
}

CoreScene CoreSceneChoice::load(std::optional<ref::CoreImage> stored, const hls::WorldBits& world,
                                const std::string& bits) const {
  CoreScene made;
  if (!stored) {
    const ref::Scene loaded = scene.load();
    made.scene = std::make_shared<const ref::IntScene>(scene.in_integers(loaded, world, hierarchy));
    made.image = ref::core_image(*made.scene);
    made.mesh = scene_row(*made.scene);
    made.notes = camera_notes(loaded);
    made.hierarchy = hierarchy.text();
    return made;
  }
  check_grid(*stored, world, bits);
  made.image = std::move(*stored);
  made.scene = std::make_shared<const ref::IntScene>(
      ref::image_scene(made.image, world, std::filesystem::path(image).stem().string(), scene.placing));
  scene.check_rays(made.scene->scene.camera, "--image");
  made.mesh = image_row(*made.scene);
  made.notes = camera_notes(made.scene->scene);
  made.notes["mesh"] = made.mesh;
  made.hierarchy = "that of the image";
  return made;
}

CoreSceneOptions add_core_scene_options(CLI::App& command, CoreSceneChoice& choice) {
  add_scene_options(command, choice.scene);
  add_hierarchy_options(command, choice.hierarchy, Boxes::integers);
  CLI::Option* const scene = command.get_option("--scene")->required(false);
  CLI::Option* const image =
      as_input(command.add_option("--image", choice.image,
                                  "An image of `core image` in place of a scene. It has triangles, hierarchy "
                                  "and cube, but no materials; rays must begin in its cube"))
          ->type_name("FILE")
          ->check([](const std::string& file) {
            return file.empty() ? "is empty; give the name of a file" : std::string();
          });
  exclude(image, scene, "the image has its triangles");
  for (const char* const other : {"--triangles", "--cube", "--strict", "--faces"})
    exclude(image, command.get_option(other), "the image has its triangles and its cube");
  for (const std::string_view other : hierarchy_option_names())
    if (const CLI::Option* const option = command.get_option_no_throw(std::string(other)))
      exclude(image, option, "the image has its hierarchy");
  return {scene, image};
}

}  // namespace hitpipe::cli
