#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/commands/crossings.hpp"
#include "cli/commands/rescale.hpp"
#include "cli/options/cache_options.hpp"
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
#include "rays/trace/int_tracer.hpp"
#include "rays/tree/bvh.hpp"
#include "sim/operands/traced_list.hpp"
#include "sw_ref/memory/read_bytes.hpp"
#include "sw_ref/render/image_compare.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/render/stiff_rays.hpp"

namespace hitpipe::cli {

namespace {

struct RenderCommand {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy;
  CacheChoice caches;
  TraceChoice trace;
  BoxFormatChoice boxes;
  ref::WhittedOptions light;
  std::string out;
  std::string depth_map;
  std::string box_map;
  std::string extra_box_map;
  std::string triangle_map;
  RayListChoice rays;
  RescaleChoice moves;
  std::vector<std::string> images;  ///< to compare
  bool compare = false;
  CrossingsChoice crossings;
  double tolerance = 0.0;
  OutputFormat format = OutputFormat::text;

  /// Throws if a picture cannot be written.
  void check_places() const {
    for (const std::string& file : {out, depth_map, box_map, extra_box_map, triangle_map})
      if (!file.empty()) ref::check_image_place(file);
  }
  [[nodiscard]] bool maps() const {
    return !depth_map.empty() || !box_map.empty() || !extra_box_map.empty() || !triangle_map.empty();
  }
};

/// Counts for all rays together, then for one ray of each kind: "box_tests", "box_tests_per_ray",
/// "box_tests_per_primary", ...
void add_work(Row& row, const ref::RenderCounts& counts, const std::string& what,
              std::uint64_t ref::TraceCounts::*work) {
  const ref::TraceCounts total = counts.total();
  const auto per_ray = [&](const char* kind, const ref::TraceCounts& of) {
    row[what + "_per_" + kind] =
        of.rays == 0 ? 0.0 : static_cast<double>(of.*work) / static_cast<double>(of.rays);
  };
  row[what] = total.*work;
  per_ray("ray", total);
  per_ray("primary", counts.primary);
  per_ray("secondary", counts.secondary);
  per_ray("shadow", counts.shadow);
}

/// Draws the map if it is asked for, starting at zero or at its least value. The row says what the ends of
/// the scale stand for.
void add_map(Row& row, const ref::RenderResult& result, const std::string& name, const std::string& file,
             std::span<const float> values, bool from_zero) {
  if (file.empty()) return;
  ref::MapScale scale = ref::scale_of(values);
  if (from_zero) scale.low = 0.0F;
  ref::write_map(file, result.width, result.height, values, scale);
  row[name] = file;
  row[name + "_low"] = scale.low;
  row[name + "_high"] = scale.high;
}

/// Two images. The exit code is 1 when they differ.
int compare_images(const RenderCommand& command) {
  // One step of an 8-bit code is 0.0039, so the text needs more than two digits after the point.
  const auto difference_of = [&](double x) {
    return command.format == OutputFormat::text ? Row(fmt::format("{:.6g}", x)) : Row(x);
  };
  const ref::StoredImage a = ref::read_image(command.images.at(0));
  const ref::StoredImage b = ref::read_image(command.images.at(1));
  const ref::ImageDifference difference = ref::compare_images(a, b, command.tolerance);
  Row row{{"width", a.width},
          {"height", a.height},
          {"channels", a.channels},
          {"pixels", difference.pixels},
          {"different_pixels", difference.different_pixels},
          {"largest_difference", difference_of(difference.largest)},
          {"mean_difference", difference_of(difference.mean)},
          {"psnr_db", difference.psnr_db}};
  if (!command.out.empty()) {
    ref::write_map(command.out, a.width, a.height, difference.per_pixel,
                   {0.0F, ref::scale_of(difference.per_pixel).high});
    row["difference_image"] = command.out;
  }
  fmt::print("{}", record_text(row, command.format));
  return difference.different_pixels == 0 ? 0 : 1;
}

/// The scene of either world, and what traces it.
struct Traced {
  ref::Scene scene{};
  ref::LoadedBvh hierarchy{};  ///< of the float world
  std::optional<ref::IntScene> integers{};
  std::optional<ref::IntSurfaces> surfaces{};
  std::unique_ptr<ref::Tracer> tracer{};

