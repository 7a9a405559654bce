#include "cli/options/hierarchy_options.hpp"

#include <array>
#include <limits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/options/values.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

/// The space that a placed scene leaves around it in the cube. Padded boxes must stay in the cube.
constexpr double most_padding = 0x1p-10;

std::string padding_error(const std::string& text) {
  const auto padding = host::number_in<double>(text);
  if (padding && *padding >= 0.0 && *padding <= most_padding) return {};
  return fmt::format("{} is not a padding; allowed is 0 to 2^-10 = {:.6f}", host::shortened(text),
                     most_padding);
}

constexpr auto option_names = std::to_array<std::string_view>(
    {"--builder", "--max-triangles", "--max-depth", "--padding", "--grid-bits", "--bvh"});

}  // namespace

void add_hierarchy_options(CLI::App& command, ref::HierarchyOptions& options, Boxes boxes) {
  ref::BuildOptions& build = options.build;
  Choices<ref::Builder> builders;
  for (const ref::Builder each : {ref::Builder::median, ref::Builder::sah})
    builders.emplace_back(ref::builder_name(each), each);
  std::vector<const CLI::Option*> of_a_build;
  of_a_build.push_back(add_choice_option<ref::Builder>(
      command, "--builder", build.builder, builders,
      "median: split boxes in the middle, as in the thesis; sah: split where surface areas make it "
      "cheapest"));
  of_a_build.push_back(add_count_option(command, "--max-triangles", build.max_triangles,
                                        {1, std::numeric_limits<std::int32_t>::max()},
                                        "Maximum number of triangles in a leaf")
                           ->capture_default_str());
  of_a_build.push_back(add_count_option(command, "--max-depth", build.max_depth,
                                        {1, ref::BuildOptions::deepest}, "Maximum number of levels")
                           ->capture_default_str());
  if (boxes == Boxes::floats)
    command
        .add_option(
            "--padding", build.padding,
            "Added to each side of a box, in units of the cube of side 2 (0 to 2^-10); below 5e-7 float "
            "traversals may miss triangles")
        ->check(padding_error)
        ->capture_default_str()
        ->type_name("P");
  of_a_build.push_back(
      add_count_option(
          command, "--grid-bits", build.grid_bits, {6, 32},
          "Do not split a node along an axis where it is narrower than one unit of the n-bit grid")
          ->type_name("n"));
  CLI::Option* const file = command.add_option_function<std::string>(
      "--bvh", [&options](const std::string& name) { options.file = name; },
      "Take the hierarchy of boxes from this file instead of building one");
  file->check([](const std::string& name) {
        return name.empty() ? "is empty; give the name of a file" : std::string();
      })
      ->type_name("FILE");
  as_input(file);
  for (const CLI::Option* const other : of_a_build)
    exclude(file, other, "the hierarchy of the file is built already");
}

std::span<const std::string_view> hierarchy_option_names() {
  return option_names;
}

std::string hierarchy_arguments(const ref::HierarchyOptions& options) {
  const ref::BuildOptions& build = options.build;
  const ref::BuildOptions usual;
  std::string text = options.file.empty() ? fmt::format("--builder {} --max-triangles {}",
                                                        ref::builder_name(build.builder), build.max_triangles)
                                          : fmt::format("--bvh {}", host::shell_word(options.file.string()));
  if (options.file.empty() && build.max_depth != usual.max_depth)
    text += fmt::format(" --max-depth {}", build.max_depth);
  if (options.file.empty() && build.grid_bits != usual.grid_bits)
    text += fmt::format(" --grid-bits {}", build.grid_bits);
  if (build.padding != usual.padding) text += fmt::format(" --padding {}", build.padding);
  return text;
}

}  // namespace hitpipe::cli
