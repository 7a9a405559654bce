#include "cli/commands/crossings.hpp"

#include <chrono>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/hierarchy_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/closed_text.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/scene_text.hpp"
#include "sw_ref/render/image_file.hpp"
#include "sw_ref/world/crossing_picture.hpp"
#include "sw_ref/world/edge_lines.hpp"

namespace hitpipe::cli {

namespace {

Row row_of_scene(const CrossingScene& chosen, const ref::IntScene& scene, const ref::Closedness& closed,
                 OutputFormat format) {
  Row row{{"scene", scene.scene.name}, {"stands_for", scene.scene.stand_in_for}};
  row.update(scene_row(scene));
  row["hierarchy"] = chosen.hierarchy.name();
  row.update(even_row(closed, format));
  return row;
}

std::string crossing_text(const ref::IntRay& ray) {
  return fmt::format("origin ({}) direction ({})", fmt::join(ray.origin, ", "),
                     fmt::join(ray.direction, ", "));
}

/// The exit code.
int verdict(const ref::Closedness& closed, const ref::EdgeLines& found) {
  int code = 0;
  const auto fault = [&](std::uint64_t lines, const char* what, const std::optional<ref::IntRay>& first) {
    if (lines == 0) return;
    code = 1;
    fmt::print(stderr, "hitpipe: {} lines {}; the first: {}\n", lines, what, crossing_text(*first));
  };
  if (closed.even()) fault(found.odd, "cross the closed mesh an odd number of times", found.first_odd);
  if (closed.balanced())
    fault(found.unbalanced, "enter the closed mesh more or less often than they leave it",
          found.first_unbalanced);
  return code;
}

}  // namespace

void add_crossings_options(CLI::App& command, CrossingsChoice& choice) {
  CLI::Option* const option = command.add_flag(
      "--crossings", choice.asked,
      "Count how often each ray of the camera crosses the mesh in the integer world, at edges and corners "
      "too exactly once. --out is a map of the counts: .exr holds them, .png colours from none to most");
  std::vector<std::string> used{"--world", "--bits", "--boxes", "--out", "--format"};
  for (const std::string& name : scene_option_names())
    if (name != "--light" && name != "--sun") used.push_back(name);
  for (const std::string_view name : hierarchy_option_names())
    if (name != "--padding") used.emplace_back(name);
  exclude_all_but(command, option, used, "crossings are counted by exact integers, and nothing is shaded");
  constexpr std::uint64_t most = 1'000'000'000'000;
  CLI::Option* const edge_rays =
      command
          .add_option(
              "--edge-rays", choice.edge_rays,
              "With --crossings: so many rays at edges and corners in place of the camera's, two on each "
              "line. The exit code is 1 if the mesh is closed and a line has an odd count (2 to 10^12)")
          ->transform(number_from(std::uint64_t{2}, most))
          ->needs(option)
          ->type_name("N");
  for (const char* const picture : {"--out", "--width", "--height"})
    exclude(edge_rays, command.get_option(picture), "rays at edges make no picture");
  add_seed_option(command, choice.seed);
}

int count_crossings(const CrossingScene& chosen, const CrossingsChoice& choice, OutputFormat format) {
  const SceneChoice& picture = chosen.scene;
  std::optional<Progress> progress("reading the scene and its hierarchy");
  const auto boxes = chosen.boxes.format(chosen.world);
  ref::HierarchyOptions hierarchy = chosen.hierarchy;
  hierarchy.build.threads = picture.threads;
  const ref::IntScene scene = picture.in_integers(picture.load(), chosen.world, hierarchy);
  const ref::MeshCrossings crossings(scene.mesh, scene.hierarchy(), {.world = chosen.world, .boxes = boxes});
  const ref::Closedness closed = ref::closedness(scene.mesh);
  Row row = row_of_scene(chosen, scene, closed, format);
  progress.emplace("counting crossings");
  const auto show = [&](double share) { progress->show(share); };
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  int code = 0;
  if (choice.edge_rays > 0) {
    if (scene.mesh.triangles.empty())
      throw std::runtime_error("--edge-rays: no triangle keeps an area at these bits; at least one must");
    const ref::EdgeLines found = ref::cross_edge_lines(scene.mesh, crossings, chosen.world,
                                                       {.lines = (choice.edge_rays + 1) / 2,
                                                        .seed = choice.seed,
                                                        .threads = picture.threads,
                                                        .progress = show});
    row.update({{"rays", 2 * found.lines},
                {"crossings", found.crossings},
                {"ties_settled", found.ties},
                {"tied_rays", found.tied_rays},
                {"lines_from_inside", found.from_inside},
                {"odd_lines", found.odd},
                {"unbalanced_lines", found.unbalanced},
                {"seconds", seconds()}});
    progress.reset();
    code = verdict(closed, found);
  } else {
    const ref::CrossingPicture made =
        ref::crossing_picture(scene, crossings, picture.width, picture.height, picture.threads, show);
    row.update({{"rays", made.counts.size()},
                {"crossings", made.crossings},
                {"most_crossings", made.most},
                {"odd_rays", made.odd_rays},
                {"ties_settled", made.ties},
                {"seconds", seconds()}});
    progress.reset();
    if (!chosen.out.empty()) {
      ref::write_map(chosen.out, picture.width, picture.height, made.counts,
                     {0.0F, static_cast<float>(made.most)});
      row["image"] = chosen.out;
    }
  }
  fmt::print("{}", record_text(row, format));
  return code;
}

}  // namespace hitpipe::cli
