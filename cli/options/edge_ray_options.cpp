#include "cli/options/edge_ray_options.hpp"

#include <stdexcept>

#include <CLI/CLI.hpp>

#include "cli/options/values.hpp"
#include "rays/world/int_ray.hpp"
#include "sw_ref/world/edge_lines.hpp"

namespace hitpipe::cli {

void EdgeRayChoice::check(const CLI::App& command, bool core_counts) const {
  if (given() && !core_counts)
    throw std::runtime_error(
        "--edge-rays: the core has no count of crossings; needs --questions nearest,any,count,next");
  for (const char* const name : {"--seed", "--ask"})
    if (!given() && command.count(name) > 0)
      throw std::runtime_error(fmt::format("{}: needs --edge-rays", name));
}

std::vector<ref::Ray> EdgeRayChoice::of_part(const ref::IntScene& scene, host::Piece part) const {
  if (scene.mesh.triangles.empty())
    throw std::runtime_error("--edge-rays: no triangle keeps an area at these bits; at least one must");
  const host::Piece::Range mine = part.range(rays);
  std::vector<ref::Ray> made;
  made.reserve(mine.size());
  for (const ref::IntRay& ray : ref::edge_rays(scene.mesh, scene.bits, seed, mine.first, mine.end))
    made.push_back(ref::binary32_ray(ray, scene.bits));
  return made;
}

void add_edge_ray_options(CLI::App& command, EdgeRayChoice& choice) {
  constexpr std::uint64_t most = 1'000'000'000;
  CLI::Option* const rays =
      command
          .add_option(
              "--edge-rays", choice.rays,
              "So many rays at edges and corners in place of the picture's, for a core that counts. "
              "The exit code is 1 if a ray from outside of a closed mesh has an odd count (1 to 10^9)")
          ->transform(number_from(std::uint64_t{1}, most))
          ->type_name("N");
  exclude(rays, command.get_option("--rays"), "rays come from one place");
  for (const char* const picture :
       {"--width", "--height", "--bounces", "--diffuse", "--occlusion", "--light-seed"})
    if (const CLI::Option* const option = command.get_option_no_throw(picture))
      exclude(rays, option, "rays at edges make no picture");
  add_seed_option(command, choice.seed);
  add_choice_option<bool>(command, "--ask", choice.count_alone,
                          {{"count", true}, {"nearest,any,count,next", false}},
                          "With --edge-rays: what each ray asks");
}

}  // namespace hitpipe::cli
