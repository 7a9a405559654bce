#include "sw_ref/render/render.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/traverse/slabs.hpp"
#include "sw_ref/traverse/traversal.hpp"

namespace hitpipe::ref {
namespace {

constexpr int tile_side = 32;

void add(RenderCounts& sum, const TraversalCounts& counts) {
  sum.box_tests += counts.box_tests;
  sum.triangle_tests += counts.triangle_tests;
}

struct Pixel {
  glm::vec3 colour;
  std::uint32_t triangle;
};

template <class BoxTest>
Pixel render_pixel(const Scene& scene, const Bvh& bvh, const Ray& ray, RenderCounts& counts) {
  TraversalCounts work;
  const Hit hit = trace<BoxTest>(bvh, scene.mesh, ray, Query::closest, work);
  ++counts.rays_primary;
  if (!hit.found()) {
    add(counts, work);
    return {sky(ray.direction), Hit::none};
  }
  const SurfacePoint point = surface_point(scene.mesh, hit.triangle, ray);
  glm::vec3 light = ambient(point);
  for (const Light& source : scene.lights) {
    const std::optional<Ray> to_light = shadow_ray(point, source);
    if (!to_light) continue;
    ++counts.rays_shadow;
    if (!trace<BoxTest>(bvh, scene.mesh, *to_light, Query::any, work).found()) light += direct(point, source);
  }
  add(counts, work);
  const std::size_t material = scene.mesh.materials.empty() ? 0 : scene.mesh.materials[hit.triangle];
  return {scene.materials[material].albedo * light, hit.triangle};
}

template <class BoxTest>
RenderCounts render_tile(const Scene& scene, const Bvh& bvh, int left, int top, RenderResult& result) {
  RenderCounts counts;
  for (int y = top; y < std::min(top + tile_side, result.height); ++y) {
    for (int x = left; x < std::min(left + tile_side, result.width); ++x) {
      const Ray ray = primary_ray(scene.camera, x, y, result.width, result.height);
      const Pixel pixel = render_pixel<BoxTest>(scene, bvh, ray, counts);
      const auto at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) + static_cast<std::size_t>(x);
      result.image[at] = pixel.colour;
      result.triangles[at] = pixel.triangle;
    }
  }
  return counts;
}

}  // namespace

RenderResult render(const Scene& scene, const Bvh& bvh, int width, int height, int threads,
                    BoxTestKind box_test) {
  if (width < 1 || height < 1)
    throw std::invalid_argument(
        fmt::format("image of {} x {} pixels; at least 1 x 1 is needed", width, height));
  if (threads < 1) throw std::invalid_argument(fmt::format("{} threads; at least 1 is needed", threads));
  RenderResult result{width, height, {}, {}, {}};
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  result.image.resize(pixels);
  result.triangles.resize(pixels);
  const int columns = (width + tile_side - 1) / tile_side;
  const int rows = (height + tile_side - 1) / tile_side;
  std::vector<RenderCounts> counts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto tile = box_test == BoxTestKind::robust ? &render_tile<RobustSlabs> : &render_tile<FloatSlabs>;
  // More workers than cores would only make TBB complain.
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t i) {
      const int column = static_cast<int>(i) % columns;
      const int row = static_cast<int>(i) / columns;
      counts[i] = tile(scene, bvh, column * tile_side, row * tile_side, result);
    });
  });
  for (const RenderCounts& part : counts) {
    result.counts.rays_primary += part.rays_primary;
    result.counts.rays_shadow += part.rays_shadow;
    result.counts.box_tests += part.box_tests;
    result.counts.triangle_tests += part.triangle_tests;
  }
  return result;
}

}  // namespace hitpipe::ref
