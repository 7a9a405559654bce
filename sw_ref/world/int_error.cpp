#include "sw_ref/world/int_error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "rays/scene/triangle_numbers.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/world/int_scene.hpp"
#include "rays/world/int_triangle.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::ref {

namespace {

/// The rays of a picture that were traced together, and their answers.
struct Batch {
  Query query;
  std::vector<Ray> rays;
  std::vector<std::uint32_t> triangles;
};

std::vector<std::uint32_t> answers(const Tracer& tracer, const Batch& batch, TraceCounts& counts) {
  std::vector<std::uint32_t> found(batch.rays.size());
  tracer.trace({batch.rays, batch.query, found}, counts);
  return found;
}

std::uint32_t number_of(std::uint32_t triangle, const TriangleNumbers& numbers) {
  return triangle == IntHit::none ? triangle : numbers.of_source(triangle);
}

void compare_rays(const Batch& batch, const TriangleNumbers& before, const std::vector<std::uint32_t>& found,
                  const TriangleNumbers& after, IntError& error) {
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::uint32_t in_floats = number_of(batch.triangles[i], before);
    const std::uint32_t in_integers = number_of(found[i], after);
    error.different_rays += same_answer(batch.query, in_integers, in_floats) ? 0 : 1;
    error.lost_hits += in_floats != IntHit::none && in_integers == IntHit::none ? 1 : 0;
  }
}

void compare_pixels(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b, IntError& error) {
  error.pixels = a.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::vec3 d = glm::abs(a[i] - b[i]);
    const float largest = std::max({d.x, d.y, d.z});
    if (largest > same_colour) error.different_at.push_back(static_cast<std::uint32_t>(i));
    error.largest_difference = std::max(error.largest_difference, double{largest});
  }
  error.different_pixels = error.different_at.size();
}

}  // namespace

IntError int_error(const Scene& scene, const IntErrorOptions& options) {
  const IntScene integers = int_scene(scene, options.world, options.hierarchy);
  const FloatSurfaces float_surfaces(scene.mesh, int_offset(options.world));
  const IntSurfaces int_surfaces(integers);
  RenderOptions drawing;
  drawing.width = options.width;
  drawing.height = options.height;
  drawing.light = options.light;

  std::vector<Batch> batches;
  const Bvh bvh = make_hierarchy(scene, options.hierarchy).bvh;
  RenderOptions recording = drawing;
  recording.surfaces = &float_surfaces;
  recording.traced = [&](RayKind, const TraceJob& job) {
    batches.push_back(
        {job.query, {job.rays.begin(), job.rays.end()}, {job.triangles.begin(), job.triangles.end()}});
  };
  const RenderResult float_picture = render(scene, *make_tracer(scene.mesh, bvh, {}), recording);

  IntError error;
  error.triangles = static_cast<std::uint32_t>(integers.mesh.triangles.size());
  error.lost_to_rounding = integers.mesh.lost.triangles;
  error.largest_movement = integers.mesh.largest_movement;
  const auto tracer = [&](const std::optional<hls::MajorBits>& boxes) {
    return int_tracer(integers.mesh, integers.hierarchy(), {.world = options.world, .boxes = boxes});
  };
  const std::unique_ptr<Tracer> exact = tracer(std::nullopt);
  const TriangleNumbers before(scene.mesh);
  const TriangleNumbers after(integers.mesh.mesh);
  for (const Batch& batch : batches) {
    error.rays += batch.rays.size();
    compare_rays(batch, before, answers(*exact, batch, error.exact), after, error);
  }
  for (const hls::MajorBits& boxes : options.boxes) {
    const std::unique_ptr<Tracer> with = tracer(boxes);
    TraceCounts& counts = error.with.emplace_back();
    for (const Batch& batch : batches) (void)answers(*with, batch, counts);
  }
  drawing.surfaces = &int_surfaces;
  compare_pixels(float_picture.image, render(integers.scene, *tracer(std::nullopt), drawing).image, error);
  return error;
}

}  // namespace hitpipe::ref
