#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/rescale.hpp"
#include "cli/commands/world_cosim.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/answers_file.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/cosim/ray_unit.hpp"
#include "sim/operands/traced_list.hpp"
#include "sim/software.hpp"
#include "sw_ref/render/image_file.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

struct CosimCommand {
  DesignChoice choice;
  BoxFormatChoice boxes;
  std::optional<std::string> box_unit;
  std::string library{rtl::default_library};
  SceneChoice scene;
  ref::HierarchyOptions hierarchy;
  rtl::FlowControl flow_control = rtl::FlowControl::stall;
  int interval = 1;
  int rays_in_flight = 32;
  std::optional<int> ray_slots;
  bool referee = false;
  bool bit_level = false;
  std::string unit;
  ref::WhittedOptions light;
  RayListChoice rays;
  std::string out;
  OutputFormat format = OutputFormat::text;
};

/// Made here, or read from a folder.
rtl::Unit unit_of(const CosimCommand& command, const rtl::Library& library) {
  const rtl::Design& design = command.choice.design();
  return command.unit.empty()
             ? rtl::make_unit(design, command.choice.format(), library,
                              {.flow_control = command.flow_control, .interval = command.interval})
             : rtl::read_unit(command.unit, design, library);
}

Row record(const CosimCommand& command, const rtl::Unit& unit, const ref::Scene& scene,
           const ref::LoadedBvh& hierarchy, const sim::CosimResult& r) {
  const auto or_null = [](std::optional<std::uint64_t> count) { return count ? Row(*count) : Row(nullptr); };
  // Where each test answers for one box, tests and boxes are the same.
  const bool several_boxes = command.choice.design().kind.objects > 1;
  Row row{{"design", command.choice.name}, {"bits", rtl::to_string(unit.format)}};
  if (command.library != rtl::default_library) row["library"] = command.library;
  row["scene"] = scene.name;
  row.update(scene_row(scene));
  row["bvh_nodes"] = hierarchy.bvh.nodes.size();
  row["hierarchy"] = command.hierarchy.name();
  if (!command.hierarchy.file.empty()) row["bvh_boxes_grown"] = hierarchy.boxes_grown;
  row.update({{"rays_primary", r.rays_primary},
              {"rays_secondary", r.rays_secondary},
              {"rays_shadow", r.rays_shadow},
              {"rays_rejected", r.rejected}});
  if (several_boxes) row["unit_tests"] = r.unit.tests;
  row.update({{"box_tests", r.unit.box_tests},
              {"hits", r.unit.hits},
              {"rtl_mismatches", r.unit.rtl_mismatches},
              {"bit_level_tests", r.unit.bit_level_tests},
              {"false_misses", or_null(r.unit.false_misses)},
              {"false_hits", or_null(r.unit.false_hits)},
              {"different_triangles", r.different_triangles},
              {"extra_box_tests_pct", r.extra_box_tests_pct()},
              {"extra_triangle_tests_pct", r.extra_triangle_tests_pct()},
              {"cycles", r.unit.cycles},
              {"latency", r.latency},
              {"rays_in_flight", command.rays_in_flight},
              {"occupancy_pct", r.occupancy_pct()},
              {"rtl_tests_per_s", r.rtl_tests_per_s()},
              {"loop_tests_per_s", r.loop_tests_per_s()}});
  if (several_boxes) {
    row["rtl_boxes_per_s"] = r.rtl_boxes_per_s();
    row["loop_boxes_per_s"] = r.loop_boxes_per_s();
  }
  if (const auto& slots = unit.ray_slots) {
    const auto bits = [](int of_one, std::uint64_t count) { return of_one * static_cast<double>(count); };
    const auto per_box_test = [&](double all) {
      return r.unit.box_tests == 0 ? 0.0 : all / static_cast<double>(r.unit.box_tests);
    };
    row.update({{"ray_slots", slots->slots()},
                {"ray_writes", r.unit.ray_writes},
                {"ray_end_writes", r.unit.end_writes},
                {"bits_per_box_test_without_slots", per_box_test(bits(slots->bits_without(), r.unit.tests))},
                {"bits_per_box_test", per_box_test(bits(slots->bits_of_test(), r.unit.tests) +
                                                   bits(slots->bits_of_ray(), r.unit.ray_writes) +
                                                   bits(slots->bits_of_end(), r.unit.end_writes))}});
  }
  return row;
}