  [[nodiscard]] const ref::Scene& drawn() const { return integers ? integers->scene : scene; }
};

/// The bytes that memory gives for a ray, by layout of triangles, without a cache and behind each.
void add_reads(Row& row, const RenderCommand& command, const ref::TracerOptions& tracing,
               const Traced& traced) {
  const ref::Scene& scene = traced.scene;
  const ref::Bvh& bvh = traced.hierarchy.bvh;
  const auto batches =
      ref::record_rays(scene, bvh, command.scene.width, command.scene.height, tracing.bundle, command.light);
  const std::vector<ref::CacheShape> caches = command.caches.shapes();
  for (const auto& [layout, name] : {std::pair{ref::TriangleLayout::corners, "bytes_per_ray"},
                                     std::pair{ref::TriangleLayout::indices, "indexed_bytes_per_ray"}}) {
    add_read_bytes(row, name, ref::read_bytes(*traced.tracer, scene.mesh, bvh, batches, layout, caches),
                   command.caches);
  }
}

/// In place: parts refer to each other.
void make_traced(const RenderCommand& command, Traced& traced) {
  traced.scene = command.scene.load();
  ref::HierarchyOptions hierarchy = command.hierarchy;
  hierarchy.build.threads = command.scene.threads;
  if (command.trace.world == World::floats) {
    traced.hierarchy = ref::make_hierarchy(traced.scene, hierarchy);
    traced.tracer = ref::make_tracer(traced.scene.mesh, traced.hierarchy.bvh, command.trace.options());
    return;
  }
  const hls::WorldBits bits = command.trace.world_bits();
  const auto boxes = command.boxes.format(bits);
  traced.integers = command.scene.in_integers(traced.scene, bits, hierarchy);
  traced.surfaces.emplace(*traced.integers);
  traced.tracer =
      ref::int_tracer(traced.integers->mesh, traced.integers->hierarchy(), {.world = bits, .boxes = boxes});
}

/// The tracer that cannot miss.
std::unique_ptr<ref::Tracer> reference_for(const Traced& traced) {
  return traced.integers ? ref::int_tracer(traced.integers->mesh, traced.integers->hierarchy(),
                                           {.world = traced.integers->bits})
                         : ref::make_tracer(traced.scene.mesh, traced.hierarchy.bvh, {});
}

/// What was traced, and with what.
Row row_of(const RenderCommand& command, const Traced& traced) {
  const ref::Scene& scene = traced.drawn();
  const ref::Tracer& tracer = *traced.tracer;
  Row row{{"scene", scene.name}, {"stands_for", scene.stand_in_for}};
  row.update(traced.integers ? scene_row(*traced.integers) : scene_row(scene));
  row["bvh_nodes"] = tracer.node_count();
  row["hierarchy"] = command.hierarchy.name();
  if (!command.hierarchy.file.empty() && !traced.integers)
    row["bvh_boxes_grown"] = traced.hierarchy.boxes_grown;
  row.update({{"bytes_per_node", tracer.bytes_per_node()},
              {"node_bytes", tracer.node_count() * tracer.bytes_per_node()}});
  return row;
}

void add_all_work(Row& row, const ref::RenderCounts& counts) {
  add_work(row, counts, "box_tests", &ref::TraceCounts::box_tests);
  add_work(row, counts, "triangle_tests", &ref::TraceCounts::triangle_tests);
  add_work(row, counts, "nodes_loaded", &ref::TraceCounts::nodes_loaded);
  add_work(row, counts, "triangles_loaded", &ref::TraceCounts::triangles_loaded);
}

/// The rays of a file, also by exact arithmetic.
void trace_rays(const RenderCommand& command, const CLI::App& parsed) {
  std::optional<Progress> progress("reading the scene and its hierarchy");
  Traced traced;
  make_traced(command, traced);
  const std::vector<sim::AskedRay> rays = sim::read_ray_list(command.rays.file, traced.drawn().to_cube);
  AnswersFile answers(command.rays.answers);
  progress.emplace("tracing");
  const auto show = [&](double share) { progress->show(share); };
  const int threads = command.scene.threads;
  const auto start = std::chrono::steady_clock::now();
  const sim::TracedList found = sim::trace_list(*traced.tracer, rays, threads, show);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  progress.emplace("tracing with the reference");
  const sim::TracedList exact = sim::trace_list(*reference_for(traced), rays, threads, show);
  answers.add({}, rays, [&](std::size_t ray) {
    const auto answer = [&](const auto& scene) {
      return sim::answer_of(scene, rays[ray], found.triangles[ray], exact.triangles[ray]);
    };
    return traced.integers ? answer(*traced.integers) : answer(traced.scene);
  });
  answers.finish(notes_of(parsed, traced.drawn()));
  progress.reset();

  Row row = row_of(command, traced);
  row.update({{"rays_primary", found.counts.primary.rays},
              {"rays_shadow", found.counts.shadow.rays},
              {"different_triangles", sim::different_answers(rays, found.triangles, exact.triangles)}});
  add_all_work(row, found.counts);
  row["seconds"] = seconds.count();
  fmt::print("{}", record_text(row, command.format));
}

void render_scene(const RenderCommand& command) {
  const ref::TracerOptions tracing =
      command.trace.world == World::floats ? command.trace.options() : ref::TracerOptions{};
  if (!command.caches.kib.empty() && command.trace.world == World::integers)
    throw std::runtime_error(
        "--cache: not for --world integer; `hitpipe core image --stack` and `hitpipe core trace --cache` "
        "count its "
        "reads");
  std::optional<Progress> progress("reading the scene and its hierarchy");
  Traced traced;
  make_traced(command, traced);
  const ref::Scene& scene = traced.drawn();
  const std::unique_ptr<ref::Tracer>& tracer = traced.tracer;
  progress.emplace("rendering");
  ref::StiffRays stiff;
  ref::RenderOptions options{.width = command.scene.width,
                             .height = command.scene.height,
                             .threads = command.scene.threads,
                             .tile_side = ref::tile_side_for(tracing.bundle),
                             .light = command.light,
                             .surfaces = traced.surfaces ? &*traced.surfaces : nullptr,
                             .maps = command.maps(),
                             .progress = [&](double share) { progress->show(share); },
                             .traced = [&](ref::RayKind, const ref::TraceJob& job) { stiff.add(job.rays); }};
  const auto start = std::chrono::steady_clock::now();
  const ref::RenderResult result = ref::render(scene, *tracer, options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::vector<float> extra;
  if (!command.extra_box_map.empty()) {
    progress.emplace("rendering the reference");
    options.traced = {};
    options.tile_side = ref::tile_side_for(1);
    extra = ref::extra_box_tests(result, ref::render(scene, *reference_for(traced), options));
  }
  progress.reset();

  const ref::RenderCounts& counts = result.counts;
  Row row = row_of(command, traced);
  row.update({{"rays_primary", counts.primary.rays},
              {"rays_secondary", counts.secondary.rays},
              {"rays_shadow", counts.shadow.rays},
              {"stiff_rays_pct", stiff.stiff_pct()},
              {"zero_component_rays_pct", stiff.zero_component_pct()},
              {"surface_points", result.shading.surface_points},
              {"light_evaluations", result.shading.light_evaluations},
              {"queue_bytes_primary", result.shading.queue_bytes_of(ref::RayKind::primary)},
              {"queue_bytes_secondary", result.shading.queue_bytes_of(ref::RayKind::secondary)},
              {"queue_bytes_shadow", result.shading.queue_bytes_of(ref::RayKind::shadow)}});
  add_all_work(row, counts);
  if (!command.caches.kib.empty()) add_reads(row, command, tracing, traced);
  row["seconds"] = seconds.count();
  if (!command.out.empty()) {
    ref::write_image(command.out, result.width, result.height, result.image);
    row["image"] = command.out;
  }
  add_map(row, result, "depth_map", command.depth_map, result.depth, false);
  add_map(row, result, "box_map", command.box_map, result.box_tests, true);
  add_map(row, result, "extra_box_map", command.extra_box_map, extra, true);
  add_map(row, result, "triangle_map", command.triangle_map, result.triangle_tests, true);
  fmt::print("{}", record_text(row, command.format));
}

}  // namespace

CLI::App* add_render_command(CLI::App& program, int& exit_code) {
  CLI::App* const command =
      program.add_subcommand("render", "Render a scene in software by any traversal; compare two images");
  const auto options = std::make_shared<RenderCommand>();
  add_scene_options(*command, options->scene);
  add_light_options(*command, options->light);
  add_hierarchy_options(*command, options->hierarchy);
  add_trace_options(*command, options->trace);
  add_box_format_option(*command, options->boxes, "exact boxes");
  add_cache_options(*command, options->caches);
  const auto file = [&](const char* name, std::string& value, const char* what) {
    as_output(command->add_option(name, value, what));
  };
  file("--out", options->out, "Image to write: .png or .exr");
  file("--depth-map", options->depth_map,
       "Map of the distances from the eye, in the cube: .exr holds the values, .png colours from nearest to "
       "farthest, with a black sky");
  file("--box-map", options->box_map,
       "Map of the box tests of all rays of a pixel: .exr holds the values, .png colours from none to most");
  file("--triangle-map", options->triangle_map, "The same for triangle tests");
  file("--extra-box-map", options->extra_box_map,
       "Map of the box tests beyond conservative float slabs (the default), in the same colours");
  add_ray_list_options(*command, options->rays);
  for (const char* const picture :
       {"--out", "--depth-map", "--box-map", "--triangle-map", "--extra-box-map", "--cache"})
    exclude(command->get_option("--rays"), command->get_option(picture),
            "the rays of a file make no picture");
  add_format_option(*command, options->format);
  add_rescale_options(*command, options->moves, {});
  add_crossings_options(*command, options->crossings);
  as_input(command->add_option("image", options->images, "Two images of one size, for --compare"))
      ->type_name("FILE");
  CLI::Option* const compares =
      command->add_flag("--compare", options->compare,
                        "Compare two images in place of rendering; the exit code is 1 when a pixel "
                        "differs by more than the tolerance. --out is a map of each pixel's largest "
                        "difference");
  command
      ->add_option("--tolerance", options->tolerance,
                   "With --compare: how far channels may be apart; values of a .png are 0 to 1")
      ->check(CLI::NonNegativeNumber.description(""))
      ->needs(compares)
      ->type_name("X")
      ->capture_default_str();
  command->get_option("--scene")->required(false);
  exclude_all_but(*command, compares, {"image", "--tolerance", "--out", "--format"},
                  "two images are compared, and nothing is rendered");
  add_examples(*command, {"hitpipe render --scene spheres --out spheres.png",
                          "hitpipe render --scene terrain --box-map boxes.png",
                          "hitpipe render --scene spheres --crossings --out crossings.png",
                          "hitpipe render --scene city --crossings --edge-rays 1000000"});
  command->callback([options, command, &exit_code] {
    const std::size_t images = options->compare ? 2 : 0;
    if (options->images.size() != images)
      throw std::runtime_error(fmt::format("render: {} images; --compare takes two", options->images.size()));
    if (!options->compare && options->scene.name.empty())
      throw std::runtime_error("--scene is required; see hitpipe render --help");
    if (command->count("--seed") > 0 && options->crossings.edge_rays == 0)
      throw std::runtime_error("--seed: needs --edge-rays");
    options->check_places();
    if (options->compare) {
      exit_code = compare_images(*options);
    } else if (options->moves.asked) {
      exit_code = rescale(options->scene, options->moves, nullptr, options->format);
    } else if (options->crossings.asked) {
      if (options->trace.world == World::floats && command->count("--world") > 0)
        throw std::runtime_error(
            "--crossings: not for --world float, which has no exact counts; leave it out");
      exit_code = count_crossings(
          {options->scene, options->hierarchy, options->trace.world_bits(), options->boxes, options->out},
          options->crossings, options->format);
    } else if (options->rays.given()) {
      trace_rays(*options, *command);
    } else {
      render_scene(*options);
    }
  });
  return command;
}

}  // namespace hitpipe::cli
