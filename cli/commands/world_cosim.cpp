#include "cli/commands/world_cosim.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "cli/text/progress.hpp"
#include "host/files.hpp"
#include "host/outputs.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/cosim/world_tracer.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::cli {

namespace {

namespace fs = std::filesystem;

}  // namespace

int cosimulate_world(const WorldCosim& command) {
  const rtl::Design& design = command.choice.design();
  const rtl::Format format = command.choice.format();
  const auto world = format.as<hls::WorldBits>();
  const hls::MajorBits box_bits = command.boxes.format(world).value_or(usual_box_format(world));
  const rtl::Design& boxes = rtl::find_design(command.box_unit);
  const rtl::Library library = rtl::library_called(command.library);
  const auto unit_of = [&](const rtl::Design& its_design, const rtl::Format& its_format) {
    return sim::make_unit(its_design, its_format, library, command.flow_control, command.interval);
  };
  std::optional<Progress> progress("reading the scene");
  const ref::Scene loaded = command.scene.load();
  const fs::path folder = command.out;
  const fs::path image = folder / (fs::path(loaded.name).stem().string() + ".png");
  if (!command.out.empty()) {
    host::announce_output("--out", image);
    host::make_folder(folder);
  }
  const ref::IntScene scene = ref::int_scene(loaded, world, command.hierarchy);
  const ref::IntSurfaces surfaces(scene);
  progress.emplace("compiling the Verilog");
  const sim::VerilatedDesign box_unit(unit_of(boxes, box_bits));
  const sim::VerilatedDesign triangle_unit(unit_of(design, format));
  const sim::WorldTracer tracer(
      scene, {.boxes = &box_unit, .triangles = &triangle_unit, .rays_in_flight = command.rays_in_flight});
  progress.emplace("co-simulating");
  const ref::RenderResult result = ref::render(scene.scene, tracer,
                                               {.width = command.scene.width,
                                                .height = command.scene.height,
                                                .threads = command.scene.threads,
                                                .light = command.light,
                                                .surfaces = &surfaces,
                                                .progress = [&](double share) { progress->show(share); }});
  progress.reset();

  const sim::WorldCounts counts = tracer.counts();
  const ref::TraceCounts work = result.counts.total();
  Row row{{"design", design.name},     {"bits", rtl::to_string(format)},
          {"box_unit", boxes.name},    {"box_bits", rtl::to_string(rtl::Format(box_bits))},
          {"scene", scene.scene.name}, {"triangles", scene.mesh.triangles.size()}};
  row.update(door_row(scene));
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
