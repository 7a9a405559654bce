#include "cli/options/build_options.hpp"

#include <limits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

const Choices<ref::Builder> builders{{"median", ref::Builder::median}, {"sah", ref::Builder::sah}};

/// The space that a placed scene leaves around it in the cube. Padded boxes must stay in the cube.
constexpr double most_padding = 0x1p-10;

std::string padding_error(const std::string& text) {
  const auto padding = host::number_in<double>(text);
  if (padding && *padding >= 0.0 && *padding <= most_padding) return {};
  return fmt::format("{} is not a padding; allowed is 0 to 2^-10 = {:.6f}", host::shortened(text),
                     most_padding);
}

}  // namespace

std::string builder_name(ref::Builder builder) {
  for (const auto& [name, value] : builders)
    if (value == builder) return name;
  return {};
}

void add_build_options(CLI::App& command, ref::BuildOptions& options) {
  add_choice_option<ref::Builder>(
      command, "--builder", options.builder, builders,
      "median: split boxes in the middle, as in the thesis; sah: split where surface areas make it cheapest");
  add_count_option(command, "--max-triangles", options.max_triangles,
                   {1, std::numeric_limits<std::int32_t>::max()}, "Maximum number of triangles in a leaf")
      ->capture_default_str();
  add_count_option(command, "--max-depth", options.max_depth, {1, ref::BuildOptions::deepest},
                   "Maximum number of levels")
      ->capture_default_str();
  command
      .add_option(
          "--padding", options.padding,
          "Added to each side of a box, in units of the cube of side 2 (0 to 2^-10); below 5e-7 float "
          "traversals may miss triangles")
      ->check(padding_error)
      ->capture_default_str()
      ->type_name("P");
  add_count_option(command, "--grid-bits", options.grid_bits, {6, 32},
                   "Do not split a node along an axis where it is narrower than one unit of the n-bit grid")
      ->type_name("n");
}

void add_bvh_file_option(CLI::App& command, std::string& file) {
  const auto named = [](const std::string& name) {
    return name.empty() ? "is empty; give the name of a file" : std::string();
  };
  CLI::Option* const option =
      command.add_option("--bvh", file, "Take the hierarchy of boxes from this file instead of building one")
          ->check(named)
          ->type_name("FILE");
  as_input(option);
  for (const char* const of_a_build : {"--builder", "--max-triangles", "--max-depth", "--grid-bits"})
    if (const CLI::Option* const other = command.get_option_no_throw(of_a_build))
      exclude(option, other, "the hierarchy of the file is built already");
}

ref::LoadedBvh make_hierarchy(const std::string& file, const ref::Scene& scene,
                              const ref::BuildOptions& build) {
  if (file.empty()) return {ref::build_bvh(scene.mesh, build)};
  return ref::load_bvh(file, scene, build.padding);
}

}  // namespace hitpipe::cli
