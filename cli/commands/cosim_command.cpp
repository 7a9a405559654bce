#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/rescale.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/hierarchy_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/values.hpp"
#include "cli/options/world_options.hpp"
#include "cli/text/answers_file.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "cli/text/table.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "host/talk.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/read_unit.hpp"
#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/cosim/station.hpp"
#include "sim/cosim/world_tracer.hpp"
#include "sim/operands/traced_list.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/render.hpp"

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
  Row row{{"design", command.choice.name}, {"bits", to_string(unit.format)}};
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
  return row;
}

/// The drawings, or what they would be drawn from.
std::vector<std::string> schematics(const fs::path& folder, const rtl::UnitFiles& written) {
  std::vector<std::string> names;
  for (const rtl::File& file : written.files)
    if (file.name.ends_with(written.drawn ? ".svg" : ".dot")) names.push_back((folder / file.name).string());
  return names;
}

/// Throws std::runtime_error, one line, for an option that means nothing for the design.
void refuse_options(const CosimCommand& command, const rtl::Design& design) {
  const auto refuse = [&](bool given, const char* option, const char* what) {
    if (given)
      throw std::runtime_error(
          fmt::format("{}: not for design {}, which tests {}", option, design.name, what));
  };
  if (design.kind != hls::triangle_kind) {
    refuse(command.boxes.bits.has_value(), "--boxes", "boxes");
    refuse(command.box_unit.has_value(), "--box-unit", "boxes");
    if (const std::string why = sim::why_not_traced(design); !why.empty()) throw std::runtime_error(why);
    return;
  }
  refuse(!command.unit.empty(), "--unit", "triangles");
  refuse(command.referee, "--referee", "triangles");
  refuse(command.bit_level, "--bit-level", "triangles");
  if (!command.out.empty() && command.rays.given())
    throw std::runtime_error("--out: a triangle unit's cosim writes a picture only, and --rays make none");
}

/// What is traced, and where the results go. Places are announced before the long run, so that one that cannot
/// be written is reported at once.
class Work {
 public:
  ref::Scene scene;
  std::vector<sim::AskedRay> rays;  ///< of a list

  Work(const CosimCommand& command, const CLI::App& parsed)
      : scene(command.scene.load()), command_(command), parsed_(parsed), answers_(command.rays.answers) {
    const fs::path folder = command.out;
    if (!command.out.empty() && !command.rays.given()) {
      image_ = folder / (fs::path(scene.name).stem().string() + ".png");
      host::announce_output("--out", image_);
    }
    if (command.rays.given()) rays = sim::read_ray_list(command.rays.file, scene.to_cube);
  }

  /// When all has been read.
  void make_folder() const {
    if (!command_.out.empty()) host::make_folder(command_.out);
  }
  /// Writes the answers, if they are wanted, beside those of `software`.
  template <class AnswerScene>
  void write_answers(const AnswerScene& of, std::span<const std::uint32_t> triangles,
                     const std::function<std::unique_ptr<ref::Tracer>()>& software,
                     std::optional<Progress>& progress) {
    if (!answers_.wanted()) return;
    progress.emplace("tracing in software");
    const auto exact = sim::trace_list(*software(), rays, command_.scene.threads);
    answers_.add({}, rays, [&](std::size_t ray) {
      return sim::answer_of(of, rays[ray], triangles[ray], exact.triangles[ray]);
    });
    answers_.finish(notes_of(parsed_, scene));
  }
  void write_image(Row& row, const std::vector<glm::vec3>& pixels) const {
    if (image_.empty()) return;
    ref::write_image(image_, command_.scene.width, command_.scene.height, pixels);
    row["image"] = image_.string();
  }

 private:
  const CosimCommand& command_;
  const CLI::App& parsed_;
  AnswersFile answers_;
  fs::path image_;  ///< empty: none is drawn
};

int cosimulate_boxes(const CosimCommand& command, const CLI::App& parsed, std::optional<Progress>& progress) {
  const rtl::Design& design = command.choice.design();
  const rtl::Library library = rtl::library_called(command.library);
  const rtl::Unit unit = unit_of(command, library);
  progress.emplace("reading the scene");
  Work work(command, parsed);
  const ref::LoadedBvh hierarchy = ref::make_hierarchy(work.scene, command.hierarchy);
  work.make_folder();
  progress.emplace("compiling the Verilog");
  const sim::VerilatedDesign verilated(unit);
  const bool emits = !command.out.empty() && command.unit.empty();
  rtl::UnitFiles written;
  if (emits) written = rtl::write_unit(command.out, rtl::emit(unit));
  progress.emplace("co-simulating");
  const sim::CosimResult result = sim::cosimulate(verilated, work.scene, hierarchy.bvh,
                                                  {.width = command.scene.width,
                                                   .height = command.scene.height,
                                                   .rays_in_flight = command.rays_in_flight,
                                                   .threads = command.scene.threads,
                                                   .referee = command.referee,
                                                   .bit_level = command.bit_level,
                                                   .light = command.light,
                                                   .rays = work.rays,
                                                   .progress = [&](double share) { progress->show(share); }});
  work.write_answers(
      work.scene, result.triangles, [&] { return ref::make_tracer(work.scene.mesh, hierarchy.bvh, {}); },
      progress);
  progress.reset();

  Row row = record(command, unit, work.scene, hierarchy, result);
  work.write_image(row, result.image);
  if (emits) {
    row["verilog"] = (fs::path(command.out) / (unit.module() + ".v")).string();
    row["schematics"] = schematics(command.out, written);
  }
  fmt::print("{}", record_text(row, command.format));
  if (!written.drawn) host::note(std::string(rtl::not_drawn));
  const bool must_not_miss = design.conservative && command.referee;
  if (result.verified(must_not_miss)) return 0;
  const std::string false_misses =
      result.unit.false_misses ? fmt::format(", {} false misses", *result.unit.false_misses) : "";
  fmt::print(stderr, "hitpipe: {} {} on {}: {} RTL mismatches, {} different triangles{}; all must be 0\n",
             command.choice.name, to_string(unit.format), work.scene.name, result.unit.rtl_mismatches,
             result.different_triangles, false_misses);
  return 1;
}

