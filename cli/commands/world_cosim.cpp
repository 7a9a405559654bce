#include "cli/commands/world_cosim.hpp"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/text/answers_file.hpp"
#include "cli/text/csv_metadata.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/cosim/world_tracer.hpp"
#include "sim/operands/ray_list.hpp"
#include "sim/operands/traced_list.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/world/int_tracer.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

/// What was traced.
struct WorldWork {
  ref::RenderCounts counts;
  std::vector<glm::vec3> image;          ///< empty for a list of rays
  std::vector<std::uint32_t> triangles;  ///< by ray of a list
};

WorldWork draw(const WorldCosim& command, const ref::IntScene& scene, const ref::Tracer& tracer,
               Progress& progress) {
  const ref::IntSurfaces surfaces(scene);
  ref::RenderResult result = ref::render(scene.scene, tracer,
                                         {.width = command.scene.width,
                                          .height = command.scene.height,
                                          .threads = command.scene.threads,
                                          .light = command.light,
                                          .surfaces = &surfaces,
                                          .progress = [&](double share) { progress.show(share); }});
  return {result.counts, std::move(result.image), {}};
}

WorldWork trace(const WorldCosim& command, const std::vector<sim::AskedRay>& list, const ref::Tracer& tracer,
                Progress& progress) {
  sim::TracedList traced =
      sim::trace_list(tracer, list, command.scene.threads, [&](double share) { progress.show(share); });
  return {traced.counts, {}, std::move(traced.triangles)};
}

}  // namespace

int cosimulate_world(const WorldCosim& command, const CLI::App& parsed) {
  const rtl::Design& design = command.choice.design();
  const rtl::Format format = command.choice.format();
  const auto world = format.as<hls::WorldBits>();
  const hls::MajorBits box_bits = command.boxes.format(world).value_or(usual_box_format(world));
  const rtl::Design& boxes = rtl::find_design(command.box_unit);
  const rtl::Library library = rtl::library_called(command.library);
  const auto unit_of = [&](const rtl::Design& its_design, const rtl::Format& its_format) {
    return rtl::make_unit(its_design, its_format, library,
                          {.flow_control = command.flow_control, .interval = command.interval});
  };
  std::optional<Progress> progress("reading the scene");
  const ref::Scene loaded = command.scene.load();
  const fs::path folder = command.out;
  const fs::path image = folder / (fs::path(loaded.name).stem().string() + ".png");
  const bool draws = !command.rays.given();
  if (!command.out.empty() && !draws)
    throw std::runtime_error("--out: a triangle unit's cosim writes a picture only, and --rays make none");
  if (!command.out.empty()) {
    host::announce_output("--out", image);
    host::make_folder(folder);
  }
  std::vector<sim::AskedRay> rays;
  if (!draws) rays = sim::read_ray_list(command.rays.file, loaded.to_cube);
  const ref::IntScene scene = command.scene.in_integers(loaded, world, command.hierarchy);
  AnswersFile answers(command.rays.answers);
  progress.emplace("compiling the Verilog");
  const sim::VerilatedDesign box_unit(unit_of(boxes, box_bits));
  const sim::VerilatedDesign triangle_unit(unit_of(design, format));
  const sim::WorldTracer tracer(
      scene, {.boxes = &box_unit, .triangles = &triangle_unit, .rays_in_flight = command.rays_in_flight});
  progress.emplace("co-simulating");
  const WorldWork result =
      draws ? draw(command, scene, tracer, *progress) : trace(command, rays, tracer, *progress);
  if (answers.wanted()) {
    progress.emplace("tracing in software");
    const auto exact = sim::trace_list(*ref::int_tracer(scene.mesh, scene.hierarchy(), {.world = world}),
                                       rays, command.scene.threads);
    answers.add({}, rays, [&](std::size_t ray) {
      return sim::answer_of(scene, rays[ray], result.triangles[ray], exact.triangles[ray]);
    });
    answers.finish(notes_of(parsed, scene.scene));
  }
  progress.reset();

  const sim::WorldCounts counts = tracer.counts();
  const ref::TraceCounts work = result.counts.total();
  Row row{{"design", design.name},     {"bits", rtl::to_string(format)},
          {"box_unit", boxes.name},    {"box_bits", rtl::to_string(rtl::Format(box_bits))},
          {"scene", scene.scene.name}, {"hierarchy", command.hierarchy.name()}};
  row.update(scene_row(scene));
  row.update(
      {{"rays_primary", result.counts.primary.rays},
       {"rays_secondary", result.counts.secondary.rays},
       {"rays_shadow", result.counts.shadow.rays},
       {"box_tests", work.box_tests},
       {"box_hits", counts.boxes.hits},
       {"box_rtl_mismatches", counts.boxes.rtl_mismatches},
       {"triangle_tests", counts.triangles.tests},
       {"triangle_hits", counts.triangles.hits},
       {"triangle_rtl_mismatches", counts.triangles.rtl_mismatches},
       {"divisions", counts.divisions.tests},
       {"divider_cycles", counts.divisions.cycles},
       {"divider_rtl_mismatches", counts.divisions.rtl_mismatches},
       {"different_rays", counts.different},
       {"extra_box_tests_pct", sim::percent_above(work.box_tests, counts.reference.box_tests)},
       {"extra_triangle_tests_pct", sim::percent_above(work.triangle_tests, counts.reference.triangle_tests)},
       {"box_latency", box_unit.latency()},
       {"triangle_latency", triangle_unit.latency()},
       {"rays_in_flight", command.rays_in_flight}});
  if (boxes.kind.objects > 1) row["box_unit_tests"] = counts.boxes.tests;
  if (!command.out.empty()) {
    ref::write_image(image, command.scene.width, command.scene.height, result.image);
    row["image"] = image.string();
  }
  fmt::print("{}", record_text(row, command.format));
  const std::uint64_t mismatches =
      counts.boxes.rtl_mismatches + counts.triangles.rtl_mismatches + counts.divisions.rtl_mismatches;
  if (mismatches == 0 && counts.different == 0) return 0;
  fmt::print(
      stderr,
      "hitpipe: {} {} on {}: {} RTL mismatches, {} rays that differ from exact integers; all must be 0\n",
      design.name, rtl::to_string(format), scene.scene.name, mismatches, counts.different);
  return 1;
}

}  // namespace hitpipe::cli
