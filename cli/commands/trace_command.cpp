#include <algorithm>
#include <charconv>
#include <cstdint>
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
#include "cli/options/core_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/options/world_options.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "cli/text/trace_text.hpp"
#include "host/files.hpp"
#include "rtl_gen/catalogue/format.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/core/core.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "sw_ref/core/core_image.hpp"
#include "sw_ref/render/image_file.hpp"

namespace hitpipe::cli {

namespace {

struct TraceCommand {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  std::string bits = rtl::to_string(rtl::Format(hls::WorldBits{}));
  std::vector<int> rays_in_flight{128};
  std::string rays;  ///< a file; empty: those of a picture
  CoreChoice core;
  std::vector<int> latency{100};
  sim::MemoryOptions memory;
  std::string library{rtl::default_library};
  bool native = false;
  std::string out;  ///< empty: no picture is written
  OutputFormat format = OutputFormat::text;
};

Row traced(const TraceCommand& command, const rtl::Core& core, const rtl::Library& library,
           const ref::CoreImage& image, const sim::PictureRays& picture, bool& right) {
  Progress progress(fmt::format("tracing with {} rays in flight", core.options.rays));
  std::unique_ptr<rtl::NativeMachine> machine;
  if (command.native)
    machine = std::make_unique<sim::NativeCore>(core);
  else
    machine = std::make_unique<sim::VerilatedMachine>(core, rtl::to_verilog(core, library));
  const sim::CoreTrace trace = sim::trace_core(core, *machine, image, picture, command.memory,
                                               [&](double share) { progress.show(share); });
  right = right && trace.right();
  return trace_row(core, trace, command.memory.cache_kib > 0);
}

/// A line for each figure, since there are more of them than cores.
std::vector<Row> turned(const std::vector<Row>& rows) {
  std::vector<Row> lines;
  for (const auto& [key, first] : rows.front().items()) {
    if (key == "rays_in_flight") continue;
    Row line{{"rays in flight", key}};
    for (const Row& row : rows) line[row.at("rays_in_flight").dump()] = row.at(key);
    lines.push_back(std::move(line));
  }
  return lines;
}

void trace_scene(TraceCommand command, int& exit_code) {
  const auto bits = rtl::parse_bits<hls::WorldBits>(command.bits);
  const rtl::Library library = rtl::library_called(command.library);
  command.hierarchy.build.threads = command.scene.threads;
  command.memory.least_latency = command.latency.front();
  command.memory.most_latency = command.latency.back();
  const rtl::CoreOptions& bus = command.core.options;
  command.memory.in_order = bus.has_one_id();
  command.memory.interval = bus.beats();
  if (command.memory.least_latency > command.memory.most_latency)
    throw std::runtime_error(fmt::format("--latency {},{}: the first is the least", command.latency.front(),
                                         command.latency.back()));
  std::optional<Progress> progress("reading the scene");
  const ref::Scene loaded = command.scene.load();
  const std::filesystem::path picture_file =
      std::filesystem::path(command.out) / (std::filesystem::path(loaded.name).stem().string() + ".png");
  if (!command.out.empty()) {
    host::make_folder(command.out);
    ref::check_image_place(picture_file);
  }
  const ref::IntScene scene = ref::int_scene(loaded, bits, command.hierarchy);
  const ref::CoreImage image = ref::core_image(scene);
  if (image.levels > command.core.options.levels)
    throw std::runtime_error(
        fmt::format("--levels {}: the scene has {} records on a path; allowed is {} to {}",
                    command.core.options.levels, image.levels, image.levels, rtl::CoreOptions::most_levels));
  std::vector<sim::AskedRay> list;
  if (!command.rays.empty()) list = sim::read_ray_list(command.rays, loaded.to_cube);
  progress.emplace("walking in software");
  const ref::CoreTracerOptions walking{
      .world = bits, .boxes = usual_box_format(bits), .places = command.core.places};
  const sim::PictureRays picture =
      list.empty() ? sim::picture_rays(scene, image, walking,
                                       {.width = command.scene.width,
                                        .height = command.scene.height,
                                        .progress = [&](double share) { progress->show(share); }})
                   : sim::listed_rays(scene, image, walking, list);
  progress.emplace("making the core");
  std::vector<rtl::CoreOptions> options;
  for (const int rays : command.rays_in_flight) {
    rtl::CoreOptions& core = options.emplace_back(command.core.core(std::nullopt));
    core.bits = usual_ray_format(bits);
    core.rays = rays;
    sim::make_room(core, image);
  }
  const std::vector<rtl::Core> cores = rtl::make_cores(options, library);
  progress.reset();
  bool right = true;
  std::vector<Row> rows;
  for (const rtl::Core& core : cores) rows.push_back(traced(command, core, library, image, picture, right));
  fmt::print("{}", table_text(command.format == OutputFormat::text ? turned(rows) : rows, command.format));
  if (command.format == OutputFormat::text) fmt::print("hierarchy: {}\n", command.hierarchy.text());
  if (!right) exit_code = 1;
  // Software's picture, so it is the core's only if all answers are the same.
  if (right && !command.out.empty())
    ref::write_image(picture_file, command.scene.width, command.scene.height, picture.image);
}

}  // namespace

CLI::App* add_trace_command(CLI::App& program, int& exit_code) {
  CLI::App* const command = program.add_subcommand("trace", "Trace a scene by a core, cycle by cycle");
  const auto options = std::make_shared<TraceCommand>();
  add_scene_options(*command, options->scene);
  add_hierarchy_options(*command, options->hierarchy, Boxes::integers);
  const auto number = [&](const char* name, int& value, const char* text, int least, int most) {
    command->add_option(name, value, fmt::format("{} ({} to {})", text, least, most))
        ->capture_default_str()
        ->transform(number_from(least, most))
        ->type_name("N");
  };
  command->add_option("--bits", options->bits, "Format of the integer world, n+gsS")
      ->capture_default_str()
      ->type_name("FORMAT");
  command
      ->add_option("--rays-in-flight", options->rays_in_flight,
                   "Rays that the core has room for, a row for each number (1 to 256)")
      ->delimiter(',')
      ->capture_default_str()
      ->transform(number_from(1, 256))
      ->type_name("N");
  add_core_options(*command, options->core);
  command
      ->add_option("--latency", options->latency,
                   "Cycles from a request to its answer: N, or A,B for random ones (1 to 10000)")
      ->delimiter(',')
      ->expected(1, 2)
      ->capture_default_str()
      ->transform(number_from(1, sim::MemoryOptions::most_cycles))
      ->type_name("N");
  add_core_bus_options(*command, options->core);
  number("--refuse", options->memory.refused_percent, "Percent of cycles in which memory takes no request", 0,
         99);
  number("--cache", options->memory.cache_kib,
         "KiB of a cache with 8 ways and lines of 64 bytes, a power of two; 0 is none", 0, 65'536);
  add_library_option(*command, options->library);
  command->add_flag("--native", options->native,
                    "The core as C++, which is the same in every cycle; else as Verilog");
  add_folder_option(*command, options->out,
                    "Folder for the picture that the answers make, SCENE.png; written when all are right");
  add_ray_list_option(*command, options->rays);
  exclude(command->get_option("--rays"), std::as_const(*command).get_option("--out"),
          "the rays of a file make no picture");
  add_format_option(*command, options->format);
  command->callback([options, &exit_code] { trace_scene(*options, exit_code); });
  return command;
}

}  // namespace hitpipe::cli