/// The drawings, or what they would be drawn from.
std::vector<std::string> schematics(const fs::path& folder, const rtl::UnitFiles& written) {
  std::vector<std::string> names;
  for (const rtl::File& file : written.files)
    if (file.name.ends_with(written.drawn ? ".svg" : ".dot")) names.push_back((folder / file.name).string());
  return names;
}

/// Throws std::runtime_error, one line, for an option that means nothing for a triangle unit.
int cosimulate_triangles(const CosimCommand& command, const CLI::App& parsed) {
  const auto refuse = [&](bool given, const char* option) {
    if (given)
      throw std::runtime_error(
          fmt::format("{}: not for design {}, which tests triangles", option, command.choice.name));
  };
  refuse(!command.unit.empty(), "--unit");
  refuse(command.ray_slots.has_value(), "--ray-slots");
  refuse(command.referee, "--referee");
  refuse(command.bit_level, "--bit-level");
  return cosimulate_world({command.choice, command.library, command.scene, command.hierarchy, command.boxes,
                           command.box_unit.value_or("int_major"), command.flow_control, command.interval,
                           command.rays_in_flight, command.light, command.rays, command.out, command.format},
                          parsed);
}

int cosimulate(const CosimCommand& command, const CLI::App& parsed) {
  const rtl::Design& design = command.choice.design();
  if (design.kind == hls::triangle_kind) return cosimulate_triangles(command, parsed);
  if (command.boxes.bits)
    throw std::runtime_error(fmt::format("--boxes: not for design {}, which tests boxes", design.name));
  if (command.box_unit)
    throw std::runtime_error(fmt::format("--box-unit: not for design {}, which tests boxes", design.name));
  if (const std::string why = sim::why_not_traced(design); !why.empty()) throw std::runtime_error(why);
  if (command.ray_slots) sim::check_slots(command.rays_in_flight, rtl::slot_count(*command.ray_slots));
  const rtl::Library library = rtl::library_called(command.library);
  const rtl::Unit bare = unit_of(command, library);
  const rtl::Unit unit = command.ray_slots ? rtl::behind_ray_slots(bare, *command.ray_slots) : bare;

  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = command.scene.load();
  const fs::path folder = command.out;
  const fs::path image = folder / (fs::path(scene.name).stem().string() + ".png");
  const bool draws = !command.out.empty() && !command.rays.given();
  if (draws) host::announce_output("--out", image);
  std::vector<sim::AskedRay> rays;
  if (command.rays.given()) rays = sim::read_ray_list(command.rays.file, scene.to_cube);
  AnswersFile answers(command.rays.answers);
  const ref::LoadedBvh hierarchy = ref::make_hierarchy(scene, command.hierarchy);
  progress.emplace("compiling the Verilog");
  const sim::VerilatedDesign verilated(unit);
  const bool emits = !command.out.empty() && command.unit.empty();
  // Done before the long run, so that a folder that cannot be written is reported at once.
  if (!command.out.empty()) host::make_folder(folder);
  rtl::UnitFiles written;
  if (emits) {
    written = rtl::write_unit(folder, rtl::emit(bare, {.ray_slots = command.ray_slots}));
  }
  progress.emplace("co-simulating");
  const sim::CosimResult result = sim::cosimulate(verilated, scene, hierarchy.bvh,
                                                  {.width = command.scene.width,
                                                   .height = command.scene.height,
                                                   .rays_in_flight = command.rays_in_flight,
                                                   .threads = command.scene.threads,
                                                   .referee = command.referee,
                                                   .bit_level = command.bit_level,
                                                   .light = command.light,
                                                   .rays = rays,
                                                   .progress = [&](double share) { progress->show(share); }});
  if (answers.wanted()) {
    progress.emplace("tracing in software");
    const auto exact =
        sim::trace_list(*ref::make_tracer(scene.mesh, hierarchy.bvh, {}), rays, command.scene.threads);
    answers.add({}, rays, [&](std::size_t ray) {
      return sim::answer_of(scene, rays[ray], result.triangles[ray], exact.triangles[ray]);
    });
    answers.finish(notes_of(parsed, scene));
  }
  progress.reset();

  Row row = record(command, unit, scene, hierarchy, result);
  if (draws) {
    ref::write_image(image, command.scene.width, command.scene.height, result.image);
    row["image"] = image.string();
  }
  if (emits) {
    row["verilog"] = (folder / (unit.module() + ".v")).string();
    row["schematics"] = schematics(folder, written);
  }
  fmt::print("{}", record_text(row, command.format));
  if (!written.drawn) fmt::print(stderr, "hitpipe: {}\n", rtl::not_drawn);
  const bool must_not_miss = design.conservative && command.referee;
  if (result.verified(must_not_miss)) return 0;
  const std::string false_misses =
      result.unit.false_misses ? fmt::format(", {} false misses", *result.unit.false_misses) : "";
  fmt::print(stderr, "hitpipe: {} {} on {}: {} RTL mismatches, {} different triangles{}; all must be 0\n",
             command.choice.name, rtl::to_string(unit.format), scene.name, result.unit.rtl_mismatches,
             result.different_triangles, false_misses);
  return 1;
}

}  // namespace

