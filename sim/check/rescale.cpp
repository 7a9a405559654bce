#include "sim/check/rescale.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/exact/exact_triangle.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/trace/tracer.hpp"
#include "sim/cosim/cosim.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::sim {

namespace {

Picture rendered(const ref::Scene& scene, const PictureOptions& options) {
  Picture picture;
  const ref::Bvh bvh = ref::build_bvh(scene.mesh, options.build);
  if (options.verilated == nullptr) {
    ref::RenderOptions rendering;
    rendering.width = options.width;
    rendering.height = options.height;
    rendering.threads = options.threads;
    ref::RenderResult result = ref::render(scene, *ref::make_tracer(scene.mesh, bvh, {}), rendering);
    picture.image = std::move(result.image);
    picture.triangles = std::move(result.triangles);
    return picture;
  }
  CosimResult result =
      cosimulate(*options.verilated, scene, bvh,
                 {.width = options.width, .height = options.height, .threads = options.threads});
  picture.image = std::move(result.image);
  picture.triangles = std::move(result.triangles);
  picture.different_triangles = result.different_triangles;
  picture.rtl_mismatches = result.unit.rtl_mismatches;
  return picture;
}

}  // namespace

MovedScene moved(const ref::SceneDescription& scene, const Transform& transform) {
  const auto move = [&](const glm::dvec3& point) { return point * transform.scale + transform.offset; };
  MovedScene result{scene, 0};
  ref::SceneDescription& to = result.description;
  for (std::size_t i = 0; i < to.mesh.vertices.size(); ++i) {
    const glm::dvec3& own = scene.mesh.vertices[i];
    const glm::vec3 vertex(move(own));
    if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.z)) {
      throw std::runtime_error(
          fmt::format("vertex {}: ({}, {}, {}) leaves the range of binary32", i, own.x, own.y, own.z));
    }
    to.mesh.vertices[i] = vertex;
    const glm::dvec3 back = (glm::dvec3(vertex) - transform.offset) / transform.scale;
    result.vertices_moved += back == own ? 0U : 1U;
  }
  to.eye = move(scene.eye);
  to.target = move(scene.target);
  for (ref::LightSource& light : to.lights)
    if (light.kind == ref::LightKind::point) light.position = move(light.position);  // a sun has no place
  return result;
}

Picture picture(const ref::SceneDescription& scene, const PictureOptions& options) {
  const ref::Scene placed = ref::place(scene);
  Picture result = rendered(placed, options);
  result.lost_to_rounding = placed.mesh.lost();
  const ref::TriangleNumbers numbers(placed.mesh);
  for (std::uint32_t& triangle : result.triangles) {
    if (triangle != ref::Hit::none) triangle = numbers.of_source(triangle);
  }
  return result;
}

PixelChanges pixel_changes(const Picture& one, const Picture& other) {
  constexpr float visible = 1.0F / 255.0F;
  PixelChanges changes;
  for (std::size_t i = 0; i < one.triangles.size(); ++i) {
    changes.other_triangle += one.triangles[i] != other.triangles[i] ? 1 : 0;
    const glm::vec3 difference = glm::abs(one.image[i] - other.image[i]);
    const bool same = difference.x <= visible && difference.y <= visible && difference.z <= visible;
    changes.other_colour += same ? 0 : 1;
  }
  return changes;
}

}  // namespace hitpipe::sim