/// A picture, or a list of rays, whose boxes and triangles are answered by Verilog.
int cosimulate_triangles(const CosimCommand& command, const CLI::App& parsed,
                         std::optional<Progress>& progress) {
  const rtl::Design& design = command.choice.design();
  const Format format = command.choice.format();
  const auto world = format.as<hls::WorldBits>();
  const hls::MajorBits box_bits = command.boxes.format(world).value_or(usual_box_format(world));
  const rtl::Design& boxes = rtl::find_design(command.box_unit.value_or("int_major"));
  const rtl::Library library = rtl::library_called(command.library);
  const rtl::UnitOptions built{.flow_control = command.flow_control, .interval = command.interval};
  progress.emplace("reading the scene");
  Work work(command, parsed);
  const ref::IntScene scene = command.scene.in_integers(work.scene, world, command.hierarchy);
  work.make_folder();
  progress.emplace("compiling the Verilog");
  const sim::VerilatedDesign box_unit(rtl::make_unit(boxes, box_bits, library, built));
  const sim::VerilatedDesign triangle_unit(rtl::make_unit(design, format, library, built));
  const sim::WorldTracer tracer(
      scene, {.boxes = &box_unit, .triangles = &triangle_unit, .rays_in_flight = command.rays_in_flight});
  progress.emplace("co-simulating");
  const auto show = [&](double share) { progress->show(share); };
  ref::RenderResult result;
  if (command.rays.given()) {
    sim::TracedList traced = sim::trace_list(tracer, work.rays, command.scene.threads, show);
    result.counts = traced.counts;
    result.triangles = std::move(traced.triangles);
  } else {
    const ref::IntSurfaces surfaces(scene);
    result = ref::render(scene.scene, tracer,
                         {.width = command.scene.width,
                          .height = command.scene.height,
                          .threads = command.scene.threads,
                          .light = command.light,
                          .surfaces = &surfaces,
                          .progress = show});
  }
  work.write_answers(
      scene, result.triangles,
      [&] { return ref::int_tracer(scene.mesh, scene.hierarchy(), {.world = world}); }, progress);
  progress.reset();

  const sim::WorldCounts counts = tracer.counts();
  const ref::TraceCounts all = result.counts.total();
  Row row{{"design", design.name},     {"bits", to_string(format)},
          {"box_unit", boxes.name},    {"box_bits", to_string(Format(box_bits))},
          {"scene", scene.scene.name}, {"hierarchy", command.hierarchy.name()}};
  row.update(scene_row(scene));
  row.update(
      {{"rays_primary", result.counts.primary.rays},
       {"rays_secondary", result.counts.secondary.rays},
       {"rays_shadow", result.counts.shadow.rays},
       {"box_tests", all.box_tests},
       {"box_hits", counts.boxes.hits},
       {"box_rtl_mismatches", counts.boxes.rtl_mismatches},
       {"triangle_tests", counts.triangles.tests},
       {"triangle_hits", counts.triangles.hits},
       {"triangle_rtl_mismatches", counts.triangles.rtl_mismatches},
       {"divisions", counts.divisions.tests},
       {"divider_cycles", counts.divisions.cycles},
       {"divider_rtl_mismatches", counts.divisions.rtl_mismatches},
       {"different_rays", counts.different},
       {"extra_box_tests_pct", sim::percent_above(all.box_tests, counts.reference.box_tests)},
       {"extra_triangle_tests_pct", sim::percent_above(all.triangle_tests, counts.reference.triangle_tests)},
       {"box_latency", box_unit.latency()},
       {"triangle_latency", triangle_unit.latency()},
       {"rays_in_flight", command.rays_in_flight}});
  if (boxes.kind.objects > 1) row["box_unit_tests"] = counts.boxes.tests;
  work.write_image(row, result.image);
  fmt::print("{}", record_text(row, command.format));
  const std::uint64_t mismatches =
      counts.boxes.rtl_mismatches + counts.triangles.rtl_mismatches + counts.divisions.rtl_mismatches;
  if (mismatches == 0 && counts.different == 0) return 0;
  fmt::print(
      stderr,
      "hitpipe: {} {} on {}: {} RTL mismatches, {} rays that differ from exact integers; all must be 0\n",
      design.name, to_string(format), scene.scene.name, mismatches, counts.different);
  return 1;
}

int cosimulate(const CosimCommand& command, const CLI::App& parsed) {
  const rtl::Design& design = command.choice.design();
  refuse_options(command, design);
  std::optional<Progress> progress;
  return design.kind == hls::triangle_kind ? cosimulate_triangles(command, parsed, progress)
                                           : cosimulate_boxes(command, parsed, progress);
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
  add_count_option(*command, "--rays-in-flight", options->rays_in_flight, {1, sim::Station::most_rays},
                   "Rays that share one pipeline")
      ->capture_default_str();
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