CLI::App* add_cosim_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("cosim", "Render a scene by a design's Verilog, and compare with software");
  const auto options = std::make_shared<CosimCommand>();
  add_design_options(*command, options->choice);
  CLI::Option* const unit =
      command
          ->add_option(
              "--unit", options->unit,
              "Run the unit in this folder, which `hitpipe fit` or `hitpipe rtl` wrote; it may be edited. "
              "Where the folder has several units of the design: the manifest of one")
          ->type_name("DIR|MANIFEST");
  const CLI::Option* const flow = add_flow_control_option(*command, options->flow_control);
  const CLI::Option* const interval = add_interval_option(*command, options->interval);
  for (const CLI::Option* const other : {flow, interval, std::as_const(*command).get_option("--bits")})
    exclude(unit, other, "the unit in the folder has its own, which its manifest says");
  add_library_option(*command, options->library);
  add_box_format_option(*command, options->boxes, "p = 11");
  command
      ->add_option("--box-unit", options->box_unit,
                   "The design that answers the boxes in the integer world: int_major, the default, or "
                   "int_major_pair")
      ->type_name("NAME");
  add_scene_options(*command, options->scene);
  add_hierarchy_options(*command, options->hierarchy);
  add_count_option(*command, "--rays-in-flight", options->rays_in_flight,
                   {1, sim::Station::most_rays}, "Rays that share one pipeline")
      ->capture_default_str();
  add_count_option(
      *command, "--ray-slots", options->ray_slots, {rtl::RaySlots::fewest, rtl::RaySlots::most},
      "Run the unit behind a memory of N rays, as `hitpipe rtl --ray-slots` writes it, with a slot "
      "for each ray in flight");
  add_light_options(*command, options->light);
  add_ray_list_options(*command, options->rays);
  command->add_flag("--referee", options->referee, "Exact arithmetic judges every answer");
  command->add_flag("--bit-level", options->bit_level,
                    "Compare every test of a float design with the bit-level C++; otherwise one in 61, and "
                    "the others with the host's floating-point unit");
  add_folder_option(*command, options->out, "Folder for the image, the Verilog and the schematics");
  add_format_option(*command, options->format);
  const auto moves = std::make_shared<RescaleChoice>();
  add_rescale_options(*command, *moves, {"design", "--bits"});
  add_examples(*command, {"hitpipe cosim int_slabs --scene spheres --out out",
                          "hitpipe cosim int_major --bits 16+1/11s16 --scene terrain --referee"});
  command->callback([options, moves, command, &exit_code] {
    moves->build = options->hierarchy.build;
    moves->build.threads = options->hierarchy.build.threads = options->scene.threads;
    exit_code = moves->asked ? rescale(options->scene, *moves, &options->choice, options->format)
                             : cosimulate(*options, *command);
  });
  return command;
}

}  // namespace hitpipe::cli
