#include <chrono>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "cli/scene_options.hpp"
#include "cli/table.hpp"
#include "cli/values.hpp"
#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::cli {

namespace {

struct RenderOptions {
  SceneChoice scene;
  ref::BoxTestKind box_test = ref::BoxTestKind::robust;
  std::string out;
  Format format = Format::text;
};

void render_scene(const RenderOptions& options) {
  std::optional<Progress> progress("reading the scene");
  const ref::Scene scene = options.scene.load();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  progress.emplace("rendering");
  const auto start = std::chrono::steady_clock::now();
  const ref::RenderResult result = ref::render(scene, bvh, options.scene.width, options.scene.height,
                                               options.scene.threads, options.box_test);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  progress.reset();
  if (!options.out.empty()) ref::write_image(options.out, result.width, result.height, result.image);

  const ref::RenderCounts& counts = result.counts;
  const auto rays = static_cast<double>(counts.rays_primary + counts.rays_shadow);
  Row row{{"scene", scene.name},
          {"triangles", scene.mesh.triangles.size()},
          {"degenerate_dropped", scene.mesh.degenerate_dropped},
          {"bvh_nodes", bvh.nodes.size()},
          {"rays_primary", counts.rays_primary},
          {"rays_shadow", counts.rays_shadow},
          {"box_tests", counts.box_tests},
          {"box_tests_per_ray", static_cast<double>(counts.box_tests) / rays},
          {"triangle_tests", counts.triangle_tests},
          {"triangle_tests_per_ray", static_cast<double>(counts.triangle_tests) / rays},
          {"seconds", seconds.count()}};
  if (!options.out.empty()) row["image"] = options.out;
  fmt::print("{}", record_text(row, options.format));
}

}  // namespace

void add_render_command(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("render", "Render a scene in software, through the same hierarchy of boxes");
  const auto options = std::make_shared<RenderOptions>();
  add_scene_options(*command, options->scene);
  add_choice_option<ref::BoxTestKind>(
      *command, "--box-test", options->box_test,
      {{"float", ref::BoxTestKind::float_slabs}, {"robust", ref::BoxTestKind::robust}},
      "float: as the thesis computes it; robust: misses no box");
  command->add_option("--out", options->out, "Image to write: .png or .exr")->type_name("FILE");
  add_format_option(*command, options->format);
  command->callback([options] { render_scene(*options); });
}

}  // namespace hitpipe::cli
